// Four colours to three, unbiased, their sum unchanged.
//
// Any four vectors of R^3 have a vector v with sum v_i x_i = 0. Scaling the four by 1 + a v_i (or by 1 - b v_i) leaves
// the sum as it is; a and b are chosen so that one factor becomes 0 and none negative, and between the two directions
// with odds b : a, so that the mean of every factor is 1.
#pragma once

#include <array>
#include <cstddef>

#include "core/vec.h"

namespace lightsieve {

/// Rescales `x` (no negative entries) so that one entry becomes black; returns which.
///
/// u        uniform in [0,1)
/// returns  index of the entry to drop; the sum of all four is unchanged to rounding, each entry's mean is its old value
[[nodiscard]] std::size_t drop_one_of_four(std::array<Color, 4>& x, float u);

}  // namespace lightsieve
