#include "render/integrator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/sampling.h"
#include "render/faults.h"
#include "render/integrator_deposit.h"
#include "render/path_log.h"

namespace lightsieve {
namespace {

/// Shadow rays end this much (relative) before a light, so that they do not meet its own shape.
constexpr float kShadowEpsilon = 1e-5F;
/// Lamps lie in ceilings: a lamp behind a surface still counts as in front if its plane is no farther off than positions of
/// this size are rounded (relative). Along a slanting ray that may be more, up to kCoplanar (relative).
constexpr float kCoplanar = 1e-4F, kRounding = 1e-6F;
/// Area lights that one ray may pass.
constexpr int kMaxLightsAlongRay = 256;
/// Light samples of little effect are traced at least this often.
constexpr float kLeastSurvival = 0.05F;
/// Segments of a path, transparent surfaces included: a guard against geometry that rays cannot leave.
constexpr std::uint32_t kMaxSegments = 1024;
/// Of the numbers that shaders' own random numbers start from; the others are small.
constexpr std::uint32_t kShaderStream = 64;

/// The sampler's pair of dimensions for the path's wavelength; camera_sample has those before it.
constexpr std::size_t kWavelengthPair = 3;

float unit(float v) { return std::clamp(v, 0.0F, 1.0F); }

/// The ray of a group as a bit of a mask.
std::uint32_t bit_of(const PathGroup& group) { return ray_bit(group.key.ray_type); }

/// Whether a lamp that a ray meets `beyond` a surface (along the ray) lies farther behind it than rounding explains.
bool is_behind(const LightHit& lamp, float beyond, const Ray& ray) {
    if (!(beyond > 0)) return false;
    const Vec3f p = lamp.position;
    const float size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) + lamp.distance;
    return beyond * std::abs(dot(lamp.normal, ray.direction)) > kRounding * size;
}

#ifdef LIGHTSIEVE_FAULT_INJECTION
/// Emission of some shader of the scene, or black background if nothing shines.
Terminal any_object(const Scene& scene) {
    for (const auto& shader : scene.shaders)
        for (const LobeRecord& record : shader->records)
            if (record.kind == EventKind::Object) return {record.terminal, record.event};
    return {scene.background_record.terminal, scene.background_record.event};
}
#endif

}  // namespace

template <class Tracker>
void Integrator<Tracker>::trace(const CameraRay& camera_ray, float time,
                                const Mat4f& camera_from_world, const Sampler& sampler,
                                SampleBuffer& out) {
    // The camera event: one share of throughput.
    sampler_ = &sampler;
    out_ = &out;
    out.clear();
    out.written.resize(scene_.plan.written.size(), {kBlack, 0});
    written_.resize(scene_.plan.written.size());
    if (!(camera_ray.weight > 0)) return;  // the camera sees nothing there
    path_start_ = Color::grey(camera_ray.weight);
    groups_.start(path_start_);
    tracker_.start(path_start_, out);
    last_ = {};
    footprint_ = {camera_ray.width, camera_ray.spread};
    passed_ = kWhite;
    interiors_.clear();
    wavelength_ =
        scene_.disperses ? sample_wavelength(sampler.at2x4(0)[kWavelengthPair].x) : Wavelength{};
    monochromatic_ = knows_first_ = false;
    n_scatter_ = n_transparent_ = 0;
    n_shadow_rays_ = 0;
    exit_pending_ = false;
    state.bounces = state.diffuse = state.specular = state.transmission = state.volume = 0;
    state.camera_from_world = &camera_from_world;
    state.pixel_angle = camera_ray.spread;
    Ray ray{camera_ray.origin, camera_ray.direction, camera_ray.t_min, camera_ray.t_max, time};

    for (segment_ = 0; segment_ < kMaxSegments && wanted(); ++segment_) {
        // Find the next surface, and the lights before it.
        choose_mask_group();
        update_state();
        if (exit_pending_) add_exit_background(ray);
        lights_only_ = std::all_of(groups_.all().begin(), groups_.all().end(),
                                   [](const PathGroup& g) { return g.key.lights_only; });
        RayHit hit;
        ++counts.rays;
        const bool met = scene_.accel->intersect(ray, ray_mask(), hit);
        begin_media(ray, met ? hit.t : ray.t_max);
        if (by_shadow_rays() && segment_ == last_.next_segment) {
            if (scene_.light_accel) (void)add_area_lights(ray, ray.t_max);
            add_infinite_lights(ray);
        }

        // The next vertex: on a surface, or before it in a medium. A ray that leaves the scene brings infinite lights and
        // the background.
        const Passage passage = pass(ray, met ? hit.t : ray.t_max);
        if (passage == Passage::Ended) return;
        const bool in_medium = passage == Passage::Scattered;
        if (!in_medium && !met) return add_escape(ray);
        if (!in_medium && lights_only_ && !scene_.objects[hit.object].may_be_transparent) return;
        // Made in place: points are too large to copy.
        Surface surface = in_medium
                              ? Surface(medium_vertex_)
                              : make_surface(scene_.objects[hit.object], ray, hit, footprint_);
        if (!in_medium) {
            surface.at.ray_type = groups_[0].key.ray_type;
            const Arrival arrival = arrive(surface, ray, camera_from_world);
            if (arrival == Arrival::Ended) return;
            if (arrival == Arrival::Passed) continue;
        }

        // What may happen to light here, by event.
        n_channels_ = 0;
        if (!lights_only_) {
            gather_channels(surface);
            if (scene_.plan.wants_probes && tracker_.live_probe()) add_probes();
        }

        // Direct light, value by lobe; then a direction from the mixture, and every share splits over the lobes.
        const std::array<Vec2f, 4> points =
            sampler.at2x4(kFirstPair + segment_ * kPairsPerSegment);
        points_ = {points[0], points[1], points[2], points[3]};
        choose_probabilities();
        if (n_channels_ > 0 && !all_delta_) add_light_samples(surface);
        if (!scatter(surface, ray)) return;
    }
}

