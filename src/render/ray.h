// Rays and what they meet, independent of the library that finds it.
#pragma once

#include <cstdint>

#include "core/float4.h"
#include "core/vec.h"

namespace lightsieve {

struct Ray {
    Vec3f origin;
    Vec3f direction;  ///< unit
    float t_min = 0;
    float t_max = kInfinity;
    float time = 0;  ///< [0,1] within the shutter
};

/// The nearest thing that a ray meets.
struct RayHit {
    float t = kInfinity;
    std::uint32_t object = 0;     ///< as given to AccelBuilder
    std::uint32_t primitive = 0;  ///< triangle or sphere of the object's geometry
    Vec2f barycentric;            ///< weights of the triangle's second and third corner
};

// Bits of ray and object masks. The low eight are Arnold's ray types (core/ray_type.h).
inline constexpr std::uint32_t kMaskShadowOpaque = 1U << 8U;  ///< casts shadows and is opaque
inline constexpr std::uint32_t kMaskShadowTransparent =
    1U << 9U;  ///< casts shadows, the shader decides how much

/// A point moved off a surface so far that rounding cannot put a ray from it back through the surface.
///
/// p  on the surface, computed from the primitive; n  the geometric normal on the side that the ray leaves to
/// source: Waechter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems ch. 6
[[nodiscard]] inline Vec3f offset_ray_origin(Vec3f p, Vec3f n) {
    constexpr float kOrigin = 1.0F / 32, kFloatScale = 1.0F / 65536, kIntScale = 256;
    // All coordinates at once: every ray that leaves a surface asks.
    const Float4 from{p.x, p.y, p.z, 0}, along{n.x, n.y, n.z, 0};
    // As words, which may wrap: -0 has no step further down. Where that happens the sum is not used.
    const Int4 steps = __builtin_convertvector(along * kIntScale, Int4);
    const Word4 moved =
        __builtin_bit_cast(Word4, from) + __builtin_bit_cast(Word4, from < 0 ? -steps : steps);
    const Int4 near_zero = (from < kOrigin) & (from > -kOrigin);
    const Float4 to = near_zero ? from + along * kFloatScale : __builtin_bit_cast(Float4, moved);
    return {to[0], to[1], to[2]};
}

}  // namespace lightsieve
