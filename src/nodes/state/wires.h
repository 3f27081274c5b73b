// How near the edges of triangles and polygons are.
#pragma once

#include <algorithm>
#include <cmath>

#include "scene/shade_services.h"

namespace lightsieve {

/// Distance from the point to the nearest edge [scene units]; infinite for shapes without edges.
///
/// polygons  only edges of polygons count, not those that cut polygons into triangles
[[nodiscard]] inline float distance_to_edge(const ShadePoint& at, bool polygons) {
    ShadeServices::Triangle triangle;
    float nearest = kInfinity;
    if (at.services == nullptr || !at.services->triangle(at, triangle)) return nearest;
    for (std::size_t i = 0; i < 3; ++i) {
        if (polygons && !triangle.polygon_edge[i]) continue;
        const Vec3f a = triangle.corners[i], along = triangle.corners[(i + 1) % 3] - a,
                    from = at.position - a;
        const float len = length_squared(along);
        const float t = len > 0 ? std::clamp(dot(from, along) / len, 0.0F, 1.0F) : 0;
        nearest = std::min(nearest, length(from - along * t));
    }
    return nearest;
}

/// Part of a line of that width that covers the point; its edges are as soft as the ray's footprint.
[[nodiscard]] inline float line_cover(const ShadePoint& at, float width, bool polygons) {
    const float inside = 0.5F * width - distance_to_edge(at, polygons);
    const float soft = std::max(at.width, 1e-12F);
    return std::clamp(0.5F + inside / soft, 0.0F, 1.0F);
}

}  // namespace lightsieve