template <class Tracker>
auto Integrator<Tracker>::arrive(Surface& surface, Ray& ray, const Mat4f& camera_from_world)
    -> Arrival {
    // Surfaces may have one side only, or be holes in the picture.
    const SceneObject& object = *surface.object;
    if (!surface.at.entering && (object.sidedness & ray_bit(surface.at.ray_type)) == 0) {
        go_straight(surface, ray);
        return Arrival::Passed;
    }
    if (object.matte && surface.at.ray_type == RayType::Camera) return Arrival::Ended;
    surface.at.ray = &state;
    start_writing();
    tell_path(surface.at, interiors_, surface.shader);
    closures_.begin(surface.at.wo, surface.frame);
    surface.shader->closures(surface.at, closures_);
    counts.dropped_closures += closures_.n_dropped();
    absorb(surface);
    if (pass_hidden_surface(surface, ray)) return Arrival::Passed;
    if (state.written != nullptr) write_aovs(surface.at);
    if (closures_.shadow_matte() != nullptr) add_shadow_matte(surface, ray);
    if (seen()) note_first_hit(surface, camera_from_world);
    if (!lights_only_) add_emission();
    return Arrival::There;
}

template <class Tracker>
auto Integrator<Tracker>::pass(const Ray& ray, float t_surface) -> Passage {
    if (scene_.light_accel && !by_shadow_rays())
        if (const Passage end = add_area_lights(ray, t_surface); end != Passage::Free) return end;
    return travel(ray, t_surface);
}

/// Where masks tell shares of the ray apart, one of them goes on, chosen by luminance.
template <class Tracker>
void Integrator<Tracker>::choose_mask_group() {
    const std::span<const PathGroup> groups = groups_.all();
    if (groups.size() < 2 || scene_.mask_types == 0) return;
    const auto kind = [&](const PathGroup& g) { return bit_of(g) & scene_.mask_types; };
    const std::uint32_t first = kind(groups[0]);
    if (std::all_of(groups.begin(), groups.end(),
                    [&](const PathGroup& g) { return kind(g) == first; }))
        return;
    float total = 0;
    for (const PathGroup& g : groups)
        total += luminance(g.throughput);
    float u = random(1) * total;
    std::size_t chosen = 0;
    while (chosen + 1 < groups.size() && u >= luminance(groups[chosen].throughput))
        u -= luminance(groups[chosen++].throughput);
    const float y = luminance(groups[chosen].throughput);
    if (!(y > 0)) return;
    passed_ *= groups_[chosen].key.seen ? total / y : 0;
    groups_.keep_only(chosen, total / y);
    tracker_.keep_only(chosen, total / y);
}

