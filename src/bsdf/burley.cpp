#include "bsdf/burley.h"

#include "core/sampling.h"

namespace lightsieve {
namespace {

float non_negative(float v) { return v > 0 && std::isfinite(v) ? v : 0.0F; }

/// (1 - c)^5.
float schlick_weight(float c) {
    const float m = std::clamp(1 - c, 0.0F, 1.0F);
    return square(square(m)) * m;
}

/// Albedo of a white surface as the formula has it; above 1 near the horizon of rough ones.
///
/// With cos^2(theta_d) = (1 + wo . wi) / 2 the integral over wi is one over powers of cos_i, with and without (1 - cos_i)^5.
float white_albedo(float c, float roughness) {
    // 2 z^(n+1) (1 - z)^5 over z in [0,1], for n = 0, 1, 2.
    constexpr float kMoment0 = 1.0F / 21, kMoment1 = 1.0F / 84, kMoment2 = 1.0F / 252;
    const float a = schlick_weight(c), k = roughness - 0.5F, kc = roughness * c;
    const float sin2 = std::max(0.0F, 1 - c * c);
    const float once = a * (k + kc * (2.0F / 3)) + k * kMoment0 + kc * kMoment1;
    const float twice = k * k * kMoment0 + 2 * k * kc * kMoment1 + kc * kc * kMoment2 +
                        0.5F * roughness * roughness * sin2 * (kMoment0 - kMoment2);
    return 1 + once + a * twice;
}

}  // namespace

BurleyReflect::BurleyReflect(Color reflectance, float diffuse_roughness) noexcept
    : color(non_negative(reflectance.r), non_negative(reflectance.g), non_negative(reflectance.b)),
      roughness(std::min(non_negative(diffuse_roughness), 1.0F)) {}

LobeEval BurleyReflect::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z > 0)) return {};
    const float m = roughness * (1 + dot(wo, wi)) - 0.5F;
    const float shape = (1 + m * schlick_weight(wi.z)) * (1 + m * schlick_weight(wo.z));
    const float scale = 1 / std::max(1.0F, white_albedo(wo.z, roughness));
    return {color * (shape * scale * kInvPi * wi.z), kInvPi * wi.z};
}

LobeSample BurleyReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    const Vec3f wi = sample_cosine_hemisphere(u);
    if (!(wi.z > 0)) return {};
    const LobeEval e = eval(wo, wi);
    return {wi, e.f, e.pdf};
}

Color BurleyReflect::albedo(Vec3f wo) const noexcept {
    return color * std::min(white_albedo(wo.z, roughness), 1.0F);
}

}  // namespace lightsieve
