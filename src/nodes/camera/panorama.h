// Directions of pictures that show all around, in camera space: +X right, +Y up, looking along -Z.
#pragma once

#include <cmath>

#include "core/vec.h"

namespace lightsieve {

/// Longitude and latitude [rad] to a unit vector; 0, 0 is straight ahead, longitude grows to the right, latitude upward.
[[nodiscard]] inline Vec3f panorama_direction(float longitude, float latitude) {
    const float across = std::cos(latitude);
    return {across * std::sin(longitude), std::sin(latitude), -across * std::cos(longitude)};
}

}  // namespace lightsieve
