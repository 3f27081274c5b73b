#include "render/integrator.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/sampling.h"
#include "render/faults.h"
#include "render/integrator_deposit.h"
#include "render/path_log.h"

namespace lightsieve {
namespace {

/// Lamps lie in ceilings: a lamp behind a surface still counts as in front if its plane is no farther off than positions of
/// this size are rounded (relative). Along a slanting ray that may be more, up to kCoplanar (relative).
constexpr float kCoplanar = 1e-4F, kRounding = 1e-6F;
/// Area lights that one ray may pass.
constexpr int kMaxLightsAlongRay = 256;

/// The sampler's pair of dimensions for the path's wavelength; camera_sample has those before it.
constexpr std::size_t kWavelengthPair = 3;

float unit(float v) { return std::clamp(v, 0.0F, 1.0F); }

/// The ray of a group as a bit of a mask.
std::uint32_t bit_of(const PathGroup& group) { return ray_bit(group.key.ray_type()); }

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
    if (!scene_.plan.wants_cost)
        return trace_path(camera_ray, time, camera_from_world, sampler, out);
    using Clock = std::chrono::steady_clock;
    const std::uint64_t rays = sum_of(counts.rays);
    const Clock::time_point start = Clock::now();
    trace_path(camera_ray, time, camera_from_world, sampler, out);
    out.rays = static_cast<float>(sum_of(counts.rays) - rays);
    out.microseconds = std::chrono::duration<float, std::micro>(Clock::now() - start).count();
}

template <class Tracker>
void Integrator<Tracker>::trace_path(const CameraRay& camera_ray, float time,
                                     const Mat4f& camera_from_world, const Sampler& sampler,
                                     SampleBuffer& out) {
    // The camera event: one share of throughput.
    path_.sampler = sampler;
    out_ = &out;
    out.deep = scene_.plan.wants_deep;
    out.clear();
    out.written.resize(scene_.plan.written.size(), {kBlack, 0});
    written_.resize(scene_.plan.written.size());
    mattes_.resize(scene_.plan.wants_mattes ? scene_.plan.mattes.size() : 0);
    writes_aovs_ = false;
    if (!(camera_ray.weight > 0)) return;  // the camera sees nothing there
    path_.start = Color::grey(camera_ray.weight);
    path_.groups.start(path_.start);
    tracker_.start(path_.start, out);
    path_.last = {};
    path_.footprint = {camera_ray.width, camera_ray.spread};
    path_.passed = kWhite;
    path_.interiors.clear();
    path_.segment = 0;
    path_.n_scatter = path_.n_transparent = 0;
    path_.siblings = 1;
    path_.slot = 0;
    path_.place = GuideRecorder::kNone;
    path_.monochromatic = path_.exit_pending = knows_first_ = false;
    path_.fans_out = true;
    path_.state = state;
    path_.state.sampler = &path_.sampler;
    path_.state.camera_from_world = &camera_from_world;
    path_.state.pixel_angle = camera_ray.spread;
    wavelength_ =
        scene_.disperses ? sample_wavelength(sampler.at2x4(0)[kWavelengthPair].x) : Wavelength{};
    n_shadow_rays_ = 0;
    n_forks_ = 0;
    follow({camera_ray.origin, camera_ray.direction, camera_ray.t_min, camera_ray.t_max, time},
           camera_from_world);
    while (n_forks_ > 0) {
        const Fork& fork = forks_[--n_forks_];
        path_ = fork.path;
        tracker_.restore(fork.terms);
        out_->slot = path_.slot;
        follow(fork.ray, camera_from_world);
    }
}

/// Follows the current path to its end. Where it splits, the others are put aside.
template <class Tracker>
void Integrator<Tracker>::follow(Ray ray, const Mat4f& camera_from_world) {
    for (; path_.segment < kMaxSegments && wanted(); ++path_.segment) {
        // Find the next surface, and the lights before it.
        choose_mask_group();
        update_state();
        if (path_.exit_pending) add_exit_background(ray);
        lights_only_ = std::all_of(path_.groups.all().begin(), path_.groups.all().end(),
                                   [](const PathGroup& g) { return g.key.lights_only(); });
        if (lights_only_ && misses_area_lights(ray)) return add_infinite_end(ray);
        RayHit hit;
        ++counts.rays_of(ray_kind_of(path_.groups[0].key.ray_type()));
        const bool met = scene_.accel->intersect(ray, ray_mask(), hit);
        if (through_media() || media_.active()) begin_media(ray, met ? hit.t : ray.t_max);
        if (by_shadow_rays() && path_.segment == path_.last.next_segment) {
            if (scene_.light_accel) (void)add_area_lights(ray, ray.t_max);
            add_infinite_lights(ray);
        }

        // The next vertex: on a surface, or before it in a medium. A ray that leaves the scene brings infinite lights and
        // the background.
        const Passage passage = pass(ray, met ? hit.t : ray.t_max);
        if (passage == Passage::Ended) return;
        const bool in_medium = passage == Passage::Scattered;
        if (!in_medium && !met) return add_escape(ray);
        if (!in_medium && lights_only_ && !scene_.objects[hit.object].may_be_passed()) return;
        // Made in place: points are too large to copy.
        Surface surface =
            in_medium ? Surface(medium_vertex_)
                      : make_surface(scene_.objects[hit.object], ray, hit, path_.footprint);
        if (!in_medium) {
            meet(surface, path_.groups[0].key.ray_type());
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
            path_.sampler.at2x4(kFirstPair + path_.segment * kPairsPerSegment);
        points_ = {points[0], points[1], points[2], points[3]};
        choose_probabilities();
        if (guide_ != nullptr) find_guide(surface);
        if (path_.fans_out) {
            if (!fan_out(surface, ray)) return;
            continue;
        }
        if (n_channels_ > 0 && !all_delta_) add_light_samples(surface);
        if (!go_on(surface, ray)) return;
    }
}

template <class Tracker>
auto Integrator<Tracker>::arrive(Surface& surface, Ray& ray, const Mat4f& camera_from_world)
    -> Arrival {
    // Surfaces may have one side only, be cut away, or be holes in the picture.
    const SceneObject& object = *surface.object;
    if (!scene_.is_there(surface, surface.at.ray_type)) {
        go_straight(surface, ray);
        return Arrival::Passed;
    }
    if (object.matte && surface.at.ray_type == RayType::Camera) return Arrival::Ended;
    surface.at.ray = &path_.state;
    open_slot(surface.at.position);
    start_writing();
    tell_path(surface.at, path_.interiors, surface.shader);
    closures_.begin(surface.at.wo, surface.frame);
    add_closures(surface, surface.at, closures_);
    counts.dropped_closures += closures_.n_dropped();
    absorb(surface);
    if (pass_hidden_surface(surface, ray)) return Arrival::Passed;
    if (writes_aovs_) write_aovs(surface.at);
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

/// A ray that may only meet lights, and that no area light is on the way of: it is enough to know whether it gets away, if
/// there are skies. False also where what is on its way would have to be looked at.
template <class Tracker>
bool Integrator<Tracker>::misses_area_lights(const Ray& ray) const {
    const bool looks_at_surfaces =
        !scene_.infinite_lights.empty() && (scene_.rays_may_pass || scene_.shadows_by_mask);
    if (looks_at_surfaces || through_media() || media_.active()) return false;
    return !scene_.light_accel || !scene_.light_accel->occluded(ray, 0xffffffffU);
}

/// Infinite lights at the end of such a ray.
template <class Tracker>
void Integrator<Tracker>::add_infinite_end(const Ray& ray) {
    if (scene_.infinite_lights.empty()) return;
    ++counts.rays_of(ray_kind_of(path_.groups[0].key.ray_type()));
    if (!scene_.accel->occluded(ray, ray_mask())) add_escape(ray);
}

/// Light and opacity that follow come from there, if the camera sees it directly.
template <class Tracker>
void Integrator<Tracker>::open_slot(Vec3f position) {
    if (!out_->deep || path_.n_scatter > 0) return;
    out_->open_slot(-path_.state.camera_from_world->point(position).z);
    path_.slot = out_->slot;
}

/// Where masks tell shares of the ray apart, one of them goes on, chosen by luminance.
template <class Tracker>
void Integrator<Tracker>::choose_mask_group() {
    const std::span<const PathGroup> groups = path_.groups.all();
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
    path_.passed *= path_.groups[chosen].key.seen() ? total / y : 0;
    path_.groups.keep_only(chosen, total / y);
    tracker_.keep_only(chosen, total / y);
}

/// Counts for shaders the event that the ray came by.
template <class Tracker>
void Integrator<Tracker>::update_state() {
    path_.state.segment = path_.segment;
    path_.state.transparent = path_.n_transparent;
    if (path_.state.bounces == path_.n_scatter) return;
    path_.state.bounces = path_.n_scatter;
    switch (path_.groups[0].key.ray_type()) {
        case RayType::Camera:
        case RayType::Shadow: break;
        case RayType::SpecularReflect: ++path_.state.specular; break;
        case RayType::SpecularTransmit: ++path_.state.transmission; break;
        case RayType::Volume: ++path_.state.volume; break;
        default: ++path_.state.diffuse; break;
    }
}

template <class Tracker>
std::uint32_t Integrator<Tracker>::ray_mask() const {
    std::uint32_t mask = 0;
    for (const PathGroup& g : path_.groups.all())
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
    const float largest = max_component(total) * path_.siblings;
    return n_scatter > 1 && largest > scene_.settings.indirect_clamp
               ? scene_.settings.indirect_clamp / largest
               : 1;
}

/// Notes a contribution that is not finite; it is left out.
template <class Tracker>
void Integrator<Tracker>::drop(std::uint32_t event) {
    ++counts.dropped;
    counts.dropped_event = event;
    counts.dropped_depth = path_.n_scatter;
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
        if (active_fault() == Fault::LightHitAsObject && path_.n_scatter > 0)
            terminal = any_object(scene_);
#endif
        if (path_.n_scatter == 0) {
            // Seen directly: the light stands in the picture as far as its `camera` says.
            const float seen = light.common.camera;
            if (!(seen > 0)) continue;
            const Color radiance = light.light->hit(ray.origin, at).radiance;
            if (is_black(radiance)) continue;
            open_slot(at.position);
            deposit(terminal, [&](std::size_t) { return radiance * seen; });
            const float hidden = std::min(seen, 1.0F);
            out_->add_alpha(average(path_.passed) * hidden, path_.passed * hidden);
            if (hidden >= 1) return Passage::Ended;
            path_.groups.scale(Color::grey(1 - hidden));
            tracker_.scale(Color::grey(1 - hidden));
            path_.passed *= 1 - hidden;
            continue;
        }
        LightHit seen_from = at;
        seen_from.distance = length(at.position - path_.last.position);
        if (seen()) {
            const float hidden = unit(light.common.transmission);
            out_->add_alpha(average(path_.passed) * hidden, path_.passed * hidden);
            path_.passed *= 1 - hidden;
        }
        add_met_light(index, light.light->hit(path_.last.position, seen_from), terminal, ray,
                      hit.t * (1 - kShadowEpsilon));
    }
    return Passage::Free;
}

/// Light that a ray from the last vertex met by chance: the twin of a light sample, and weighted against it.
template <class Tracker>
void Integrator<Tracker>::add_met_light(std::uint32_t index, const LightEval& eval,
                                        Terminal terminal, const Ray& ray, float distance) {
    const SceneLight& light = scene_.lights[index];
    if (is_black(eval.radiance) ||
        (!path_.last.delta && (light.samples_only || path_.last.samples_only)))
        return;
    const float samples = light_samples(path_.last.plan, *path_.last.lights, path_.last.position,
                                        path_.last.pick_normal, index);
    if (!(samples > 0))
        return;  // in the dark by its own bounds, or not in the shape's light group
    Color arriving = eval.radiance *
                     (path_.last.delta ? 1 : power_heuristic(path_.last.pdf, samples * eval.pdf));
    if (by_shadow_rays()) {
        Ray shadow = ray;
        shadow.t_max = distance;
        arriving *=
            visibility_along(shadow, nullptr, index).straight * media_transmittance(shadow);
    }
    // Light samples know nothing of haze, so their twins must not either.
    if (scene_.atmosphere != nullptr)
        for (int c = 0; c < 3; ++c)
            arriving[c] = haze_.left[c] > 0 ? arriving[c] / haze_.left[c] : 0;
    const auto brought = [&](std::size_t g) {
        if (!path_.groups.direct_light(g)) return kBlack;
        return arriving *
               light_factor(light.common, path_.groups[g].key.ray_type(), path_.n_scatter);
    };
    // A skydome that is seen, be it through glass, is background.
    if (!light.is_skydome || !some_group_is_seen()) return deposit(terminal, brought);
    deposit(terminal,
            [&](std::size_t g) { return path_.groups[g].key.seen() ? kBlack : brought(g); });
    deposit({light.as_background, light.background_event},
            [&](std::size_t g) { return path_.groups[g].key.seen() ? brought(g) : kBlack; });
}

/// Where shadow rays see other shapes than other rays do, they decide for both twins what hides a light.
template <class Tracker>
bool Integrator<Tracker>::by_shadow_rays() const {
    return scene_.shadows_by_mask && path_.n_scatter > 0 && !path_.last.delta;
}

/// Infinite lights along a ray that meets nothing. Returns the alpha of those that the camera sees.
template <class Tracker>
float Integrator<Tracker>::add_infinite_lights(const Ray& ray) {
    float alpha = 0;
    for (const std::uint32_t index : scene_.infinite_lights) {
        const SceneLight& light = scene_.lights[index];
        const LightEval eval =
            path_.n_scatter == 0
                ? light.light->seen(ray.origin, ray.direction)
                : light.light->escape_facing(path_.last.position,
                                             light.samples_only ? Vec3f{} : path_.last.facing,
                                             ray.direction);
        const float shown = path_.n_scatter == 0 ? light.common.camera : light.common.transmission;
        if (seen() && (eval.pdf > 0 || !is_black(eval.radiance) || light.is_skydome))
            alpha = std::max(alpha, unit(shown));
        // A skydome seen directly is background, and so is the light of one with aov_indirect.
        const bool background =
            light.is_skydome && (path_.n_scatter == 0 || light.common.aov_indirect);
        const Terminal terminal = background
                                      ? Terminal{light.as_background, light.background_event}
                                      : Terminal{light.as_light, light.light_event};
        if (path_.n_scatter > 0) {
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
    if (path_.n_scatter == 0) out_->slot = 0;
    float alpha = by_shadow_rays() ? 0 : add_infinite_lights(ray);
    if (scene_.background != nullptr && !lights_only_) {
        const auto [radiance, opaque] = background_along(ray, path_.n_scatter == 0);
        const auto visible = [&](std::size_t g) {
            return (scene_.background_visibility & bit_of(path_.groups[g])) != 0 &&
                   !path_.groups[g].key.lights_only();
        };
        deposit({scene_.background_record.terminal, scene_.background_record.event},
                [&](std::size_t g) {
                    return visible(g) ? radiance * path_.groups.indirect(g) : kBlack;
                });
        for (std::size_t g = 0; g < path_.groups.all().size(); ++g)
            if (path_.groups[g].key.seen() && visible(g)) alpha = std::max(alpha, unit(opaque));
    }
    if (seen()) out_->add_alpha(average(path_.passed) * alpha, path_.passed * alpha);
}

/// exit_to_background: shares past their depth limit take the background in place of what the ray would meet.
template <class Tracker>
void Integrator<Tracker>::add_exit_background(const Ray& ray) {
    path_.exit_pending = false;
    if (scene_.background == nullptr) return;
    const Color radiance = background_along(ray, false).rgb;
    deposit({scene_.background_record.terminal, scene_.background_record.event},
            [&](std::size_t g) {
                return path_.groups[g].key.exits() &&
                               (scene_.background_visibility & bit_of(path_.groups[g])) != 0
                           ? radiance * path_.groups.indirect(g)
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
    at.ray_type = path_.groups[0].key.ray_type();
    at.ray = &path_.state;
    at.time = ray.time;
    if (behind_picture) at.uv = path_.state.screen * 0.5F + Vec2f{0.5F, 0.5F};
    return scene_.background->value(at);
}

/// What the body that the path is inside of took away on the way to the surface. Seen from inside, a surface says itself
/// what that was: a camera may stand in the body.
template <class Tracker>
void Integrator<Tracker>::absorb(const Surface& surface) {
    const Interior& own = closures_.interior();
    const Interior* here = path_.interiors.here();
    // Where collisions are drawn they have taken away what is absorbed.
    if (here != nullptr && here->medium.scatters()) return;
    if (own.is_body && !surface.at.entering)
        here = is_hidden(surface, own, path_.interiors)
                   ? path_.interiors.around(surface.shader, own.priority)
                   : &own;
    if (here == nullptr || is_black(here->medium.extinction)) return;
    const Color left = transmittance(here->medium.extinction, surface.t);
    path_.groups.scale(left);
    tracker_.scale(left);
    if (!seen()) return;
    const Color taken = path_.passed * (kWhite - left);
    out_->add_alpha(average(taken), taken);
    path_.passed *= left;
}

template <class Tracker>
void Integrator<Tracker>::tell_path(ShadePoint& at, const Interiors& inside,
                                    const ShaderProgram* shader) const {
    at.wavelength = wavelength_.nm;
    at.monochromatic = path_.monochromatic;
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
    if (!is_hidden(surface, own, path_.interiors)) return false;
    path_.interiors.cross(surface.shader, own, surface.at.entering, surface.object);
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
            return path_.groups[g].key.lights_only()
                       ? kBlack
                       : matte.weight * radiance * path_.groups.indirect(g);
        });
    };
    show(*matte.shadow_record, matte.shadow_color * covered);
    if (!matte.sees_background) return show(*matte.background_record, matte.background * left);
    if (scene_.background != nullptr)
        show(scene_.background_record, background_along(ray, path_.n_scatter == 0).rgb * left);
    // Skydomes as the camera sees them. What other rays see of them would be a light that light samples know nothing of.
    if (path_.n_scatter > 0) return;
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
    const std::span<const PathGroup> groups = path_.groups.all();
    return std::any_of(groups.begin(), groups.end(),
                       [](const PathGroup& g) { return g.key.seen(); });
}

template <class Tracker>
void Integrator<Tracker>::add_emission(float factor) {
    for (const Emission& e : closures_.emissions())
        deposit({e.record->terminal, e.record->event}, [&](std::size_t g) {
            return path_.groups[g].key.lights_only()
                       ? kBlack
                       : e.radiance * path_.groups.indirect(g) * factor;
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
            const bool none = !may_scatter(path_.groups[g].key, channels_[c]) ||
                              channels_[c].record->makes_no_event;
            return none ? kBlack : albedo[c] * path_.groups.indirect(g);
        },
        1);
}

template class Integrator<AovTracker>;
template class Integrator<LogTracker>;

}  // namespace lightsieve
