// Light that vertices ask for: samples of lights, weighted against the rays that may meet the same light, and what hides
// lights from a surface.
#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "render/integrator_deposit.h"
#include "render/path_log.h"

namespace lightsieve {
namespace {

/// Light samples of little effect are traced at least this often.
constexpr float kLeastSurvival = 0.05F;

/// No light leaks through: both normals must agree on which side of the surface wi leaves.
bool sides_agree(const Surface& surface, Vec3f wi) {
    return (dot(wi, surface.outward) > 0) == (dot(wi, surface.at.normal) > 0);
}

}  // namespace

template <class Tracker>
auto Integrator<Tracker>::evaluate(const Surface& surface, Vec3f wi,
                                   std::span<Color> by_channel) const -> Densities {
    const bool agree = sides_agree(surface, wi);
    const std::span<const Closure> closures = closures_.closures();
    Densities pdf{};
    const float guided = guide_pdf(wi);
    for (std::size_t i = 0; i < closures.size(); ++i) {
        const LobeEval eval = closures_.eval(i, wi);
        pdf[mixture_[channel_of_[i]]] += probability_[i] * blended_pdf(i, eval.pdf, guided);
        if (agree || has_no_sides(closures[i].model)) by_channel[channel_of_[i]] += eval.f;
    }
    return pdf;
}

template <class Tracker>
float Integrator<Tracker>::evaluate(const Surface& surface, std::size_t drawn,
                                    const LobeSample& sample, std::span<Color> by_channel) const {
    const bool agree = sides_agree(surface, sample.wi);
    const std::span<const Closure> closures = closures_.closures();
    const std::uint8_t mixture = mixture_[channel_of_[drawn]];
    float pdf = 0;
    const float guided = guide_pdf(sample.wi);
    for (std::size_t i = 0; i < closures.size(); ++i) {
        if (mixture_[channel_of_[i]] != mixture) continue;
        // The sample has brought what its own lobe says.
        const LobeEval eval =
            i == drawn ? LobeEval{sample.f, sample.pdf} : closures_.eval(i, sample.wi);
        pdf += probability_[i] * blended_pdf(i, eval.pdf, guided);
        if (agree || has_no_sides(closures[i].model)) by_channel[channel_of_[i]] += eval.f;
    }
    return pdf;
}

template <class Tracker>
void Integrator<Tracker>::add_light_samples(const Surface& surface) {
    const LightSampler& lights = *surface.object->lights;
    if (lights.empty()) return;
    const LightPlan plan = light_plan(lights, surface.in_medium);
    if (plan != LightPlan::Pick) return ask_lights(surface, plan);
    const Vec3f normal = transmissive_ ? Vec3f{0, 0, 0} : surface.outward;
    const LightPick pick = lights.pick(surface.at.position, normal, points_.choice.y);
    if (pick.probability > 0)
        ask_light(surface, pick.light, pick.probability, points_.light, random(2));
}

template <class Tracker>
void Integrator<Tracker>::ask_light(const Surface& surface, std::uint32_t index, float samples,
                                    Vec2f u, float coin) {
    const SceneLight& light = scene_.lights[index];
    if (!wanted_from(light)) return;
    const LightSample sample = light.light->sample_facing(
        surface.at.position, light.samples_only ? Vec3f{} : facing(surface), u);
    if (!(sample.pdf > 0) || is_black(sample.radiance)) return;
    const std::span<Color> value = cleared_values();
    const Densities pdf_rays = evaluate(surface, sample.wi, value);
    for (std::size_t c = 0; c < n_channels_; ++c)
        value[c] *= direct_light_factor(light.common, channels_[c]);
    if (std::all_of(value.begin(), value.end(), is_black)) return;

    // Without a way to meet the light by a ray the light sample stands alone.
    const SceneObject& object = *surface.object;
    const bool alone = sample.delta || light.samples_only || object.tampers_with_shadows();
    const float pdf_light = samples * sample.pdf;
    const float part =
        surface.in_medium && vertex_part_ && !light.light->infinite()
            ? share_of_collisions(vertex_ray_, *vertex_part_, surface.t, index, samples)
            : 1;
    std::array<float, kMaxChannels> weights;
    const float of_first = alone ? part : part * power_heuristic(pdf_light, pdf_rays[0]);
    for (std::size_t c = 0; c < n_channels_; ++c)
        weights[c] = alone || mixture_[c] == 0
                         ? of_first
                         : part * power_heuristic(pdf_light, pdf_rays[mixture_[c]]);
    // What the sample stands for, be it one of several of its light or picked among many lights.
    const Color stands_for = sample.radiance * (1 / (sample.pdf * std::min(samples, 1.0F)));
    const float kept = low_light_survival(value, weights, stands_for);
    if (kept < 1 && coin >= kept) return;
    const Visibility visible = visibility(surface, index, sample);
    if (is_black(visible.tinted)) return;
    // What came through glass has no twin among the rays (diffuse rays end at glass), so its light sample stands alone.
    const Color arriving =
        sample.radiance * color_of_wavelength(surface, sample.wi) * (1 / (pdf_light * kept));
    const Color straight = arriving * visible.straight,
                tinted = arriving * (visible.tinted - visible.straight);
    deposit_scattered_light(light, [&](std::size_t g, std::size_t c) {
        if (!may_scatter(path_.groups[g].key, channels_[c])) return kBlack;
        // Rays that volumes scatter may be refracted, as specular ones: their twins exist.
        Color incident = straight * weights[c];
        if (channels_[c].record->lobe == EventLobe::Diffuse) incident += tinted;
        return value[c] * incident;
    });
}

/// Factor on light that the channel scatters straight from the light.
template <class Tracker>
float Integrator<Tracker>::direct_light_factor(const LightCommon& light,
                                               const Channel& channel) const {
    const LobeRecord& record = *channel.record;
    return channel.direct_light
               ? light_factor(light, ray_type_of(record.kind, record.lobe, record.subsurface),
                              path_.n_scatter + 1)
               : 0;
}

/// low_light_threshold: how likely a light sample that brings less than the threshold is worth its shadow ray.
template <class Tracker>
float Integrator<Tracker>::low_light_survival(std::span<const Color> by_channel,
                                              std::span<const float> weights,
                                              Color incident) const {
    const float threshold = scene_.settings.low_light_threshold;
    if (!(threshold > 0)) return 1;
    Color brought;
    for (const PathGroup& group : path_.groups.all())
        for (std::size_t c = 0; c < n_channels_; ++c)
            if (may_scatter(group.key, channels_[c]))
                brought += group.throughput * by_channel[c] * incident * weights[c];
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
    ++counts.rays_of(RayKind::Shadow);
    const std::uint32_t both = kMaskShadowOpaque | kMaskShadowTransparent;
    const Visibility dark{kBlack, kBlack};
    Visibility out{kWhite, kWhite};
    if (ignore == nullptr && scene_.accel->occluded(ray, kMaskShadowOpaque)) return dark;
    if (ignore == nullptr && !scene_.has_transparency) return out;
    // The limit counts surfaces that weaken the light; the object itself is passed as often as it takes.
    int guard = 0;
    Interiors inside = path_.interiors;
    for (int passed = 0; passed <= scene_.settings.auto_transparency_depth &&
                         guard < static_cast<int>(kMaxSegments);
         ++guard) {
        RayHit hit;
        ++counts.rays_of(RayKind::Shadow);
        if (!scene_.accel->intersect(ray, ignore == nullptr ? kMaskShadowTransparent : both, hit))
            return out;
        const SceneObject& object = scene_.objects[hit.object];
        const Surface surface = make_surface(object, ray, hit, {});
        const bool casts = object.shadow_lights == nullptr || (*object.shadow_lights)[light];
        if (&object != ignore && casts && scene_.is_there(surface, RayType::Shadow)) {
            if (!object.may_be_transparent && !object.may_tint_shadows) return dark;
            ShadePoint at = surface.at;
            at.ray_type = RayType::Shadow;
            tell_path(at, inside, surface.shader);
            at.ray = &path_.state;
            shadow_closures_.begin(at.wo, surface.frame);
            add_closures(surface, at, shadow_closures_);
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
    if (culling_ != Culling::None && !tracker_.takes(light.as_light) &&
        !(light.is_skydome && tracker_.takes(light.as_background)))
        return;
    const bool samples_only = light.samples_only || surface.object->tampers_with_shadows();
    const LightSample sample = light.light->sample_facing(
        surface.at.position, samples_only ? Vec3f{} : exit.normal, points_.light);
    const float cosine = dot(exit.normal, sample.wi);
    if (!(sample.pdf > 0) || is_black(sample.radiance) || !(cosine > 0) ||
        !(dot(exit.outside, sample.wi) > 0))
        return;
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
        if (!path_.groups.direct_light(g)) return kBlack;
        return arriving *
               light_factor(light.common, path_.groups[g].key.ray_type(), path_.n_scatter);
    });
}

// Explicitly, member by member: the class as a whole is instantiated in integrator.cpp.
#define LIGHTSIEVE_LIGHTS(Tracker)                                                               \
    template auto Integrator<Tracker>::evaluate(const Surface&, Vec3f, std::span<Color>) const   \
        -> Densities;                                                                            \
    template float Integrator<Tracker>::evaluate(const Surface&, std::size_t, const LobeSample&, \
                                                 std::span<Color>) const;                        \
    template void Integrator<Tracker>::add_light_samples(const Surface&);                        \
    template void Integrator<Tracker>::ask_light(const Surface&, std::uint32_t, float, Vec2f,    \
                                                 float);                                         \
    template float Integrator<Tracker>::low_light_survival(std::span<const Color>,               \
                                                           std::span<const float>, Color) const; \
    template float Integrator<Tracker>::direct_light_factor(const LightCommon&, const Channel&)  \
        const;                                                                                   \
    template auto Integrator<Tracker>::visibility(const Surface&, std::uint32_t,                 \
                                                  const LightSample&) -> Visibility;             \
    template auto Integrator<Tracker>::visibility_along(Ray, const SceneObject*, std::uint32_t)  \
        -> Visibility;                                                                           \
    template void Integrator<Tracker>::add_light_at_exit(const WalkExit&);
LIGHTSIEVE_LIGHTS(AovTracker)
LIGHTSIEVE_LIGHTS(LogTracker)
#undef LIGHTSIEVE_LIGHTS

}  // namespace lightsieve
