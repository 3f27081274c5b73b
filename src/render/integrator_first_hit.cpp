// What the camera sees of a surface beside its light: alpha, and what data layers (Z, N, ids) show.
#include <algorithm>

#include "render/integrator.h"
#include "render/path_log.h"

namespace lightsieve {
namespace {

/// Fills in all but what media have to say.
void note(FirstHit& out, const Surface& surface, Color opacity, const Mat4f& camera_from_world) {
    out.hit = true;
    out.depth = -camera_from_world.point(surface.at.position).z;
    out.normal = surface.at.normal;
    out.position = surface.at.position;
    out.uv = surface.at.uv;
    out.id = surface.object->id;
    out.opacity = opacity;
}

/// Light samples that decide about a shadow. A ratio of means of few samples is a little biased toward no shadow.
constexpr std::uint32_t kShadowSamples = 16;
/// Streams of random numbers of theirs, apart from those of the path.
constexpr std::uint32_t kShadowStream = 1U << 12U;
constexpr float kBelowOne = 0x1.fffffep-1F;

/// The first lobe whose light is seen past the surface, or nothing.
std::optional<std::size_t> see_through_lobe(const ClosureSet& closures) {
    const std::span<const Closure> all = closures.closures();
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].record->makes_no_event) return i;
    return std::nullopt;
}

}  // namespace

/// Shaders write AOVs where the camera looks, through transparent surfaces but not through glass.
template <class Tracker>
void Integrator<Tracker>::start_writing() {
    path_.state.written = path_.n_scatter == 0 && !written_.empty() ? written_.data() : nullptr;
    for (WrittenAov& aov : written_)
        aov.set = false;
}

/// Takes over what the surface's shader wrote, and what the scene's aov_shaders write beside it.
template <class Tracker>
void Integrator<Tracker>::write_aovs(const ShadePoint& at) {
    for (const ShaderProgram* shader : scene_.aov_shaders) {
        shadow_closures_.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
        shader->closures(at, shadow_closures_);
    }
    const Color opacity = clamp(kWhite - closures_.transparency(), 0, 1);
    if (is_black(opacity)) return;
    for (std::size_t i = 0; i < written_.size(); ++i) {
        const WrittenAov& aov = written_[i];
        if (!aov.set || !is_finite(aov.value.rgb) || !std::isfinite(aov.value.a)) continue;
        if (aov.blend) {
            out_->written[i].rgb += aov.value.rgb * path_.passed * opacity;
            out_->written[i].a += aov.value.a * average(path_.passed * opacity);
        } else if (!out_->first.hit) {
            out_->written[i] = aov.value;
        }
    }
}

/// Alpha, and what data layers show: the first surface that is not wholly transparent.
template <class Tracker>
void Integrator<Tracker>::note_first_hit(const Surface& surface, const Mat4f& camera_from_world) {
    const Color opacity = clamp(kWhite - closures_.transparency(), 0, 1);
    const std::span<const Closure> closures = closures_.closures();
    Color past;
    for (std::size_t i = 0; i < closures.size(); ++i)
        if (closures[i].record->makes_no_event) past += closures_.albedo(i);
    out_->alpha += average(path_.passed * clamp(opacity - closures_.matte() - past, 0, 1));
    if (knows_first_ || is_black(opacity)) return;
    knows_first_ = true;
    if (is_black(past)) {
        note(out_->first, surface, opacity, camera_from_world);
        if (closures_.shadow_matte() != nullptr) out_->first.shadow = shadow_;
    } else {
        note_behind(surface, camera_from_world);
    }
}

