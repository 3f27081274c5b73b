// Where a path splits: at the first vertex that the camera sees, be it in perfect mirrors, all lights are asked and as many
// rays go on as options.GI_*_samples say; from there on each is a single path.
//
// Rays of each kind are drawn from the scatterers of that kind alone, so that a faint reflection gets its rays however
// bright the rest is, and carry light through these alone: what a kind sends on does not get noisier by rays that were
// drawn for another. Within a kind a direction belongs to every lobe (balance heuristic, Veach 1997, eq. 9.15), and light
// samples are weighted against the rays of the kind. A number of rays need not be whole: chance decides about the rest.
//
// One sample of each kind means one path, as everywhere else, whose kind is drawn by what it can carry on and which carries
// light through all: of one sample that is the best use (Veach 1997, section 9.2.4). Of the rays that
// the options ask for beyond that, the faint kinds get fewer, by the root of their share: by the share itself the beauty
// would have the least noise for its time, but the layers of faint kinds ever more. The share is that in the colour where
// it is largest: upon a red wall the gloss is most of what is blue.
#include <algorithm>
#include <cmath>

#include "render/integrator.h"
#include "render/path_log.h"

namespace lightsieve {
namespace {

/// Up to so many lights are all asked where a path splits.
constexpr std::size_t kMostLights = 16;
/// Rays of a kind at least, on average: chance must be able to make one that does not stand for everything.
constexpr float kLeastRays = 0x1p-8F;
/// Families of split samples, see Sampler::split: lights, picks, kinds of rays (as many as there are kinds).
constexpr std::uint32_t kKindFamily = 0, kPickFamily = 32, kLightFamily = 33;
/// Streams of random numbers: samples of little effect.
constexpr std::uint32_t kCoinStream = 2;

/// The largest of the colours' shares of what the strongest kind carries, 0 to 1; 1 where nobody knows.
float largest_share(Color carried, Color most) {
    float share = 0;
    for (int c = 0; c < 3; ++c)
        if (most[c] > 0) share = std::max(share, carried[c] / most[c]);
    return is_black(most) ? 1 : share;
}

}  // namespace

template <class Tracker>
auto Integrator<Tracker>::light_plan(const LightSampler& lights, bool in_medium) const
    -> LightPlan {
    if (!path_.fans_out || lights.empty()) return LightPlan::Pick;
    if (path_.n_scatter > 0) return LightPlan::Once;
    return in_medium ? LightPlan::OftenInVolume : LightPlan::Often;
}

template <class Tracker>
float Integrator<Tracker>::light_samples(LightPlan plan, const LightSampler& lights,
                                         Vec3f position, Vec3f normal, std::uint32_t index) const {
    if (plan == LightPlan::Pick) return lights.probability(position, normal, index);
    if (lights.lights().size() > kMostLights)
        return static_cast<float>(scene_.settings.gi_samples.light_picks()) *
               lights.probability(position, normal, index);
    if (!lights.contains(index)) return 0;
    const SceneLight& light = scene_.lights[index];
    if (plan == LightPlan::Once) return 1;
    return static_cast<float>(plan == LightPlan::Often ? light.n_samples : light.n_volume_samples);
}

template <class Tracker>
void Integrator<Tracker>::ask_lights(const Surface& surface, LightPlan plan) {
    const LightSampler& lights = *surface.object->lights;
    const Vec3f position = surface.at.position;
    const Vec3f normal = transmissive_ ? Vec3f{0, 0, 0} : surface.outward;
    const std::uint32_t pair = kFirstPair + path_.segment * kPairsPerSegment;
    // One sample is the path's own point; several are parts of it, and so of one pattern.
    if (lights.lights().size() > kMostLights) {
        const auto n = static_cast<std::uint32_t>(scene_.settings.gi_samples.light_picks());
        const auto pick_and_ask = [&](float u_pick, Vec2f u, float coin) {
            const LightPick pick = lights.pick(position, normal, u_pick);
            if (pick.probability > 0)
                ask_light(surface, pick.light, static_cast<float>(n) * pick.probability, u, coin);
        };
        if (n == 1) return pick_and_ask(points_.choice.y, points_.light, random(kCoinStream));
        for (std::uint32_t i = 0; i < n; ++i) {
            const Sampler part = path_.sampler.split(kPickFamily, i, n);
            pick_and_ask(part.at2(pair).y, part.at2(pair + 2), part.random(kCoinStream));
        }
        return;
    }
    const bool one_light = lights.lights().size() == 1;
    for (const std::uint32_t index : lights.lights()) {
        const float samples = light_samples(plan, lights, position, normal, index);
        const auto n = static_cast<std::uint32_t>(samples);
        if (n == 1 && one_light)
            return ask_light(surface, index, 1, points_.light, random(kCoinStream));
        for (std::uint32_t i = 0; i < n; ++i) {
            const Sampler part = path_.sampler.split(kLightFamily + index, i, n);
            ask_light(surface, index, samples, part.at2(pair + 2), part.random(kCoinStream));
        }
    }
}

/// Whether rays through the channel are past their depth limit, for all that comes by them, and there are no lights that
/// they could meet.
template <class Tracker>
bool Integrator<Tracker>::leads_nowhere(const Channel& channel) const {
    if (scene_.lights_can_be_met) return false;
    // Rays that find the background in place of a surface, or show that there is something, are worth it.
    if (channel.record->exit_to_background || channel.record->makes_no_event) return false;
    const std::span<const PathGroup> groups = path_.groups.all();
    return std::all_of(groups.begin(), groups.end(), [&](const PathGroup& g) {
        return g.key.lights_only() ||
               scene_.depth_rules.next(g.key, *channel.record).lights_only();
    });
}

/// How much of what the camera sent out reaches the surface and does not pass it, 0 to 1.
template <class Tracker>
float Integrator<Tracker>::carried() const {
    const float start = luminance(path_.start) / path_.siblings;
    const float stays = 1 - std::clamp(average(closures_.transparency()), 0.0F, 1.0F);
    return start > 0 ? std::clamp(luminance(path_.groups.total()) / start, 0.0F, 1.0F) * stays : 0;
}

/// How many rays a vertex in a medium sends on. The same for all points of a ray: points along it are weighted by it.
template <class Tracker>
float Integrator<Tracker>::volume_rays(const Channel& channel) const {
    const int n = scene_.settings.gi_samples.volume;
    if (n == 0 || path_.n_scatter > 0 || !path_.fans_out) return n == 0 ? 0 : 1;
    return leads_nowhere(channel) ? 0 : static_cast<float>(n);
}

/// Sorts the scatterers by the kind of their rays.
template <class Tracker>
auto Integrator<Tracker>::sort_by_kind() -> std::array<KindSum, kGiKinds> {
    std::array<KindSum, kGiKinds> out{};
    for (std::size_t i = 0; i < n_scatterers(); ++i) {
        const Channel& channel = channels_[channel_of_[i]];
        if (!(probability_[i] > 0)) continue;
        KindSum& sum = out[static_cast<std::size_t>(kind_of_[i])];
        sum.probability += probability_[i];
        sum.carries += carries_[i];
        sum.channel = &channel;
        sum.goes_on = sum.goes_on || !leads_nowhere(channel);
    }
    return out;
}

/// Lets the scatterers of each kind have rays of their own, if there are several of any kind.
template <class Tracker>
void Integrator<Tracker>::separate_kinds() {
    const std::span<const Channel> channels(channels_.data(), n_channels_);
    if (std::none_of(channels.begin(), channels.end(), [&](const Channel& channel) {
            return scene_.settings.gi_samples.of(gi_kind(*channel.record, false)) > 1;
        }))
        return;
    for (std::size_t c = 0; c < n_channels_; ++c)
        if (mixture_[c] != kNoRays)
            mixture_[c] = static_cast<std::uint8_t>(gi_kind(*channels_[c].record, false));
}

/// How many rays of a kind go on.
///
/// share    of what all scatterers carry, 0 to 1; largest_share: see the head of the file
template <class Tracker>
float Integrator<Tracker>::rays_of(GiKind kind, const Channel& channel, float share,
                                   float largest_share) const {
    const auto most = static_cast<float>(scene_.settings.gi_samples.of(kind));
    switch (kind) {
        case GiKind::Volume: return volume_rays(channel);
        case GiKind::Mirror:
        case GiKind::Clear:
            // Behind mirrors as many as come: a hall of mirrors must not make ever more.
            return path_.n_scatter > 0 ? most * share : most;
        default: break;
    }
    const float rays = carried() * (share + (most - 1) * std::sqrt(largest_share));
    return most > 0 ? std::max(kLeastRays, rays) : 0;
}

/// How many rays of each kind go on: on average, or in all where that is at least 1.
template <class Tracker>
auto Integrator<Tracker>::choose_ray_counts() -> RayCounts {
    RayCounts out;
    const std::size_t n = n_channels_ > 0 ? n_scatterers() : 0,
                      n_closures = closures_.closures().size();
    for (std::size_t i = 0; i < n; ++i)
        kind_of_[i] =
            gi_kind(*channels_[channel_of_[i]].record, i < n_closures && closures_.delta(i));
    // Walks below the surface ask lights themselves.
    if (n == 1 && probability_[0] > 0) {
        const auto k = static_cast<std::size_t>(kind_of_[0]);
        if (kind_of_[0] == GiKind::Subsurface || !leads_nowhere(channels_[0]))
            out.rays[k] = rays_of(kind_of_[0], channels_[0], 1, 1);
        out.round(points_.choice.x);
        probability_[0] = out.rays[k];
    } else if (n > 1) {
        const std::array<KindSum, kGiKinds> sums = sort_by_kind();
        separate_kinds();
        float total = 0;
        Color most_carried;
        for (const KindSum& sum : sums) {
            total += sum.probability;
            for (int c = 0; c < 3; ++c)
                most_carried[c] = std::max(most_carried[c], sum.carries[c]);
        }
        for (std::size_t k = 0; k < kGiKinds; ++k) {
            const KindSum& sum = sums[k];
            const auto kind = static_cast<GiKind>(k);
            if (sum.probability > 0 && (sum.goes_on || kind == GiKind::Subsurface))
                out.rays[k] = rays_of(kind, *sum.channel, sum.probability / total,
                                      largest_share(sum.carries, most_carried));
        }
        out.round(points_.choice.x);
        for (std::size_t i = 0; i < n; ++i) {
            const auto k = static_cast<std::size_t>(kind_of_[i]);
            if (probability_[i] > 0) probability_[i] *= out.rays[k] / sums[k].probability;
        }
    }
    return out;
}

/// Systematic rounding: one number decides for all kinds, so that parts of rays that add up to one make just one. Where there
/// is at least one ray the kind is shared by those that there are, not by those that there are on average: their number
/// then brings no noise.
template <class Tracker>
void Integrator<Tracker>::RayCounts::round(float u) {
    double sum = static_cast<double>(u);
    for (std::size_t k = 0; k < kGiKinds; ++k) {
        if (!(rays[k] > 0)) continue;
        const double average = static_cast<double>(rays[k]), part = sum - std::floor(sum);
        n[k] = static_cast<std::uint32_t>(part + average);
        sum += average;
        total += n[k];
        if (rays[k] >= 1) rays[k] = static_cast<float>(n[k]);
        if (n[k] != 1) continue;
        // What is known of `part` where it makes one ray, stretched to what that ray stands for.
        last = k;
        left = static_cast<float>(average <= 1 ? part + average - 1 : part / (2 - average));
    }
}

template <class Tracker>
bool Integrator<Tracker>::fan_out(const Surface& surface, Ray& ray) {
    const RayCounts counted = choose_ray_counts();
    if (n_channels_ > 0 && !all_delta_) add_light_samples(surface);
    const bool straight = pass_probability_ > 0;
    if (counted.total == 1 && !straight) {
        // The path does not split: it goes on by its own points. What rounding left over is evenly spread again.
        const std::optional<std::size_t> drawn =
            draw(counted.left, static_cast<GiKind>(counted.last));
        return drawn && scatter(surface, *drawn, ray);
    }
    if (counted.total > 0) split(surface, ray, counted);
    if (!straight) return false;
    pass_straight(surface, ray, 1);
    return ray.t_max > 0;
}

/// Puts a path aside for each ray. The path stays as it is.
template <class Tracker>
void Integrator<Tracker>::split(const Surface& surface, const Ray& ray, const RayCounts& counted) {
    const auto& rays = counted.rays;
    const auto& n = counted.n;
    before_.path = path_;
    tracker_.save(before_.terms);
    for (std::size_t k = 0; k < kGiKinds; ++k)
        for (std::uint32_t i = 0; i < n[k]; ++i) {
            path_.sampler =
                path_.sampler.split(kKindFamily + static_cast<std::uint32_t>(k), i, n[k]);
            path_.siblings *= std::max(rays[k], 1.0F);
            const std::array<Vec2f, 4> points =
                path_.sampler.at2x4(kFirstPair + path_.segment * kPairsPerSegment);
            points_ = {points[0], points[1], points[2], points[3]};
            Ray next = ray;
            const std::optional<std::size_t> drawn =
                draw(points_.choice.x * rays[k], static_cast<GiKind>(k));
            if (drawn && scatter(surface, *drawn, next)) {
                ++path_.segment;
                put_aside(next);
            }
            path_ = before_.path;
            tracker_.restore(before_.terms);
        }
}

template <class Tracker>
void Integrator<Tracker>::put_aside(const Ray& ray) {
    if (n_forks_ == forks_.size()) forks_.emplace_back();
    Fork& fork = forks_[n_forks_++];
    fork.path = path_;
    fork.ray = ray;
    tracker_.save(fork.terms);
}

// Explicitly, member by member: the class as a whole is instantiated in integrator.cpp.
#define LIGHTSIEVE_FAN(Tracker)                                                                  \
    template auto Integrator<Tracker>::light_plan(const LightSampler&, bool) const -> LightPlan; \
    template float Integrator<Tracker>::light_samples(LightPlan, const LightSampler&, Vec3f,     \
                                                      Vec3f, std::uint32_t) const;               \
    template void Integrator<Tracker>::ask_lights(const Surface&, LightPlan);                    \
    template bool Integrator<Tracker>::leads_nowhere(const Channel&) const;                      \
    template float Integrator<Tracker>::carried() const;                                         \
    template float Integrator<Tracker>::volume_rays(const Channel&) const;                       \
    template auto Integrator<Tracker>::sort_by_kind() -> std::array<KindSum, kGiKinds>;          \
    template void Integrator<Tracker>::separate_kinds();                                         \
    template auto Integrator<Tracker>::choose_ray_counts() -> RayCounts;                         \
    template float Integrator<Tracker>::rays_of(GiKind, const Channel&, float, float) const;     \
    template bool Integrator<Tracker>::fan_out(const Surface&, Ray&);                            \
    template void Integrator<Tracker>::RayCounts::round(float);                                  \
    template void Integrator<Tracker>::split(const Surface&, const Ray&, const RayCounts&);      \
    template void Integrator<Tracker>::put_aside(const Ray&);
LIGHTSIEVE_FAN(AovTracker)
LIGHTSIEVE_FAN(LogTracker)
#undef LIGHTSIEVE_FAN

}  // namespace lightsieve
