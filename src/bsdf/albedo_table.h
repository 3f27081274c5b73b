// Directional albedos, tabulated: how much of the light from direction wo a lobe returns in all.
//
// Layering weights lower lobes by 1 - R of the lobe above (shading rules of standard_surface), compensation of
// multiple scattering needs E of white microfacets, refraction is normalised by its own albedo. All are integrals without
// closed form over two or three numbers.
// Precision: 1e-3 against numerical integration (albedo_table_test.cpp). Safe to call from many threads.
#pragma once

namespace lightsieve {

/// Albedo of GGX reflection with F = 1: single scattering only, so 1 - E is what bounces among the facets.
/// cos_theta  of wo, (0,1];  alpha  GGX width, [0,1] (0: smooth, E = 1)
[[nodiscard]] float ggx_albedo(float cos_theta, float alpha) noexcept;

/// Albedo of DielectricReflect; the R of layering. Exactly Fresnel for alpha = 0.
/// eta  n(far side) / n(side of wo), both above and below 1
[[nodiscard]] float dielectric_albedo(float cos_theta, float alpha, float eta) noexcept;

/// Albedo of Walter's refraction with (1 - F) before normalisation; the part 1 - R - this is lost to shadowing.
[[nodiscard]] float dielectric_transmittance(float cos_theta, float alpha, float eta) noexcept;

/// Albedo of SheenReflect.
[[nodiscard]] float sheen_albedo(float cos_theta, float roughness) noexcept;

}  // namespace lightsieve
