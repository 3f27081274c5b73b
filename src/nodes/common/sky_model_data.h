// Where the numbers of sky_model.h are: the authors' published tables, under their own licence (see the .cpp).
#pragma once

#include <array>

namespace lightsieve::sky_data {

/// For red, green, blue: ground albedo 0 and 1, by turbidity 1 to 10, by the six control points of a quintic over the sun's
/// elevation, by the nine parameters of the formula.
extern const std::array<std::array<float, 1080>, 3> kShape;
/// The same for the mean radiance, which is one number.
extern const std::array<std::array<float, 120>, 3> kRadiance;

}  // namespace lightsieve::sky_data
