// Fresnel reflectance: dielectrics (from both sides), metals, and the artist's parameters of metals. All inline.
//
// cos is that of the angle between the direction and the (micro)normal, in [0,1], on the side of the incident light.
#pragma once

#include "core/vec.h"

namespace lightsieve {

/// Reflectance of a dielectric interface and the cosine on the far side.
struct FresnelDielectric {
    float reflectance;  ///< 0..1; 1 under total internal reflection
    float cos_far;  ///< cosine of the refracted direction, >= 0; 0 under total internal reflection
};

/// Unpolarised reflectance of a dielectric.
/// eta     n(far side) / n(side of the light)
/// source  Walter et al. 2007, eq. 22, with (g - c) rewritten as (eta^2 - 1) / (g + c) against cancellation
[[nodiscard]] inline FresnelDielectric fresnel_dielectric(float cos_theta, float eta) noexcept {
    const float contrast = (eta - 1) * (eta + 1);
    const float g_squared = contrast + cos_theta * cos_theta;
    if (!(g_squared > 0)) return {1, 0};
    const float g = std::sqrt(g_squared);
    const float sum = g + cos_theta;
    const float difference = contrast / sum;
    const float perpendicular = difference / sum;
    const float ratio = (cos_theta * sum - 1) / (cos_theta * difference + 1);
    return {0.5F * perpendicular * perpendicular * (1 + ratio * ratio), g / eta};
}

/// Reflectance at normal incidence.
[[nodiscard]] inline float fresnel_dielectric_facing(float eta) noexcept {
    return square((eta - 1) / (eta + 1));
}

/// Unpolarised reflectance of a metal with index n and extinction k, relative to the side of the light.
/// source  Lagarde, "Memo on Fresnel equations", 2013 (the exact form), with the mean of both polarisations
///         Rs (1 + (t3 - t4) / (t3 + t4)) / 2 brought to one fraction
[[nodiscard]] inline float fresnel_conductor(float cos_theta, float n, float k) noexcept {
    const float cos2 = cos_theta * cos_theta, sin2 = 1 - cos2;
    const float n2 = n * n, k2 = k * k;
    const float t0 = n2 - k2 - sin2;
    const float a2_b2 = std::sqrt(t0 * t0 + 4 * n2 * k2);
    const float a = std::sqrt(std::max(0.0F, 0.5F * (a2_b2 + t0)));
    const float t1 = a2_b2 + cos2, t2 = 2 * cos_theta * a;
    const float t3 = cos2 * a2_b2 + sin2 * sin2, t4 = t2 * sin2;
    return std::max((t1 - t2) * t3 / ((t1 + t2) * (t3 + t4)),
                    0.0F);  // matched indices round to below 0
}

[[nodiscard]] inline Color fresnel_conductor(float cos_theta, Color n, Color k) noexcept {
    return {fresnel_conductor(cos_theta, n.r, k.r), fresnel_conductor(cos_theta, n.g, k.g),
            fresnel_conductor(cos_theta, n.b, k.b)};
}

}  // namespace lightsieve
