// Space cut into cells around random points. Source: Worley 1996, "A Cellular Texture Basis Function".
#pragma once

#include <algorithm>
#include <cmath>

#include "nodes/texture/perlin.h"

namespace lightsieve {

/// What lies around a point: its own cell, and how far the nearest two cell points are.
struct CellPoint {
    std::uint32_t id = 0;                  ///< a hash of the cell, the same all over it
    Vec3f center;                          ///< of the nearest cell
    float nearest = 8, second = 8;         ///< distances
    float alligator1 = 0, alligator2 = 0;  ///< largest two bumps of random height
};

/// randomness  0: cells are cubes; 1: their points lie anywhere in the cubes
[[nodiscard]] inline CellPoint cell_at(Vec3f p, float randomness, float time = 0) {
    using namespace perlin_detail;
    CellPoint out;
    if (!is_finite(p)) return out;
    const std::int32_t x = cell_of(p.x), y = cell_of(p.y), z = cell_of(p.z);
    for (std::int32_t k = -1; k <= 1; ++k)
        for (std::int32_t j = -1; j <= 1; ++j)
            for (std::int32_t i = -1; i <= 1; ++i) {
                const std::uint32_t h = lattice_hash(x + i, y + j, z + k, 0);
                const auto along = [&](std::uint32_t axis) {
                    // Points go round in their cubes with the time.
                    const float start = unit_from_bits(mixed_bits(h, axis));
                    const float moved =
                        time == 0 ? start : 0.5F + 0.5F * std::sin(2 * kPi * (start + time));
                    return 0.5F + (moved - 0.5F) * randomness;
                };
                const Vec3f center{static_cast<float>(x + i) + along(0),
                                   static_cast<float>(y + j) + along(1),
                                   static_cast<float>(z + k) + along(2)};
                const float d = length(center - p);
                if (d < out.nearest) {
                    out.second = out.nearest;
                    out.nearest = d;
                    out.id = h;
                    out.center = center;
                } else {
                    out.second = std::min(out.second, d);
                }
                const float bump =
                    unit_from_bits(mixed_bits(h, 3)) * square(std::max(0.0F, 1 - d));
                if (bump > out.alligator1) {
                    out.alligator2 = out.alligator1;
                    out.alligator1 = bump;
                } else {
                    out.alligator2 = std::max(out.alligator2, bump);
                }
            }
    return out;
}

}  // namespace lightsieve