/// Counts for shaders the event that the ray came by.
template <class Tracker>
void Integrator<Tracker>::update_state() {
    state.seed = static_cast<std::uint32_t>(random(kShaderStream) * 0x1p24F);
    state.transparent = n_transparent_;
    if (state.bounces == n_scatter_) return;
    state.bounces = n_scatter_;
    switch (groups_[0].key.ray_type) {
        case RayType::Camera:
        case RayType::Shadow: break;
        case RayType::SpecularReflect: ++state.specular; break;
        case RayType::SpecularTransmit: ++state.transmission; break;
        case RayType::Volume: ++state.volume; break;
        default: ++state.diffuse; break;
    }
}

template <class Tracker>
std::uint32_t Integrator<Tracker>::ray_mask() const {
    std::uint32_t mask = 0;
    for (const PathGroup& g : groups_.all())
        mask |= bit_of(g);
    return mask;
}

/// Factor on a light by the event before it: its contribution multipliers.
template <class Tracker>
float Integrator<Tracker>::light_factor(const LightCommon& light, RayType type,
                                        int n_scatter) const {
    if (n_scatter - 1 > light.max_bounces) return 0;
    const float indirect = n_scatter > 1 ? light.indirect : 1;
    switch (type) {
        case RayType::Camera: return light.camera;
        case RayType::SpecularTransmit: return light.transmission * indirect;
        case RayType::SpecularReflect: return light.specular * indirect;
        case RayType::Subsurface: return light.sss * indirect;
        case RayType::Volume: return light.volume * indirect;
        default: return light.diffuse * indirect;
    }
}

/// indirect_sample_clamp: one factor for all shares of light that scattered more than once.
template <class Tracker>
float Integrator<Tracker>::clamp_factor(Color total, int n_scatter) const {
    const float largest = max_component(total);
    return n_scatter > 1 && largest > scene_.settings.indirect_clamp
               ? scene_.settings.indirect_clamp / largest
               : 1;
}

/// Notes a contribution that is not finite; it is left out.
template <class Tracker>
void Integrator<Tracker>::drop(std::uint32_t event) {
    ++counts.dropped;
    counts.dropped_event = event;
    counts.dropped_depth = n_scatter_;
}

/// Adds the area lights that the ray meets before `t_surface`, after the media before each.
template <class Tracker>
auto Integrator<Tracker>::add_area_lights(const Ray& ray, float t_surface) -> Passage {
    Ray rest = ray;
    rest.t_max = t_surface * (1 + kCoplanar);
    RayHit hit;
    for (int i = 0;
         i < kMaxLightsAlongRay && scene_.light_accel->intersect(rest, 0xffffffffU, hit); ++i) {
        const std::uint32_t index = scene_.light_of_object[hit.object];
        const SceneLight& light = scene_.lights[index];
        const LightHit at = make_light_hit(scene_.light_objects[hit.object], ray, hit);
        if (is_behind(at, hit.t - t_surface, ray)) return Passage::Free;
        // Where shadow rays decide, they weigh the media, too.
        if (!by_shadow_rays())
            if (const Passage end = travel(ray, std::min(hit.t, t_surface)); end != Passage::Free)
                return end;
        rest.t_min = std::nextafter(hit.t, kInfinity);
        Terminal terminal{light.as_light, light.light_event};
#ifdef LIGHTSIEVE_FAULT_INJECTION
        if (active_fault() == Fault::LightHitAsObject && n_scatter_ > 0)
            terminal = any_object(scene_);
#endif
        if (n_scatter_ == 0) {
            // Seen directly: the light stands in the picture as far as its `camera` says.
            const float seen = light.common.camera;
            if (!(seen > 0)) continue;
            const Color radiance = light.light->hit(ray.origin, at).radiance;
            if (is_black(radiance)) continue;
            deposit(terminal, [&](std::size_t) { return radiance * seen; });
            const float hidden = std::min(seen, 1.0F);
            out_->alpha += average(passed_) * hidden;
            if (hidden >= 1) return Passage::Ended;
            groups_.scale(Color::grey(1 - hidden));
            tracker_.scale(Color::grey(1 - hidden));
            passed_ *= 1 - hidden;
            continue;
        }
        LightHit seen_from = at;
        seen_from.distance = length(at.position - last_.position);
        if (seen()) {
            const float hidden = unit(light.common.transmission);
            out_->alpha += average(passed_) * hidden;
            passed_ *= 1 - hidden;
        }
        add_met_light(index, light.light->hit(last_.position, seen_from), terminal, ray,
                      hit.t * (1 - kShadowEpsilon));
    }
    return Passage::Free;
}

