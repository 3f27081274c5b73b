// Arnold's ray types: bits of `visibility` and `sidedness`, and what depth limits and light multipliers go by.
// Values: the node reference's masks (camera 1 ... subsurface 128).
#pragma once

#include <cstdint>

namespace lightsieve {

enum class RayType : std::uint8_t {
    Camera = 0,
    Shadow = 1,
    DiffuseTransmit = 2,
    SpecularTransmit = 3,
    Volume = 4,
    DiffuseReflect = 5,
    SpecularReflect = 6,
    Subsurface = 7,
};

[[nodiscard]] constexpr std::uint8_t ray_bit(RayType type) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(type));
}

}  // namespace lightsieve
