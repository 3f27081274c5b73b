// Where a direction lies in pictures of the surroundings.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/vec.h"

namespace lightsieve {

enum class DomeFormat : std::int32_t { MirroredBall, Angular, LatLong };

/// Texture coordinates of a unit direction. The middle of every picture shows +Z, with +X to the left.
inline Vec2f dome_uv(DomeFormat format, Vec3f d) {
    if (format == DomeFormat::LatLong)
        return {0.5F - std::atan2(d.x, d.z) / (2 * kPi),
                0.5F + std::asin(std::clamp(d.y, -1.0F, 1.0F)) * kInvPi};
    // Both discs: direction around the middle, distance by the angle to +Z. Source: Debevec 1998, "Rendering
    // Synthetic Objects into Real Scenes" (mirrored ball), and his light probe gallery (angular map).
    const float across = std::sqrt(d.x * d.x + d.y * d.y);
    const float angle = std::atan2(across, d.z);
    const float r = format == DomeFormat::Angular ? angle * kInvPi : std::sin(angle * 0.5F);
    const float scale = across > 0 ? 0.5F * r / across : 0;
    return {0.5F - d.x * scale, 0.5F + d.y * scale};
}

}  // namespace lightsieve
