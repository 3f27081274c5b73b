// How the eye sees single wavelengths, for lobes whose colour comes from the wave nature of light.
#pragma once

#include <array>

#include "core/vec.h"

namespace lightsieve {

/// A Gaussian of the eye's sensitivity over the wave number. Belcour and Barla 2017, supplemental code.
struct Sensitivity {
    float value, position, variance;  ///< position [1/m]
    int component;                    ///< of XYZ
};
inline constexpr std::array<Sensitivity, 4> kEye{{{5.4856e-13F, 1.6810e+06F, 4.3278e+09F, 0},
                                                  {9.7470e-14F, 2.2399e+06F, 4.5282e+09F, 0},
                                                  {4.4201e-13F, 1.7953e+06F, 9.3046e+09F, 1},
                                                  {5.2481e-13F, 2.2084e+06F, 6.6121e+09F, 2}}};
/// Brings the integral over wavelengths to 1.
inline constexpr float kEyeNorm = 1 / 1.0685e-7F;

/// XYZ, white where all wavelengths are equal, to ACEScg (CIE xy of AP1's primaries, Bradford adaptation from E to D60).
[[nodiscard]] inline Color rgb_of(const std::array<float, 3>& xyz) {
    return {1.594218093F * xyz[0] - 0.367845807F * xyz[1] - 0.226372286F * xyz[2],
            -0.690518968F * xyz[0] + 1.672303585F * xyz[1] + 0.018215383F * xyz[2],
            0.011106827F * xyz[0] - 0.006693548F * xyz[1] + 0.995586721F * xyz[2]};
}

}  // namespace lightsieve