/// Light that a ray from the last vertex met by chance: the twin of a light sample, and weighted against it.
template <class Tracker>
void Integrator<Tracker>::add_met_light(std::uint32_t index, const LightEval& eval,
                                        Terminal terminal, const Ray& ray, float distance) {
    const SceneLight& light = scene_.lights[index];
    if (is_black(eval.radiance) || (!last_.delta && (light.samples_only || last_.samples_only)))
        return;
    const float pick = last_.lights->probability(last_.position, last_.pick_normal, index);
    if (!(pick > 0)) return;  // in the dark by its own bounds, or not in the shape's light group
    Color arriving =
        eval.radiance * (last_.delta ? 1 : power_heuristic(last_.pdf, pick * eval.pdf));
    if (by_shadow_rays()) {
        Ray shadow = ray;
        shadow.t_max = distance;
        arriving *=
            visibility_along(shadow, nullptr, index).straight * media_transmittance(shadow);
    }
    const auto brought = [&](std::size_t g) {
        if (!groups_.direct_light(g)) return kBlack;
        return arriving * light_factor(light.common, groups_[g].key.ray_type, n_scatter_);
    };
    // A skydome that is seen, be it through glass, is background.
    if (!light.is_skydome || !some_group_is_seen()) return deposit(terminal, brought);
    deposit(terminal, [&](std::size_t g) { return groups_[g].key.seen ? kBlack : brought(g); });
    deposit({light.as_background, light.background_event},
            [&](std::size_t g) { return groups_[g].key.seen ? brought(g) : kBlack; });
}

/// Where shadow rays see other shapes than other rays do, they decide for both twins what hides a light.
template <class Tracker>
bool Integrator<Tracker>::by_shadow_rays() const {
    return scene_.shadows_by_mask && n_scatter_ > 0 && !last_.delta;
}

/// Infinite lights along a ray that meets nothing. Returns the alpha of those that the camera sees.
template <class Tracker>
float Integrator<Tracker>::add_infinite_lights(const Ray& ray) {
    float alpha = 0;
    for (const std::uint32_t index : scene_.infinite_lights) {
        const SceneLight& light = scene_.lights[index];
        const LightEval eval = n_scatter_ == 0
                                   ? light.light->seen(ray.origin, ray.direction)
                                   : light.light->escape(last_.position, ray.direction);
        const float shown = n_scatter_ == 0 ? light.common.camera : light.common.transmission;
        if (seen() && (eval.pdf > 0 || !is_black(eval.radiance) || light.is_skydome))
            alpha = std::max(alpha, unit(shown));
        // A skydome seen directly is background, and so is the light of one with aov_indirect.
        const bool background = light.is_skydome && (n_scatter_ == 0 || light.common.aov_indirect);
        const Terminal terminal = background
                                      ? Terminal{light.as_background, light.background_event}
                                      : Terminal{light.as_light, light.light_event};
        if (n_scatter_ > 0) {
            add_met_light(index, eval, terminal, ray, kInfinity);
        } else if (!is_black(eval.radiance)) {
            deposit(terminal, [&](std::size_t) {
                return eval.radiance * light_factor(light.common, RayType::Camera, 0);
            });
        }
    }
    return alpha;
}

/// Infinite lights and the background shader.
template <class Tracker>
void Integrator<Tracker>::add_escape(const Ray& ray) {
    float alpha = by_shadow_rays() ? 0 : add_infinite_lights(ray);
    if (scene_.background != nullptr && !lights_only_) {
        const auto [radiance, opaque] = background_along(ray, n_scatter_ == 0);
        const auto visible = [&](std::size_t g) {
            return (scene_.background_visibility & bit_of(groups_[g])) != 0 &&
                   !groups_[g].key.lights_only;
        };
        deposit(
            {scene_.background_record.terminal, scene_.background_record.event},
            [&](std::size_t g) { return visible(g) ? radiance * groups_.indirect(g) : kBlack; });
        for (std::size_t g = 0; g < groups_.all().size(); ++g)
            if (groups_[g].key.seen && visible(g)) alpha = std::max(alpha, unit(opaque));
    }
    if (seen()) out_->alpha += average(passed_) * alpha;
}

/// exit_to_background: shares past their depth limit take the background in place of what the ray would meet.
template <class Tracker>
void Integrator<Tracker>::add_exit_background(const Ray& ray) {
    exit_pending_ = false;
    if (scene_.background == nullptr) return;
    const Color radiance = background_along(ray, false).rgb;
    deposit(
        {scene_.background_record.terminal, scene_.background_record.event}, [&](std::size_t g) {
            return groups_[g].key.exits && (scene_.background_visibility & bit_of(groups_[g])) != 0
                       ? radiance * groups_.indirect(g)
                       : kBlack;
        });
}

