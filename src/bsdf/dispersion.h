// Glass bends blue light more than red: index by wavelength, and the colour of a single wavelength.
//
// A path takes one wavelength, drawn as the eye sees them, and carries that one's colour from the first refraction on that
// depends on it. The mean colour over all wavelengths is exactly white, so that glass without dispersion looks the same
// whether paths take wavelengths or not.
#pragma once

#include "core/vec.h"

namespace lightsieve {

/// The Fraunhofer lines that indices and Abbe numbers are given for [nm].
inline constexpr float kLineF = 486.1F, kLineD = 587.6F, kLineC = 656.3F;

/// Index of refraction for a wavelength: Cauchy's n = A + B / wavelength^2 through the index at the line d and the Abbe number.
///
/// ior   at line d
/// abbe  (n_d - 1) / (n_F - n_C), > 0; anything else: no dispersion
/// nm    the wavelength
[[nodiscard]] inline float dispersed_ior(float ior, float abbe, float nm) noexcept {
    if (!(abbe > 0)) return ior;
    constexpr float kSpan = 1 / (kLineF * kLineF) - 1 / (kLineC * kLineC);
    const float b = (ior - 1) / (abbe * kSpan);
    return ior + b * (1 / (nm * nm) - 1 / (kLineD * kLineD));
}

/// A wavelength and what a path that has it carries.
struct Wavelength {
    float nm = kLineD;
    Color weight{1, 1, 1};  ///< linear ACEScg, >= 0; white on average
};

/// Drawn with the mean of the three channels' sensitivities (bsdf/spectrum.h) as density, so that no weight is above 3.
///
/// u  in [0,1)
[[nodiscard]] Wavelength sample_wavelength(float u) noexcept;

}  // namespace lightsieve
