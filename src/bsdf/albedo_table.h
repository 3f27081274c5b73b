// Directional albedos, tabulated: how much of the light from direction wo a lobe returns in all.
//
// Layering weights lower lobes by 1 - R of the lobe above (shading rules of standard_surface), compensation of
// multiple scattering needs E of white microfacets, refraction is normalised by its own albedo. All are integrals without
// closed form over two or three numbers; tools/make_albedo_table.cpp integrates them, albedo_grid.h says where.
// Precision against numerical integration (albedo_table_test.cpp): E and R from outside about 1e-3, R from inside and T
// 1e-2 at worst, near the critical angle. Safe to call from many threads; no start-up cost; 44 KB of data.
#pragma once

namespace lightsieve {

/// Albedo of GGX reflection with F = 1: single scattering only, so 1 - E is what bounces among the facets.
/// cos_theta  of wo, (0,1];  alpha  GGX width, [0,1] (0: smooth, E = 1)
[[nodiscard]] float ggx_albedo(float cos_theta, float alpha) noexcept;

/// What Fresnel curves that are polynomials of the cosine c at the microfacet need for their albedo.
struct GgxMoments {
    float white;     ///< E, as ggx_albedo
    float schlick;   ///< mean of (1 - c)^5 over the reflected light
    float schlick6;  ///< mean of c (1 - c)^6
};
[[nodiscard]] GgxMoments ggx_moments(float cos_theta, float alpha) noexcept;

/// Albedo of DielectricReflect; the R of layering. Exactly Fresnel for alpha = 0.
/// eta  n(far side) / n(side of wo), both above and below 1, within [1/kMaxEta, kMaxEta]
[[nodiscard]] float dielectric_albedo(float cos_theta, float alpha, float eta) noexcept;

/// Albedo of Walter's refraction with (1 - F), before DielectricTransmit scales it to 1; the part 1 - R - this is what
/// shadowing loses.
[[nodiscard]] float dielectric_transmittance(float cos_theta, float alpha, float eta) noexcept;

/// Albedo of SheenReflect.
/// roughness  [kMinSheenRoughness, 1]
[[nodiscard]] float sheen_albedo(float cos_theta, float roughness) noexcept;

}  // namespace lightsieve
