// Light that bounces among microfacets: what single scattering loses and opaque lobes give back.
//
// A lobe of reflectance F0 is scaled by 1 + F0 (1 - E) / E, E being what white microfacets return toward wo. The factor
// depends on wo only, so lobes with it are not exactly reciprocal. E is tabulated for isotropic lobes; for stretched
// ones it is estimated, and a part of the compensation is left out lest they return more than they receive.
// Source: Turquin, "Practical multiple scattering compensation for microfacet models", 2019, eq. 16.
#pragma once

#include "bsdf/albedo_table.h"
#include "bsdf/ggx.h"

namespace lightsieve {

/// What white microfacets do with the light from wo.
struct GgxWhite {
    float albedo;  ///< E
    float lost;    ///< (1 - E) / E, less for stretched lobes; 0 for smooth ones
};

[[nodiscard]] inline GgxWhite ggx_white(Vec3f wo, GgxAlpha alpha) noexcept {
    constexpr float kLeftOut =
        0.25F;  // of 0.2, 0.25 and 0.4 the one with a gain of at most 5 % and the least loss
    if (alpha.smooth()) return {1, 0};
    const float e = ggx_albedo(wo.z, alpha.toward(wo)), lost = 1 / e - 1;
    return {e, alpha.x == alpha.y ? lost : lost * (1 - kLeftOut * alpha.stretch())};
}

/// Directional albedo of a compensated lobe.
/// fresnel  gives the reflectance of a microfacet for its cosine
template <class Fresnel>
[[nodiscard]] inline Color ggx_compensated_albedo(Vec3f wo, GgxAlpha alpha, Color facing,
                                                  const Fresnel& fresnel) noexcept {
    if (alpha.smooth()) return fresnel(wo.z);
    const GgxWhite white = ggx_white(wo, alpha);
    const MeanCosines mean = ggx_mean_cosines(wo.z, alpha.toward(wo));
    Color sum;
    for (std::size_t i = 0; i < mean.cosine.size(); ++i)
        sum += mean.weight[i] * fresnel(mean.cosine[i]);
    return clamp(sum * (kWhite + facing * white.lost) * white.albedo, 0, 1);
}

}  // namespace lightsieve