/// Behind the picture the background fills the frame. What other rays see of it is its colour at uv 0 0, unless it goes by the
/// direction: in Arnold, a checkerboard lights a ball with one of its colours (reference pictures test_0098 and test_0103).
///
/// behind_picture  seen where the sample lies in the frame
template <class Tracker>
ShaderValue Integrator<Tracker>::background_along(const Ray& ray, bool behind_picture) const {
    ShadePoint at;
    at.direction = ray.direction;
    at.wo = -ray.direction;
    at.ray_type = groups_[0].key.ray_type;
    at.ray = &state;
    at.time = ray.time;
    if (behind_picture) at.uv = state.screen * 0.5F + Vec2f{0.5F, 0.5F};
    return scene_.background->value(at);
}

/// What the body that the path is inside of took away on the way to the surface. Seen from inside, a surface says itself
/// what that was: a camera may stand in the body.
template <class Tracker>
void Integrator<Tracker>::absorb(const Surface& surface) {
    const Interior& own = closures_.interior();
    const Interior* here = interiors_.here();
    // Where collisions are drawn they have taken away what is absorbed.
    if (here != nullptr && here->medium.scatters()) return;
    if (own.is_body && !surface.at.entering)
        here = is_hidden(surface, own, interiors_)
                   ? interiors_.around(surface.shader, own.priority)
                   : &own;
    if (here == nullptr || is_black(here->medium.extinction)) return;
    const Color left = transmittance(here->medium.extinction, surface.t);
    groups_.scale(left);
    tracker_.scale(left);
    if (!seen()) return;
    out_->alpha += average(passed_ * (kWhite - left));
    passed_ *= left;
}

template <class Tracker>
void Integrator<Tracker>::tell_path(ShadePoint& at, const Interiors& inside,
                                    const ShaderProgram* shader) const {
    at.wavelength = wavelength_.nm;
    at.monochromatic = monochromatic_;
    if (!scene_.settings.dielectric_priorities) return;
    const Interior* around = inside.around(shader, shader->dielectric_priority);
    if (around != nullptr) at.outer_ior = around->ior;
}

/// Whether a body's surface lies inside of a body that wins over it.
template <class Tracker>
bool Integrator<Tracker>::is_hidden(const Surface& surface, const Interior& own,
                                    const Interiors& inside) const {
    return own.is_body && scene_.settings.dielectric_priorities &&
           inside.hides(surface.shader, own);
}

template <class Tracker>
bool Integrator<Tracker>::pass_hidden_surface(const Surface& surface, Ray& ray) {
    const Interior& own = closures_.interior();
    if (!is_hidden(surface, own, interiors_)) return false;
    interiors_.cross(surface.shader, own, surface.at.entering, surface.object);
    go_straight(surface, ray);
    return true;
}

/// Puts the ray's start behind a surface.
template <class Tracker>
void Integrator<Tracker>::go_straight(const Surface& surface, Ray& ray) const {
    const Vec3f origin = start_of_ray(surface, ray.direction);
    ray.t_max -= std::max(0.0F, dot(origin - ray.origin, ray.direction));
    ray.origin = origin;
    ray.t_min = 0;
}

/// What a shadow_matte shows: what lies behind it, and the shadow over that.
template <class Tracker>
void Integrator<Tracker>::add_shadow_matte(const Surface& surface, const Ray& ray) {
    const ShadowMatte& matte = *closures_.shadow_matte();
    shadow_ = shadow_on(surface, matte);
    if (matte.alpha_is_mask) closures_.matte(matte.weight * (1 - shadow_.mask));
    const float covered = unit(shadow_.mask * matte.opacity), left = 1 - covered;
    const auto show = [&](const LobeRecord& record, Color radiance) {
        deposit({record.terminal, record.event}, [&](std::size_t g) {
            return groups_[g].key.lights_only ? kBlack
                                              : matte.weight * radiance * groups_.indirect(g);
        });
    };
    show(*matte.shadow_record, matte.shadow_color * covered);
    if (!matte.sees_background) return show(*matte.background_record, matte.background * left);
    if (scene_.background != nullptr)
        show(scene_.background_record, background_along(ray, n_scatter_ == 0).rgb * left);
    // Skydomes as the camera sees them. What other rays see of them would be a light that light samples know nothing of.
    if (n_scatter_ > 0) return;
    for (const std::uint32_t index : scene_.infinite_lights) {
        const SceneLight& light = scene_.lights[index];
        if (!light.is_skydome) continue;
        const Color radiance =
            light.light->seen(ray.origin, ray.direction).radiance * light.common.camera;
        deposit({light.as_background, light.background_event},
                [&](std::size_t) { return matte.weight * radiance * left; });
    }
}