/// The data of what is seen past a surface with transmit_aovs. A way of its own: data must not depend on which lobe the
/// path goes on by.
template <class Tracker>
void Integrator<Tracker>::note_behind(const Surface& front, const Mat4f& camera_from_world) {
    shadow_closures_ = closures_;
    Interiors inside = path_.interiors;
    Surface surface = front;
    for (int i = 0; i <= scene_.settings.depth.total + scene_.settings.auto_transparency_depth;
         ++i) {
        // On through the lobe, through a hole, or where a better body is.
        const Interior& own = shadow_closures_.interior();
        const std::optional<std::size_t> lobe = see_through_lobe(shadow_closures_);
        const Color opacity = clamp(kWhite - shadow_closures_.transparency(), 0, 1);
        const bool hidden = is_hidden(surface, own, inside);
        Vec3f along = -surface.at.wo;
        if (lobe && !hidden) {
            const LobeSample sample = shadow_closures_.sample(*lobe, points_.direction, 0.5F);
            if (!(sample.pdf > 0)) return;
            along = sample.wi;
        } else if (!hidden && !is_black(opacity)) {
            note(out_->first, surface, opacity, camera_from_world);
            return;
        }
        if (own.is_body && (lobe || hidden))
            inside.cross(surface.shader, own, surface.at.entering);
        const Ray ray{start_of_ray(surface, along), along, 0, kInfinity, surface.at.time};
        RayHit hit;
        ++counts.rays;
        if (!scene_.accel->intersect(ray, ray_bit(RayType::SpecularTransmit), hit)) return;
        surface = make_surface(scene_.objects[hit.object], ray, hit, path_.footprint);
        meet(surface, RayType::SpecularTransmit);
        tell_path(surface.at, inside, surface.shader);
        shadow_closures_.begin(surface.at.wo, surface.frame);
        surface.shader->closures(surface.at, shadow_closures_);
    }
}

/// How much light the things around keep from a shadow_matte: light samples with and without what hides them.
template <class Tracker>
ShadowShown Integrator<Tracker>::shadow_on(const Surface& surface, const ShadowMatte& matte) {
    const LightSampler* lights = surface.object->lights;
    if (lights->empty()) return {};
    const Vec3f normal = matte.backlighting > 0 ? Vec3f{0, 0, 0} : surface.outward;
    Color all, arriving;
    for (std::uint32_t i = 0; i < kShadowSamples; ++i) {
        const auto number = [&](std::uint32_t stream) {
            return random(kShadowStream + 4 * i + stream);
        };
        // Strata along the pick: with few lights each gets its share of the samples.
        const float u = (static_cast<float>(i) + number(0)) / kShadowSamples;
        const LightPick pick = lights->pick(surface.at.position, normal, std::min(u, kBelowOne));
        if (!(pick.probability > 0)) continue;
        const SceneLight& light = scene_.lights[pick.light];
        const Vec3f facing = matte.backlighting > 0 ? Vec3f{} : surface.at.normal;
        const LightSample sample =
            light.light->sample_facing(surface.at.position, facing, {number(1), number(2)});
        float cosine = dot(surface.at.normal, sample.wi);
        if (cosine < 0) cosine *= -matte.backlighting;
        if (!(sample.pdf > 0) || !(cosine > 0)) continue;
        const Color brought =
            sample.radiance *
            (cosine * kInvPi / (pick.probability * sample.pdf * kShadowSamples) *
             light_factor(light.common, RayType::DiffuseReflect, path_.n_scatter + 1));
        all += brought;
        if (!is_black(brought))
            arriving += brought * visibility(surface, pick.light, sample).tinted;
    }
    const auto missing = [](float with, float without) {
        return without > 0 ? std::clamp(1 - with / without, 0.0F, 1.0F) : 0.0F;
    };
    return {missing(average(arriving), average(all)),
            {missing(arriving.r, all.r), missing(arriving.g, all.g), missing(arriving.b, all.b)},
            matte.diffuse * (all - arriving)};
}

#define LIGHTSIEVE_FIRST_HIT(Tracker)                                                \
    template void Integrator<Tracker>::start_writing();                              \
    template void Integrator<Tracker>::write_aovs(const ShadePoint&);                \
    template void Integrator<Tracker>::note_first_hit(const Surface&, const Mat4f&); \
    template void Integrator<Tracker>::note_behind(const Surface&, const Mat4f&);    \
    template ShadowShown Integrator<Tracker>::shadow_on(const Surface&, const ShadowMatte&);
LIGHTSIEVE_FIRST_HIT(AovTracker)
LIGHTSIEVE_FIRST_HIT(LogTracker)
#undef LIGHTSIEVE_FIRST_HIT

}  // namespace lightsieve
