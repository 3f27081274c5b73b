#include "bsdf/diffuse.h"

#include "core/sampling.h"

namespace lightsieve {
namespace {

// Constants of the "FON" variant of Oren-Nayar; Portsmouth et al. 2025, listing 1.
constexpr float kFon1 = 0.5F - 2 / (3 * kPi);
constexpr float kFon2 = 2.0F / 3 - 28 / (15 * kPi);

/// Albedo of single scattering for reflectance 1: the polynomial fit of the paper's G (listing 1), within 1e-3.
float fon_albedo(float mu, float roughness, float a) {
    const float m = 1 - mu;
    const float g_over_pi =
        m * (0.0571085289F + m * (0.491881867F + m * (-0.332181442F + m * 0.0714429953F)));
    return std::min(a * (1 + roughness * g_over_pi), 1.0F);
}

/// Reflectance of the multiple-scattering part, eq. 26; `mean` is the mean albedo of single scattering.
float multiple(float reflectance, float mean) {
    const float rho = std::min(reflectance, 1.0F);
    return rho * rho * mean / (1 - rho * (1 - mean));
}

Color multiple(Color c, float mean) {
    return {multiple(c.r, mean), multiple(c.g, mean), multiple(c.b, mean)};
}

Vec3f mirrored(Vec3f w) { return {w.x, w.y, -w.z}; }

}  // namespace

Color DiffuseSurface::rough_value(Vec3f wo, Vec3f wi) const noexcept {
    // Single scattering: the QON form of Fujii with FON's normalisation (eq. 13 and 14).
    const float a = 1 / (1 + kFon1 * roughness);
    const float s = dot(wo, wi) - wo.z * wi.z;
    const float s_over_t = s > 0 ? s / std::max(wo.z, wi.z) : s;
    const float single = a * (1 + roughness * s_over_t);

    // Multiple scattering: what single scattering loses at both ends (eq. 24).
    const float mean = a * (1 + kFon2 * roughness);
    const float lost_o = 1 - fon_albedo(wo.z, roughness, a),
                lost_i = 1 - fon_albedo(wi.z, roughness, a);
    const float twice = lost_o * lost_i / (1 - mean);
    return (color * single + multiple(color, mean) * twice) * (kInvPi * wi.z);
}

Color DiffuseSurface::rough_albedo(float cos_theta_o) const noexcept {
    const float a = 1 / (1 + kFon1 * roughness);
    const float single = fon_albedo(cos_theta_o, roughness, a);
    return color * single + multiple(color, a * (1 + kFon2 * roughness)) * (1 - single);
}

LobeSample DiffuseReflect::sample(Vec3f wo, Vec2f u, float) const noexcept {
    const Vec3f wi = sample_cosine_hemisphere(u);
    if (!(wi.z > 0)) return {};
    return {wi, surface.value(wo, wi), kInvPi * wi.z};
}

LobeEval DiffuseTransmit::eval(Vec3f wo, Vec3f wi) const noexcept {
    if (!(wi.z < 0)) return {};
    return {surface.value(wo, mirrored(wi)), -kInvPi * wi.z};
}

LobeSample DiffuseTransmit::sample(Vec3f wo, Vec2f u, float) const noexcept {
    const Vec3f wi = sample_cosine_hemisphere(u);
    if (!(wi.z > 0)) return {};
    return {mirrored(wi), surface.value(wo, wi), kInvPi * wi.z};
}

}  // namespace lightsieve