template <class Tracker>
bool Integrator<Tracker>::some_group_is_seen() const {
    const std::span<const PathGroup> groups = groups_.all();
    return std::any_of(groups.begin(), groups.end(),
                       [](const PathGroup& g) { return g.key.seen; });
}

template <class Tracker>
void Integrator<Tracker>::add_emission(float factor) {
    for (const Emission& e : closures_.emissions())
        deposit({e.record->terminal, e.record->event}, [&](std::size_t g) {
            return groups_[g].key.lights_only ? kBlack : e.radiance * groups_.indirect(g) * factor;
        });
}

/// Lobes that make one event become one channel.
template <class Tracker>
void Integrator<Tracker>::gather_channels(const Surface& surface) {
    n_channels_ = 0;
    // The lobes of a fibre go round it, whatever side the ray sees.
    transmissive_ = surface.at.on_curve;
    all_delta_ = true;
    const auto put = [&](std::size_t scatterer, const Channel& channel) {
        std::size_t c = 0;
        while (c < n_channels_ && !channels_[c].matches(channel))
            ++c;
        if (c == n_channels_) channels_[n_channels_++] = channel;
        channel_of_[scatterer] = static_cast<std::uint8_t>(c);
    };
    const std::span<const Closure> closures = closures_.closures();
    for (std::size_t i = 0; i < closures.size(); ++i) {
        all_delta_ = all_delta_ && closures_.delta(i);
        transmissive_ |=
            closures[i].record->kind == EventKind::Transmission || has_no_sides(closures[i].model);
        put(i, {closures[i].record, closures[i].caustics, closures[i].indirect,
                closures[i].direct_light});
    }
    for (std::size_t i = closures.size(); i < n_scatterers(); ++i) {
        const SubsurfaceClosure& below = closures_.subsurfaces()[i - closures.size()];
        put(i, {below.record, true, below.indirect});
    }
}

template <class Tracker>
Color Integrator<Tracker>::albedo_of(std::size_t scatterer) const {
    const std::size_t n = closures_.closures().size();
    return scatterer < n ? closures_.albedo(scatterer)
                         : closures_.subsurfaces()[scatterer - n].albedo();
}

/// Albedo probes: what the path would carry under uniform white light. Never clamped, never part of the beauty.
template <class Tracker>
void Integrator<Tracker>::add_probes() {
    const std::span<Color> albedo = cleared_values();
    for (std::size_t i = 0; i < n_scatterers(); ++i)
        albedo[channel_of_[i]] += albedo_of(i);
    tracker_.add_scattered(
        std::span(channels_.data(), n_channels_), {scene_.probe, scene_.probe_event},
        [&](std::size_t g, std::size_t c) {
            const bool none = groups_[g].key.lights_only ||
                              !channel_allowed(groups_[g].key, channels_[c]) ||
                              channels_[c].record->makes_no_event;
            return none ? kBlack : albedo[c] * groups_.indirect(g);
        },
        1);
}

template <class Tracker>
float Integrator<Tracker>::evaluate(const Surface& surface, Vec3f wi,
                                    std::span<Color> by_channel) const {
    // No light leaks through: both normals must agree on which side of the surface wi leaves.
    const bool sides_agree = (dot(wi, surface.outward) > 0) == (dot(wi, surface.at.normal) > 0);
    const std::span<const Closure> closures = closures_.closures();
    float pdf = 0;
    for (std::size_t i = 0; i < closures.size(); ++i) {
        const LobeEval eval = closures_.eval(i, wi);
        pdf += probability_[i] * eval.pdf;
        if (sides_agree || has_no_sides(closures[i].model)) by_channel[channel_of_[i]] += eval.f;
    }
    return pdf;
}

