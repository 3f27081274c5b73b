// The window of blackman_harris_filter.
#pragma once

#include <cmath>

namespace lightsieve {

/// The minimum 4-term window, t in [0, 1] from the centre to the edge. Source: Harris 1978, table 1.
inline double blackman_harris(double t) {
    constexpr double kPiD = 3.14159265358979323846;
    return 0.35875 + 0.48829 * std::cos(kPiD * t) + 0.14128 * std::cos(2 * kPiD * t) +
           0.01168 * std::cos(3 * kPiD * t);
}

}  // namespace lightsieve
