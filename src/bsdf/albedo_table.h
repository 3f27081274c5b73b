// Directional albedos, tabulated: how much of the light from direction wo a lobe returns in all.
//
// Layering weights lower lobes by 1 - R of the lobe above (shading rules of standard_surface), compensation of
// multiple scattering needs E of white microfacets, refraction is normalised by its own albedo. All are integrals
// without closed form; tools/make_albedo_table.cpp integrates them at the nodes that albedo_grid.h lays out.
// Precision against numerical integration (albedo_table_test.cpp): E 1e-3, R 1e-3 on average and 1e-2 at worst (at the
// horizon, and from inside near the critical angle). Safe to call from many threads; no start-up cost; 50 KB of data.
#pragma once

#include <array>

namespace lightsieve {

/// Albedo of GGX reflection with F = 1: single scattering only, so 1 - E is what bounces among the facets.
/// cos_theta  of wo, (0,1];  alpha  GGX width, [0,1] (0: smooth, E = 1)
[[nodiscard]] float ggx_albedo(float cos_theta, float alpha) noexcept;

/// The cosines at which white microfacets reflect, as three values and their weights (a Gauss quadrature of their
/// distribution): the albedo with any Fresnel curve F is E * sum of weight * F(cosine), nearly.
struct MeanCosines {
    std::array<float, 3> cosine;
    std::array<float, 3> weight;  ///< adds up to 1
};
/// The same arguments as ggx_albedo.
[[nodiscard]] MeanCosines ggx_mean_cosines(float cos_theta, float alpha) noexcept;

/// Albedo of DielectricReflect; the R of layering. Exactly Fresnel for alpha = 0.
/// eta  n(far side) / n(side of wo), both above and below 1, within [1/kMaxEta, kMaxEta]
[[nodiscard]] float dielectric_albedo(float cos_theta, float alpha, float eta) noexcept;

/// What an interface does with the light from wo.
struct DielectricShares {
    float reflected;  ///< R, as dielectric_albedo
    float
        refracted;  ///< T / (1 - R), T the albedo of Walter's refraction with (1 - F): the rest is lost to shadowing
};
/// The same arguments as dielectric_albedo.
[[nodiscard]] DielectricShares dielectric_shares(float cos_theta, float alpha, float eta) noexcept;

/// Albedo of SheenReflect.
/// roughness  [kMinSheenRoughness, 1]
[[nodiscard]] float sheen_albedo(float cos_theta, float roughness) noexcept;

}  // namespace lightsieve
