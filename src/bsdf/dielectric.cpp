#include "bsdf/dielectric.h"

#include "bsdf/fresnel.h"
#include "bsdf/ggx_compensation.h"

namespace lightsieve {
namespace {

/// Indices nearer to 1 than this times 1 / alpha blur less than kSmoothAlpha.
constexpr float kMatchedIndex = 0.5F * kSmoothAlpha;

/// Refraction is not scaled up beyond this share: at the horizon inside of rough media few samples would carry all.
constexpr float kMinRefracted = 0.15F;

float valid_eta(float eta) {
    return std::isfinite(eta) ? std::clamp(eta, 1 / kMaxEta, kMaxEta) : 1.0F;
}

/// The reflectance of a facet, with compensation from inside (see dielectric.h).
struct FacetReflectance {
    float eta, lost;
    Color operator()(float cos_theta) const noexcept {
        const float f = fresnel_dielectric(cos_theta, eta).reflectance;
        return Color::grey(f * (1 + lost * f));
    }
};

FacetReflectance facet_reflectance(Vec3f wo, GgxAlpha alpha, float eta) {
    return {eta, eta < 1 ? ggx_white(wo, alpha).lost : 0.0F};
}

/// Value and density of refraction; the microfacet is described by its cosines.
/// h_length  |wo + eta wi|
LobeEval refraction(Vec3f wo, Vec3f wi, GgxAlpha alpha, float eta, float d, float cos_o,
                    float cos_i, float fresnel, float h_length) {
    const float v_o = ggx_v(wo, alpha), v_i = ggx_v(wi, alpha);
    // Walter et al. 2007, eq. 17 and 21, with D G1 of visible normals; f * cos = pdf * (1 - F) G1(wi) / T.
    const float pdf = 2 * d * cos_o * cos_i * square(eta / h_length) / (wo.z + v_o);
    const float masking = -2 * wi.z / (v_i - wi.z);
    const DielectricShares shares = dielectric_shares(wo.z, alpha.toward(wo), eta);
    const float t = (1 - shares.reflected) * std::max(shares.refracted, kMinRefracted);
    return {Color::grey(t > 0 ? pdf * masking * (1 - fresnel) / t : 0.0F), pdf};
}

}  // namespace

DielectricReflect::DielectricReflect(GgxAlpha roughness, float relative_ior) noexcept
    : alpha(roughness), eta(valid_eta(relative_ior)) {}

LobeEval DielectricReflect::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z > 0) || alpha.smooth()) return {};
    return ggx_eval_reflection(wo, wi, alpha, facet_reflectance(wo, alpha, eta));
}

LobeSample DielectricReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    return ggx_sample_reflection(wo, u, alpha, facet_reflectance(wo, alpha, eta));
}

Color DielectricReflect::albedo(Vec3f wo) const noexcept {
    return Color::grey(dielectric_albedo(wo.z, alpha.toward(wo), eta));
}

DielectricTransmit::DielectricTransmit(GgxAlpha roughness, float relative_ior) noexcept
    : alpha(roughness), eta(valid_eta(relative_ior)) {}

bool DielectricTransmit::delta() const noexcept {
    return alpha.smooth() || std::max(alpha.x, alpha.y) * std::abs(eta - 1) < kMatchedIndex;
}

LobeEval DielectricTransmit::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z < 0) || delta()) return {};

    // The microfacet that refracts wo to wi, if there is one.
    Vec3f h = wo + wi * eta;
    if (h.z < 0) h = -h;
    const float h_squared = length_squared(h), h_length = std::sqrt(h_squared);
    const float cos_o = dot(wo, h) / h_length, cos_i = -dot(wi, h) / h_length;
    if (!(cos_o > 0) || !(cos_i > 0)) return {};
    const float fresnel = fresnel_dielectric(std::min(cos_o, 1.0F), eta).reflectance;
    if (fresnel >= 1) return {};
    return refraction(wo, wi, alpha, eta, ggx_d(h, h_squared, alpha), cos_o, cos_i, fresnel,
                      h_length);
}

LobeSample DielectricTransmit::sample(Vec3f wo, Vec2f u, float) const noexcept {
    const bool smooth = delta();
    const Vec3f h = smooth ? Vec3f{0, 0, 1} : ggx_sample_visible_normal(wo, alpha, u);
    const float cos_o = std::min(dot(wo, h), 1.0F);
    const FresnelDielectric fresnel = fresnel_dielectric(cos_o, eta);
    if (!(cos_o > 0) || !(fresnel.cos_far > 0)) return {};

    const Vec3f wi = normalize(h * (cos_o / eta - fresnel.cos_far) - wo * (1 / eta));
    if (!(wi.z < 0)) return {};
    if (smooth) return {wi, kWhite, 1};
    // |wo + eta wi| without its cancellation for eta near 1.
    const float h_length = std::abs((eta - 1) * (eta + 1)) / (cos_o + eta * fresnel.cos_far);
    const LobeEval e = refraction(wo, wi, alpha, eta, ggx_d(h, 1, alpha), cos_o, fresnel.cos_far,
                                  fresnel.reflectance, h_length);
    return {wi, e.f, e.pdf};
}

Color DielectricTransmit::albedo(Vec3f wo) const noexcept {
    if (delta()) return fresnel_dielectric(wo.z, eta).cos_far > 0 ? kWhite : kBlack;
    return Color::grey(
        std::min(dielectric_shares(wo.z, alpha.toward(wo), eta).refracted / kMinRefracted, 1.0F));
}

}  // namespace lightsieve
