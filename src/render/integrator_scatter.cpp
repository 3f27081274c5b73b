// How a path goes on from a surface: which scatterer is drawn, and what each share of the path becomes.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/sampling.h"
#include "render/faults.h"
#include "render/integrator.h"
#include "render/path_log.h"

namespace lightsieve {
namespace {

/// Streams of random numbers of walks below a surface, apart from those of the path.
constexpr std::uint32_t kWalkStream = 0x5bd1e995U;
/// Roulette never kills nor spares more surely than this.
constexpr float kLeastSurvival = 0.05F, kMostSurvival = 0.95F;

/// The footprint at the next vertex, `t` further on.
///
/// A scattered ray stands for its share of the directions: of n samples with that density each has the solid angle
/// 1 / (n pdf), which a cone covers. So textures that are seen indirectly are filtered, the less the more samples there
/// are. Source of the idea: Suykens and Willems 2001, "Path Differentials and Applications".
///
/// pdf  of the direction per solid angle; infinite: a delta lobe, which widens nothing
void widen(Footprint& footprint, float t, float pdf, int n_samples) {
    constexpr float kWidest = 1;  // about a hemisphere [rad]
    footprint.width += footprint.spread * t;
    const float spread = 2 / std::sqrt(kPi * pdf * static_cast<float>(std::max(1, n_samples)));
    if (spread > footprint.spread) footprint.spread = std::min(spread, kWidest);
}

}  // namespace

/// Throughput that may use the channel.
template <class Tracker>
Color Integrator<Tracker>::reach(const Channel& channel) const {
    Color sum;
    if (culling_ == Culling::Lobes && !tracker_.goes_on(channel)) return sum;
    for (std::size_t g = 0; g < path_.groups.all().size(); ++g)
        if (may_scatter(path_.groups[g].key, channel))
            sum += path_.groups[g].throughput * path_.groups.indirect(g);
    return sum;
}

/// How likely each closure, or passing straight through, is drawn: by what it can carry on.
template <class Tracker>
void Integrator<Tracker>::choose_probabilities() {
    for (std::size_t c = 0; c < n_channels_; ++c) {
        mixture_[c] = is_enabled(channels_[c]) ? 0 : kNoRays;
        reach_[c] = reach(channels_[c]);
    }
    const std::size_t n = n_channels_ > 0 ? n_scatterers() : 0;
    if (n == 1 && is_black(closures_.transparency())) {
        // No choice: what the lobe returns need not be known.
        probability_[0] = is_black(reach_[0]) || !is_enabled(0) ? 0 : 1;
        pass_probability_ = 0;
        return;
    }
    float total = 0;
    for (std::size_t i = 0; i < n; ++i) {
        carries_[i] = is_enabled(i) ? reach_[channel_of_[i]] * albedo_of(i) : kBlack;
        probability_[i] = std::max(0.0F, luminance(carries_[i]));
        total += probability_[i];
    }
    const bool may_pass = path_.n_transparent < scene_.settings.auto_transparency_depth;
    const float through =
        may_pass ? std::max(0.0F, luminance(path_.groups.total() * closures_.transparency())) : 0;
    const float sum = total + through;
    pass_probability_ = sum > 0 ? through / sum : 0;
    for (std::size_t i = 0; i < n; ++i)
        probability_[i] = sum > 0 ? probability_[i] / sum : 0;
}

template <class Tracker>
bool Integrator<Tracker>::go_on(const Surface& surface, Ray& ray) {
    const float u = points_.choice.x;
    if (u < pass_probability_) {
        pass_straight(surface, ray, pass_probability_);
        return ray.t_max > 0;
    }
    const std::optional<std::size_t> drawn = draw(u - pass_probability_);
    return drawn && scatter(surface, *drawn, ray);
}

/// Straight through: no event, no depth.
template <class Tracker>
void Integrator<Tracker>::pass_straight(const Surface& surface, Ray& ray, float probability) {
    const Color factor = closures_.transparency() * (1 / probability);
    path_.groups.scale(factor);
    tracker_.scale(factor);
    path_.passed *= factor;
    ++path_.n_transparent;
    go_straight(surface, ray);
}

template <class Tracker>
bool Integrator<Tracker>::scatter(const Surface& surface, std::size_t drawn, Ray& ray) {
    if (drawn >= closures_.closures().size()) return scatter_below(surface, drawn, ray);
    const std::optional<LobeSample> chosen = this->sample(drawn);
    if (!chosen) return false;
    const LobeSample& sample = *chosen;

    // What each channel of the mixture carries into that direction, over its density.
    const std::span<Color> factors = cleared_values();
    const bool delta = closures_.delta(drawn);
    float pdf = 0;
    if (delta) {
        if ((dot(sample.wi, surface.outward) > 0) != (dot(sample.wi, surface.at.normal) > 0))
            return false;
        factors[channel_of_[drawn]] = sample.f * (1 / probability_[drawn]);
    } else {
        pdf = evaluate(surface, drawn, sample, factors);
        if (!(pdf > 0)) return false;
        for (std::size_t c = 0; c < n_channels_; ++c)
            factors[c] *= 1 / pdf;
    }
    for (std::size_t c = 0; c < n_channels_; ++c)
        if (!is_finite(factors[c])) {
            drop(TraceCounts::kNoEvent);
            return false;
        }

    if (active_fault() == Fault::DrawnLobeTakesAll) {
        Color all;
        for (Color& factor : factors)
            all += std::exchange(factor, Color{});
        factors[channel_of_[drawn]] = all;
    }
    const Color wavelength = color_of_wavelength(surface, sample.wi);
    for (Color& factor : factors)
        factor *= wavelength;
    const LightPlan plan = light_plan(*surface.object->lights, surface.in_medium);
    const float carried = recorder_ != nullptr ? luminance(path_.groups.total()) : 0;
    if (!advance(factors, drawn) || !is_worth_a_ray()) return false;
    if (recorder_ != nullptr && !delta) record(drawn, sample.wi, factors, carried);
    if (dot(sample.wi, surface.outward) < 0 && !surface.in_medium) {
        path_.monochromatic |= closures_.disperses();
        // Curves have no inside: rays to their far side are past them.
        if (closures_.interior().is_body && !surface.at.on_curve)
            path_.interiors.cross(surface.shader, closures_.interior(), surface.at.entering,
                                  surface.object);
    }
    path_.last.position = surface.at.position;
    path_.last.pick_normal = transmissive_ ? Vec3f{0, 0, 0} : surface.outward;
    path_.last.facing = facing(surface);
    path_.last.lights = surface.object->lights;
    path_.last.plan = plan;
    path_.last.pdf = pdf;
    path_.last.delta = delta;
    path_.last.samples_only = surface.object->tampers_with_shadows();
    path_.last.next_segment = path_.segment + 1;
    path_.fans_out &= delta;
    if (scene_.reads_footprints)
        widen(path_.footprint, surface.t, delta ? kInfinity : pdf,
              scene_.settings.footprint_samples);
    ray = {start_of_ray(surface, sample.wi), sample.wi, 0, kInfinity, surface.at.time};
    return true;
}

template <class Tracker>
std::optional<std::size_t> Integrator<Tracker>::draw(float u, std::optional<GiKind> kind) const {
    const std::size_t n = n_channels_ > 0 ? n_scatterers() : 0;
    // Rounding may leave a crumb behind the last one: it belongs to the last that can be drawn.
    std::optional<std::size_t> drawn;
    for (std::size_t i = 0; i < n; ++i) {
        if (!(probability_[i] > 0) || (kind && kind_of_[i] != *kind)) continue;
        drawn = i;
        if (u < probability_[i]) break;
        u -= probability_[i];
    }
    return drawn;
}

/// What the camera still sees after a vertex: what goes through channels that make no event.
template <class Tracker>
void Integrator<Tracker>::see_past(std::span<const Color> factors) {
    Color through;
    for (std::size_t c = 0; c < n_channels_; ++c)
        if (channels_[c].record->makes_no_event) through += factors[c];
    path_.passed *= through;
    if (is_black(path_.passed)) return;
    // Past the depth limit is black, and not a hole.
    for (std::size_t c = 0; c < n_channels_; ++c) {
        if (!channels_[c].record->makes_no_event || is_black(factors[c])) continue;
        for (const PathGroup& g : path_.groups.all()) {
            if (!g.key.seen() || !depth_steps_.next(g.key, *channels_[c].record).lights_only())
                continue;
            out_->add_alpha(average(path_.passed), path_.passed);
            path_.passed = kBlack;
            return;
        }
    }
}

template <class Tracker>
bool Integrator<Tracker>::advance(std::span<const Color> factors,
                                  [[maybe_unused]] std::size_t drawn) {
    // Every share splits over the channels.
    const std::span<const Channel> channels(channels_.data(), n_channels_);
    const auto coin = [this](std::uint32_t stream) { return random(16 + stream); };
    std::span<const Channel> counted = channels;
#ifdef LIGHTSIEVE_FAULT_INJECTION
    std::array<Channel, kMaxChannels> as_drawn;
    as_drawn.fill(channels_[channel_of_[drawn]]);
    if (active_fault() == Fault::DepthFromDrawnLobe)
        counted = std::span<const Channel>(as_drawn.data(), n_channels_);
#endif
    if (seen()) see_past(factors);
    path_.groups.scatter(counted, factors, depth_steps_, coin, step_);
    tracker_.scatter(channels, factors, step_, coin);
    ++path_.n_scatter;
    if (is_black(path_.groups.total())) return false;
    if (!survives_roulette()) return false;
    const std::span<const PathGroup> groups = path_.groups.all();
    path_.exit_pending = std::any_of(groups.begin(), groups.end(),
                                     [](const PathGroup& g) { return g.key.exits(); });
    return true;
}

/// Past the depth limits only lights that can be met are.
template <class Tracker>
bool Integrator<Tracker>::is_worth_a_ray() const {
    const std::span<const PathGroup> groups = path_.groups.all();
    return scene_.lights_can_be_met || path_.exit_pending ||
           !std::all_of(groups.begin(), groups.end(),
                        [](const PathGroup& g) { return g.key.lights_only(); });
}

template <class Tracker>
bool Integrator<Tracker>::scatter_below(const Surface& surface, std::size_t drawn, Ray& ray) {
    const SubsurfaceClosure& closure =
        closures_.subsurfaces()[drawn - closures_.closures().size()];
    const std::span<Color> factors = cleared_values();
    factors[channel_of_[drawn]] = closure.weight * (1 / probability_[drawn]);
    if (!advance(factors, drawn)) return false;
    const std::optional<WalkExit> exit =
        walk_below(scene_, surface, closure.medium, points_.direction, path_.sampler,
                   hash_combine(path_.segment, kWalkStream), counts.rays_of(RayKind::Subsurface));
    if (!exit) return false;
    path_.groups.scale(exit->throughput);
    tracker_.scale(exit->throughput);
    add_light_at_exit(*exit);

    // It leaves as from a Lambertian surface: cosine over density is 1.
    const Vec3f wi = Frame::from_z(exit->normal)
                         .world_from_local(sample_cosine_hemisphere({random(8), random(9)}));
    if (!(dot(wi, exit->outside) > 0)) return false;
    const Surface& at = exit->surface;
    path_.last.position = at.at.position;
    path_.last.pick_normal = exit->outside;
    path_.last.facing = at.object->tampers_with_shadows() ? Vec3f{} : exit->normal;
    path_.last.lights = at.object->lights;
    path_.last.plan = LightPlan::Pick;
    path_.last.pdf = kInvPi * dot(exit->normal, wi);
    path_.last.delta = false;
    path_.last.samples_only = at.object->tampers_with_shadows();
    path_.last.next_segment = path_.segment + 1;
    path_.fans_out = false;
    if (scene_.reads_footprints)
        widen(path_.footprint, surface.t, path_.last.pdf, scene_.settings.footprint_samples);
    ray = {offset_ray_origin(at.at.position, exit->outside), wi, 0, kInfinity, at.at.time};
    return true;
}

/// Ends faint paths early; what survives carries more. Goes by the shares of the beauty, never by what AOVs are asked for.
template <class Tracker>
bool Integrator<Tracker>::survives_roulette() {
    if (scene_.settings.roulette_depth < 0 || path_.n_scatter <= scene_.settings.roulette_depth)
        return true;
    const float start = max_component(path_.start) / path_.siblings;
    const float q =
        std::clamp(max_component(path_.groups.total()) / start, kLeastSurvival, kMostSurvival);
    if (points_.roulette.x >= q) return false;
    path_.groups.scale(Color::grey(1 / q));
    tracker_.scale(Color::grey(1 / q));
    path_.passed *= 1 / q;
    return true;
}

// Explicitly, member by member: the class as a whole is instantiated in integrator.cpp.
#define LIGHTSIEVE_SCATTER(Tracker)                                                             \
    template Color Integrator<Tracker>::reach(const Channel&) const;                            \
    template void Integrator<Tracker>::choose_probabilities();                                  \
    template std::optional<std::size_t> Integrator<Tracker>::draw(float, std::optional<GiKind>) \
        const;                                                                                  \
    template bool Integrator<Tracker>::go_on(const Surface&, Ray&);                             \
    template void Integrator<Tracker>::pass_straight(const Surface&, Ray&, float);              \
    template bool Integrator<Tracker>::scatter(const Surface&, std::size_t, Ray&);              \
    template void Integrator<Tracker>::see_past(std::span<const Color>);                        \
    template bool Integrator<Tracker>::advance(std::span<const Color>, std::size_t);            \
    template bool Integrator<Tracker>::scatter_below(const Surface&, std::size_t, Ray&);        \
    template bool Integrator<Tracker>::survives_roulette();                                     \
    template bool Integrator<Tracker>::is_worth_a_ray() const;
LIGHTSIEVE_SCATTER(AovTracker)
LIGHTSIEVE_SCATTER(LogTracker)
#undef LIGHTSIEVE_SCATTER

}  // namespace lightsieve
