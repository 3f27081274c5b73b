// Texture coordinates of a named set in place of the first one.
#pragma once

#include <algorithm>
#include <cmath>

#include "io/texture.h"
#include "scene/describe.h"
#include "scene/shade_services.h"

namespace lightsieve {

/// The point with the texture coordinates of a set; as it is if the name is empty or the shape has no such set.
[[nodiscard]] inline ShadePoint with_uv_set(const ShadePoint& at, Name uvset) {
    ShadePoint out = at;
    UvPoint set;
    if (uvset.empty() || at.services == nullptr || !at.services->uv_set(at, uvset, set))
        return out;
    out.uv = set.uv;
    out.dp_du = set.dp_du;
    out.dp_dv = set.dp_dv;
    out.uv_width = set.width;
    return out;
}

/// The same for nodes that need the coordinates alone.
[[nodiscard]] inline UvPoint uv_of_set(const ShadePoint& at, Name uvset) {
    UvPoint set;
    if (!uvset.empty() && at.services != nullptr && at.services->uv_set(at, uvset, set))
        return set;
    return {at.uv, at.dp_du, at.dp_dv, at.uv_width};
}

/// The ray's footprint at a point, in texture coordinates: the round cross-section of the ray laid onto the surface, long
/// where it is seen edge-on. Round where the surface does not say how its coordinates run.
[[nodiscard]] inline TextureFootprint texture_footprint(const ShadePoint& at, const UvPoint& uv) {
    const Vec3f n = cross(uv.dp_du, uv.dp_dv);
    const float n2 = length_squared(n);
    if (!(n2 > 0) || !(uv.width > 0) || !(at.width > 0)) return TextureFootprint::round(uv.width);
    // Longer ones look all alike, and are what anisotropic look-ups stop at, too.
    constexpr float kMinCosine = 1.0F / 32;
    const Vec3f normal = n / std::sqrt(n2);
    const float cosine = std::max(std::abs(dot(normal, at.wo)), kMinCosine);
    const Vec3f across = normalize(cross(normal, at.wo), normalize(uv.dp_du, {1, 0, 0}));
    const Vec3f along = cross(normal, across);
    const auto in_uv = [&](Vec3f side) {
        return Vec2f{dot(side, cross(uv.dp_dv, n)) / n2, dot(side, cross(n, uv.dp_du)) / n2};
    };
    return {in_uv(across * at.width), in_uv(along * (at.width / cosine))};
}

}  // namespace lightsieve
