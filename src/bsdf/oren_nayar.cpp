#include "bsdf/oren_nayar.h"

#include "core/sampling.h"

namespace lightsieve {
namespace {

float non_negative(float v) { return v > 0 && std::isfinite(v) ? v : 0.0F; }

/// A and B of the header.
struct Factors {
    float a, b;
};
Factors factors(float roughness) {
    const float r2 = roughness * roughness;
    return {1 - 0.5F * r2 / (r2 + 0.57F), 0.45F * r2 / (r2 + 0.09F)};
}

/// Albedo of a white surface as the formula has it.
///
/// The integral of max(0, s) / max(cos_i, cos_o) cos_i / pi over wi: half of the circle has cos phi > 0 and a mean of 2; what
/// is left is one over sines and cosines on either side of theta_i = theta_o.
float white_albedo(float cosine, const Factors& f) {
    const float c = std::clamp(cosine, 1e-4F, 1.0F), s = safe_sqrt(1 - c * c);
    const float below = 0.5F * (std::atan2(s, c) - s * c);
    const float above = (1 - s * s * s) / (3 * c);
    return f.a + f.b * (2 * kInvPi) * s * (below + above);
}

}  // namespace

OrenNayarReflect::OrenNayarReflect(Color reflectance, float diffuse_roughness) noexcept
    : color(non_negative(reflectance.r), non_negative(reflectance.g), non_negative(reflectance.b)),
      roughness(std::min(non_negative(diffuse_roughness), 1.0F)) {}

LobeEval OrenNayarReflect::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z > 0)) return {};
    const Factors f = factors(roughness);
    const float s = dot(wo, wi) - wo.z * wi.z;
    const float shape = s > 0 ? f.a + f.b * s / std::max(wo.z, wi.z) : f.a;
    const float scale = 1 / std::max(1.0F, white_albedo(wo.z, f));
    return {color * (shape * scale * kInvPi * wi.z), kInvPi * wi.z};
}

LobeSample OrenNayarReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    const Vec3f wi = sample_cosine_hemisphere(u);
    if (!(wi.z > 0)) return {};
    const LobeEval e = eval(wo, wi);
    return {wi, e.f, e.pdf};
}

Color OrenNayarReflect::albedo(Vec3f wo) const noexcept {
    return color * std::min(1.0F, white_albedo(wo.z, factors(roughness)));
}

}  // namespace lightsieve