template <class Tracker>
void Integrator<Tracker>::add_light_samples(const Surface& surface) {
    const LightSampler* lights = surface.object->lights;
    if (lights->empty()) return;
    const Vec3f normal = transmissive_ ? Vec3f{0, 0, 0} : surface.outward;
    const LightPick pick = lights->pick(surface.at.position, normal, points_.choice.y);
    if (!(pick.probability > 0)) return;
    const SceneLight& light = scene_.lights[pick.light];
    const LightSample sample = light.light->sample(surface.at.position, points_.light);
    if (!(sample.pdf > 0) || is_black(sample.radiance)) return;
    const std::span<Color> value = cleared_values();
    const float pdf_lobes = evaluate(surface, sample.wi, value);
    if (std::all_of(value.begin(), value.end(), is_black)) return;

    // Without a way to meet the light by a ray the light sample stands alone.
    const SceneObject& object = *surface.object;
    const bool samples_only = light.samples_only || object.tampers_with_shadows();
    const float pdf_light = pick.probability * sample.pdf;
    float weight = sample.delta || samples_only ? 1 : power_heuristic(pdf_light, pdf_lobes);
    if (surface.in_medium && vertex_part_ && !light.light->infinite())
        weight *= share_of_collisions(vertex_ray_, *vertex_part_, surface.t, pick.light,
                                      pick.probability);
    const float kept = low_light_survival(value, light, sample.radiance * (weight / pdf_light));
    if (kept < 1 && random(2) >= kept) return;
    const Visibility visible = visibility(surface, pick.light, sample);
    if (is_black(visible.tinted)) return;
    // What came through glass has no twin among the rays (diffuse rays end at glass), so its light sample stands alone.
    const Color arriving =
        sample.radiance * color_of_wavelength(surface, sample.wi) * (1 / (pdf_light * kept));
    const Color to_specular = arriving * visible.straight * weight;
    const Color to_diffuse = to_specular + arriving * (visible.tinted - visible.straight);
    deposit_scattered_light(light, [&](std::size_t g, std::size_t c) {
        const GroupKey& key = groups_[g].key;
        if (key.lights_only || !channel_allowed(key, channels_[c]) || !channels_[c].direct_light)
            return kBlack;
        const LobeRecord& record = *channels_[c].record;
        // Rays that volumes scatter may be refracted, as specular ones: their twins exist.
        const Color incident = record.lobe == EventLobe::Diffuse ? to_diffuse : to_specular;
        return value[c] * incident *
               light_factor(light.common, ray_type_of(record.kind, record.lobe, record.subsurface),
                            n_scatter_ + 1);
    });
}

/// low_light_threshold: how likely a light sample that brings less than the threshold is worth its shadow ray.
template <class Tracker>
float Integrator<Tracker>::low_light_survival(std::span<const Color> by_channel,
                                              const SceneLight& light, Color incident) const {
    const float threshold = scene_.settings.low_light_threshold;
    if (!(threshold > 0)) return 1;
    Color brought;
    for (const PathGroup& group : groups_.all())
        for (std::size_t c = 0; c < n_channels_; ++c) {
            if (group.key.lights_only || !channel_allowed(group.key, channels_[c]) ||
                !channels_[c].direct_light)
                continue;
            const LobeRecord& record = *channels_[c].record;
            brought += group.throughput * by_channel[c] * incident *
                       light_factor(light.common,
                                    ray_type_of(record.kind, record.lobe, record.subsurface),
                                    n_scatter_ + 1);
        }
    const float brightest = max_component(brought);
    return brightest < threshold ? std::max(brightest / threshold, kLeastSurvival) : 1;
}

template <class Tracker>
auto Integrator<Tracker>::visibility(const Surface& surface, std::uint32_t index,
                                     const LightSample& sample) -> Visibility {
    const SceneLight& light = scene_.lights[index];
    const SceneObject& object = *surface.object;
    if (!light.common.cast_shadows || !object.receive_shadows) return {kWhite, kWhite};
    Ray ray{start_of_ray(surface, sample.wi), sample.wi, 0, sample.distance * (1 - kShadowEpsilon),
            surface.at.time};
    Visibility out = visibility_along(ray, object.self_shadows ? nullptr : &object, index);
    if (!scene_.volumes.empty() && light.common.cast_volumetric_shadows && !is_black(out.tinted)) {
        const Color left = media_transmittance(ray);
        out.straight *= left;
        out.tinted *= left;
    }
    if (light.common.shadow_density == 1 && is_black(light.common.shadow_color)) return out;
    for (Color* through : {&out.straight, &out.tinted}) {
        const Color shadow = (kWhite - *through) * light.common.shadow_density;
        *through = kWhite - shadow + shadow * light.common.shadow_color;
    }
    return out;
}

