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

/// The point before the shape was deformed: user data Pref, else where it is in object space.
Vec3f pref_of(const ShadePoint& at) {
    ShaderValue pref;
    if (at.services->user_value(at, "Pref", pref)) return {pref.rgb.r, pref.rgb.g, pref.rgb.b};
    return at.services->object_from_world(at).point(at.position);
}

/// What layers ask for that takes work.
void note_wanted(FirstHit& out, const Surface& surface, const AovPlan& plan) {
    if (plan.wants_pref) out.pref = pref_of(surface.at);
    if (plan.wants_motion) out.at_shutter = {position_at(surface, 0), position_at(surface, 1)};
}

/// Light samples that decide about a shadow. A ratio of means of few samples is a little biased toward no shadow.
constexpr std::uint32_t kShadowSamples = 16;
/// Streams of random numbers of theirs, apart from those of the path.
constexpr std::uint32_t kShadowStream = 1U << 12U;
constexpr float kBelowOne = 0x1.fffffep-1F;

/// How much light is seen past the surface by such lobes.
Color seen_past(const ClosureSet& closures) {
    const std::span<const Closure> all = closures.closures();
    Color past;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].record->makes_no_event) past += closures.albedo(i);
    return past;
}

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
    const bool looks = path_.n_scatter == 0;
    writes_aovs_ = looks && (!written_.empty() || !mattes_.empty());
    path_.state.written = looks && !written_.empty() ? written_.data() : nullptr;
    path_.state.mattes = looks && !mattes_.empty() ? mattes_.data() : nullptr;
    for (WrittenAov& aov : written_)
        aov.set = false;
}

/// What the scene's aov_shaders write beside what the surface's own shader wrote.
template <class Tracker>
void Integrator<Tracker>::run_aov_shaders(const ShadePoint& at) {
    std::fill(mattes_.begin(), mattes_.end(), 0U);
    for (const ShaderProgram* shader : scene_.aov_shaders) {
        shadow_closures_.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
        shader->closures(at, shadow_closures_);
    }
}

/// Takes over what was written.
template <class Tracker>
void Integrator<Tracker>::write_aovs(const ShadePoint& at) {
    run_aov_shaders(at);
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
    if (is_black(seen_past(closures_))) note_mattes(average(path_.passed * opacity));
}

/// weight  how much of the camera sample sees the surface
template <class Tracker>
void Integrator<Tracker>::note_mattes(float weight) {
    for (std::uint32_t i = 0; i < mattes_.size(); ++i)
        out_->mattes.push_back({i, mattes_[i], weight});
}

/// Alpha, and what data layers show: the first surface that is not wholly transparent.
template <class Tracker>
void Integrator<Tracker>::note_first_hit(const Surface& surface, const Mat4f& camera_from_world) {
    const Color opacity = clamp(kWhite - closures_.transparency(), 0, 1);
    const Color past = seen_past(closures_);
    const Color hidden = path_.passed * clamp(opacity - closures_.matte() - past, 0, 1);
    out_->add_alpha(average(hidden), hidden);
    if (is_black(opacity)) return;
    const bool is_first = !knows_first_;
    knows_first_ = true;
    if (is_black(past)) {
        if (!is_first) return;
        note(out_->first, surface, opacity, camera_from_world);
        note_wanted(out_->first, surface, scene_.plan);
        if (closures_.shadow_matte() != nullptr) out_->first.shadow = shadow_;
        return;
    }
    const bool marks = writes_aovs_ && !mattes_.empty();
    Surface behind;
    if ((!is_first && !marks) || !find_behind(surface, behind)) return;
    if (is_first) {
        note(out_->first, behind, clamp(kWhite - shadow_closures_.transparency(), 0, 1),
             camera_from_world);
        note_wanted(out_->first, behind, scene_.plan);
    }
    if (!marks) return;
    behind.at.ray = &path_.state;
    run_aov_shaders(behind.at);
    note_mattes(average(path_.passed * opacity));
}

/// What is seen past a surface with transmit_aovs, for data and mattes; false if nothing is. A way of its own: data must not
/// depend on which lobe the path goes on by. shadow_closures_ are then those of `out`.
template <class Tracker>
bool Integrator<Tracker>::find_behind(const Surface& front, Surface& out) {
    shadow_closures_ = closures_;
    Interiors inside = path_.interiors;
    out = front;
    for (int i = 0; i <= scene_.settings.depth.total + scene_.settings.auto_transparency_depth;
         ++i) {
        // On through the lobe, through a hole, or where a better body is.
        const Interior& own = shadow_closures_.interior();
        const std::optional<std::size_t> lobe = see_through_lobe(shadow_closures_);
        const bool hidden = is_hidden(out, own, inside);
        Vec3f along = -out.at.wo;
        if (lobe && !hidden) {
            const LobeSample sample = shadow_closures_.sample(*lobe, points_.direction, 0.5F);
            if (!(sample.pdf > 0)) return false;
            along = sample.wi;
        } else if (!hidden && !is_black(clamp(kWhite - shadow_closures_.transparency(), 0, 1))) {
            return true;
        }
        if (own.is_body && (lobe || hidden)) inside.cross(out.shader, own, out.at.entering);
        const Ray ray{start_of_ray(out, along), along, 0, kInfinity, out.at.time};
        RayHit hit;
        ++counts.rays_of(RayKind::Transmission);
        if (!scene_.accel->intersect(ray, ray_bit(RayType::SpecularTransmit), hit)) return false;
        out = make_surface(scene_.objects[hit.object], ray, hit, path_.footprint);
        meet(out, RayType::SpecularTransmit);
        tell_path(out.at, inside, out.shader);
        shadow_closures_.begin(out.at.wo, out.frame);
        add_closures(out, out.at, shadow_closures_);
    }
    return false;
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
    template void Integrator<Tracker>::run_aov_shaders(const ShadePoint&);           \
    template void Integrator<Tracker>::note_mattes(float);                           \
    template bool Integrator<Tracker>::find_behind(const Surface&, Surface&);        \
    template ShadowShown Integrator<Tracker>::shadow_on(const Surface&, const ShadowMatte&);
LIGHTSIEVE_FIRST_HIT(AovTracker)
LIGHTSIEVE_FIRST_HIT(LogTracker)
#undef LIGHTSIEVE_FIRST_HIT

}  // namespace lightsieve
