#include "bsdf/closure.h"

#include "core/error.h"

namespace lightsieve {
namespace {

/// Directions nearer to the horizon are lifted to it: the models divide by wo.z.
constexpr float kMinCosOut = 1e-5F;

Frame facing(const Frame& frame, Vec3f side) {
    return dot(frame.z, side) < 0 ? Frame{frame.x, -frame.y, -frame.z} : frame;
}

/// Negative to 0; not finite anywhere makes all of it black.
Color valid_weight(Color c) {
    if (!is_finite(c)) return kBlack;
    return {std::max(c.r, 0.0F), std::max(c.g, 0.0F), std::max(c.b, 0.0F)};
}

}  // namespace

void ClosureSet::begin(Vec3f wo, const Frame& shading) {
    wo_ = wo;
    n_ = n_subsurfaces_ = n_emissions_ = n_frames_ = n_media_ = 0;
    n_dropped_ = 0;
    in_volume_ = false;
    scale_ = kWhite;
    transparency_ = shadow_transmission_ = matte_ = kBlack;
    indirect_ = {};
    interior_ = {};
    disperses_ = false;
    shadow_matte_.background_record = nullptr;
    records_ = {};
    add_frame(shading);
}

void ClosureSet::begin_volume(Vec3f wo) {
    begin(wo, Frame::from_z(wo));
    in_volume_ = true;
}

std::uint8_t ClosureSet::add_frame(const Frame& frame) {
    // More frames than fit: the shading frame will do for the rest.
    if (n_frames_ == kMaxFrames) return 0;
    const Frame faced = n_frames_ == 0 ? frame : facing(frame, frames_[0].z);
    Vec3f local = faced.local_from_world(wo_);
    if (local.z < kMinCosOut) local = normalize({local.x, local.y, kMinCosOut});
    frames_[n_frames_] = faced;
    wo_local_[n_frames_] = local;
    return static_cast<std::uint8_t>(n_frames_++);
}

const LobeRecord& ClosureSet::record(int lobe) const {
    LIGHTSIEVE_ASSERT(static_cast<std::size_t>(lobe) < records_.size(),
                      std::to_string(lobe) + " of " + std::to_string(records_.size()));
    return records_[static_cast<std::size_t>(lobe)];
}

float ClosureSet::indirect_of(const LobeRecord& record) const {
    if (record.lobe == EventLobe::Diffuse) return indirect_.diffuse;
    return record.kind == EventKind::Reflection ? indirect_.specular : 1;
}

void ClosureSet::add(int lobe, const LobeModel& model, Color weight, std::uint8_t frame,
                     bool caustics, const std::optional<Color>& albedo) {
    const Color total = valid_weight(scale_ * weight);
    if (is_black(total)) return;
    if (n_ == kMaxClosures) {
        ++n_dropped_;
        return;
    }
    const LobeRecord& made = record(lobe);
    // Member by member: a whole one would be put together elsewhere and copied.
    Closure& out = closures_[n_++];
    out.model = model;
    out.weight = total;
    out.record = &made;
    out.frame = frame;
    out.caustics = caustics;
    out.indirect = indirect_of(made);
    out.direct_light = indirect_.direct_light;
    out.albedo = albedo;
}

void ClosureSet::add_subsurface(int lobe, const SubsurfaceMedium& medium, Color weight) {
    const Color total = valid_weight(scale_ * weight);
    if (is_black(total)) return;
    if (n_subsurfaces_ == kMaxSubsurfaces) {
        ++n_dropped_;
        return;
    }
    const LobeRecord& made = record(lobe);
    subsurfaces_[n_subsurfaces_++] = {medium, total, &made, indirect_of(made)};
}

void ClosureSet::show_shadows(int background, int shadow, ShadowMatte matte) {
    shadow_matte_ = matte;
    shadow_matte_.weight = scale_;
    shadow_matte_.background_record = &record(background);
    shadow_matte_.shadow_record = &record(shadow);
}

void ClosureSet::emit(int lobe, Color radiance) {
    const Color total = valid_weight(scale_ * radiance);
    if (is_black(total)) return;
    if (n_emissions_ == kMaxEmissions) {
        ++n_dropped_;
        return;
    }
    emissions_[n_emissions_++] = {total, &record(lobe)};
}

Medium ClosureSet::medium(int lobe, Color extinction, Color scattering, const Phase& phase) const {
    return {valid_weight(extinction), lobe < 0 ? kBlack : valid_weight(scattering), phase,
            lobe < 0 ? nullptr : &record(lobe)};
}

void ClosureSet::add_haze(int lobe, Color extinction, Color scattering, const Phase& phase) {
    if (!in_volume_) {
        const std::array both{interior_.medium, medium(lobe, extinction, scattering, phase)};
        interior_.medium = mixed(both);
        interior_.is_body = true;
        return;
    }
    add_medium(medium(lobe, scale_ * extinction, scale_ * scattering, phase));
}

void ClosureSet::add_medium(const Medium& medium) {
    if (is_black(medium.extinction) && !medium.scatters()) return;
    if (n_media_ == kMaxMedia) {
        ++n_dropped_;
        return;
    }
    media_[n_media_++] = medium;
}

void ClosureSet::scatter_in_media(float weight) {
    for (const Medium& m : media()) {
        const Color total = m.scattering * weight;
        if (is_black(total) || !is_finite(total) || n_ == kMaxClosures) continue;
        closures_[n_++] = {PhaseLobe(m.phase), total, m.record, 0, true};
    }
}

Color ClosureSet::extinction() const {
    Color sum;
    for (const Medium& medium : media())
        sum += medium.extinction;
    return sum;
}

LobeEval ClosureSet::eval(std::size_t i, Vec3f wi) const noexcept {
    const Closure& c = closures_[i];
    const Vec3f wi_local = frames_[c.frame].local_from_world(wi);
    LobeEval e = visit_lobe(
        [&](const auto& model) { return model.eval(wo_local_[c.frame], wi_local); }, c.model);
    e.f *= c.weight;
    return e;
}

LobeSample ClosureSet::sample(std::size_t i, Vec2f u, float u_choice) const noexcept {
    const Closure& c = closures_[i];
    LobeSample s = visit_lobe(
        [&](const auto& model) { return model.sample(wo_local_[c.frame], u, u_choice); }, c.model);
    s.wi = frames_[c.frame].world_from_local(s.wi);
    s.f *= c.weight;
    return s;
}

Color ClosureSet::albedo(std::size_t i) const noexcept {
    const Closure& c = closures_[i];
    if (c.albedo) return c.weight * *c.albedo;
    return c.weight *
           visit_lobe([&](const auto& model) { return model.albedo(wo_local_[c.frame]); },
                      c.model);
}

bool ClosureSet::delta(std::size_t i) const noexcept {
    return visit_lobe([](const auto& model) { return model.delta(); }, closures_[i].model);
}

}  // namespace lightsieve
