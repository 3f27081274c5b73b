// Shares of a face's corners at a point of a subdivided mesh: how user data and normals of the original mesh are blended.
#pragma once

#include <array>
#include <cstddef>

#include "scene/shape.h"

namespace lightsieve {

/// Corners of the quad that the triangles 2q and 2q + 1 are made of, in the order of a triangle's corners.
[[nodiscard]] constexpr std::array<std::uint32_t, 3> quad_corners(std::size_t triangle) {
    return triangle % 2 == 0 ? std::array<std::uint32_t, 3>{0, 1, 2}
                             : std::array<std::uint32_t, 3>{0, 2, 3};
}

/// Shares of the four corners of a grid, in their order, at a point of a triangle. They are those at the triangle's corners,
/// blended by `weights`: as positions are.
[[nodiscard]] inline std::array<float, 4> shares_in_grid(const MeshOrigin& origin,
                                                         std::size_t triangle,
                                                         const std::array<float, 3>& weights) {
    constexpr std::array<Vec2f, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const std::size_t quad = triangle / 2;
    const std::uint32_t face = origin.face[quad];
    const bool four = origin.first_corner[face + 1] - origin.first_corner[face] == 4;
    const float size = four ? origin.size_in_quads : origin.size_in_others;
    const std::array<std::uint32_t, 3> corners = quad_corners(triangle);
    std::array<float, 4> out{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2f p = origin.place[quad] + kCorners[corners[i]] * size;
        out[0] += weights[i] * (1 - p.x) * (1 - p.y);
        out[1] += weights[i] * p.x * (1 - p.y);
        out[2] += weights[i] * p.x * p.y;
        out[3] += weights[i] * (1 - p.x) * p.y;
    }
    return out;
}

/// Calls `body(slot, share)` for the corners of the face; `slot` is an index into MeshOrigin::corner and ::vertex. Blended
/// with them values are what they would be if they were refined linearly: of four corners bilinear; of others bilinear
/// between a corner, the middles of its edges and the middle of the face.
template <class Body>
void for_each_share(const MeshOrigin& origin, std::size_t triangle,
                    const std::array<float, 3>& weights, const Body& body) {
    const std::size_t quad = triangle / 2;
    const std::size_t first = origin.first_corner[origin.face[quad]];
    const std::size_t n = origin.first_corner[origin.face[quad] + 1] - first;
    const auto [w00, w10, w11, w01] = shares_in_grid(origin, triangle, weights);
    if (n == 4) {
        body(first, w00);
        body(first + 1, w10);
        body(first + 2, w11);
        body(first + 3, w01);
        return;
    }
    const std::size_t own = origin.quarter[quad];
    for (std::size_t i = 0; i < n; ++i) {
        float share = w11 / static_cast<float>(n);
        if (i == own) share += w00 + 0.5F * (w10 + w01);
        if (i == (own + 1) % n) share += 0.5F * w10;
        if (i == (own + n - 1) % n) share += 0.5F * w01;
        body(first + i, share);
    }
}

}  // namespace lightsieve