template <class Tracker>
auto Integrator<Tracker>::visibility_along(Ray ray, const SceneObject* ignore, std::uint32_t light)
    -> Visibility {
    ++counts.rays;
    const std::uint32_t both = kMaskShadowOpaque | kMaskShadowTransparent;
    const Visibility dark{kBlack, kBlack};
    Visibility out{kWhite, kWhite};
    if (ignore == nullptr && scene_.accel->occluded(ray, kMaskShadowOpaque)) return dark;
    if (ignore == nullptr && !scene_.has_transparency) return out;
    // The limit counts surfaces that weaken the light; the object itself is passed as often as it takes.
    int guard = 0;
    Interiors inside = interiors_;
    for (int passed = 0; passed <= scene_.settings.auto_transparency_depth &&
                         guard < static_cast<int>(kMaxSegments);
         ++guard) {
        RayHit hit;
        ++counts.rays;
        if (!scene_.accel->intersect(ray, ignore == nullptr ? kMaskShadowTransparent : both, hit))
            return out;
        const SceneObject& object = scene_.objects[hit.object];
        const Surface surface = make_surface(object, ray, hit, {});
        const bool one_sided =
            !surface.at.entering && (object.sidedness & ray_bit(RayType::Shadow)) == 0;
        const bool casts = object.shadow_lights.empty() || object.shadow_lights[light];
        if (&object != ignore && !one_sided && casts) {
            if (!object.may_be_transparent && !object.may_tint_shadows) return dark;
            ShadePoint at = surface.at;
            at.ray_type = RayType::Shadow;
            tell_path(at, inside, surface.shader);
            at.ray = &state;
            shadow_closures_.begin(at.wo, surface.frame);
            surface.shader->closures(at, shadow_closures_);
            const Color straight = clamp(shadow_closures_.transparency(), 0, 1);
            const Interior& own = shadow_closures_.interior();
            out.straight *= straight;
            if (!is_hidden(surface, own, inside))
                out.tinted *= clamp(straight + shadow_closures_.shadow_transmission(), 0, 1);
            if (own.is_body) inside.cross(surface.shader, own, at.entering);
            if (is_black(out.tinted)) return dark;
            ++passed;
        }
        const Vec3f origin = start_of_ray(surface, ray.direction);
        ray.t_max -= dot(origin - ray.origin, ray.direction);
        if (!(ray.t_max > 0)) return out;
        ray.origin = origin;
    }
    return dark;
}

/// Light on the point where a walk came out. The event was made where it went in.
template <class Tracker>
void Integrator<Tracker>::add_light_at_exit(const WalkExit& exit) {
    const Surface& surface = exit.surface;
    const LightSampler* lights = surface.object->lights;
    if (lights->empty()) return;
    const LightPick pick = lights->pick(surface.at.position, exit.outside, points_.choice.y);
    if (!(pick.probability > 0)) return;
    const SceneLight& light = scene_.lights[pick.light];
    const LightSample sample = light.light->sample(surface.at.position, points_.light);
    const float cosine = dot(exit.normal, sample.wi);
    if (!(sample.pdf > 0) || is_black(sample.radiance) || !(cosine > 0) ||
        !(dot(exit.outside, sample.wi) > 0))
        return;
    const bool samples_only = light.samples_only || surface.object->tampers_with_shadows();
    const float pdf_light = pick.probability * sample.pdf;
    const float weight =
        sample.delta || samples_only ? 1 : power_heuristic(pdf_light, kInvPi * cosine);
    const Visibility visible = visibility(surface, pick.light, sample);
    if (is_black(visible.tinted)) return;
    // As in add_light_samples: what came through glass has no twin among the rays.
    const Color arriving = sample.radiance * (kInvPi * cosine / pdf_light) *
                           (visible.straight * weight + (visible.tinted - visible.straight));
    const bool background = light.is_skydome && light.common.aov_indirect;
    const Terminal terminal = background ? Terminal{light.as_background, light.background_event}
                                         : Terminal{light.as_light, light.light_event};
    deposit(terminal, [&](std::size_t g) {
        if (!groups_.direct_light(g)) return kBlack;
        return arriving * light_factor(light.common, groups_[g].key.ray_type, n_scatter_);
    });
}

template class Integrator<AovTracker>;
template class Integrator<LogTracker>;

}  // namespace lightsieve
