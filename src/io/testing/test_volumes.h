// What the volumes that tests read hold: voxels that follow from their numbers. Included by the program that writes the
// files (vdb_reader/testing) and by the tests that look into them.
#pragma once

#include <array>
#include <cstdint>

#include "io/volume_stream.h"

namespace lightsieve {

using TestVoxel = std::array<int, 3>;

/// Where voxels are active, half of them: a box on both sides of zero whose faces are no faces of leaves.
inline constexpr TestVoxel kTestLower{-9, 4, 20}, kTestUpper{10, 22, 37};
inline constexpr float kTestBackground = 0.125F;

/// Numbers of voxels to object space: turned, sheared, of unlike scales, moved.
inline constexpr VolumeTransform kTestTransform{
    {{0.4, 0.3, 0.05}, {-0.15, 0.2, 0.0}, {0.1, 0.0, 1.1}, {10.0, -5.0, 300.0}}};

/// A well mixed number. Source: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering" (pcg3d, its first output).
inline std::uint32_t test_hash(const TestVoxel& voxel, std::uint32_t seed) {
    std::uint32_t x = static_cast<std::uint32_t>(voxel[0]) * 1664525U + 1013904223U + seed;
    std::uint32_t y = static_cast<std::uint32_t>(voxel[1]) * 1664525U + 1013904223U;
    std::uint32_t z = static_cast<std::uint32_t>(voxel[2]) * 1664525U + 1013904223U;
    for (int round = 0; round < 2; ++round) {
        x += y * z;
        y += z * x;
        z += x * y;
        x ^= x >> 16U;
        y ^= y >> 16U;
        z ^= z >> 16U;
    }
    return x;
}

inline bool test_active(const TestVoxel& voxel) {
    for (std::size_t i = 0; i < 3; ++i)
        if (voxel[i] < kTestLower[i] || voxel[i] > kTestUpper[i]) return false;
    // The corners are active, so that the bounds are known.
    return voxel == kTestLower || voxel == kTestUpper || (test_hash(voxel, 99) & 1U) != 0;
}

/// In [0,4), of so few digits that a half holds it; the background where nothing is active.
inline float test_value(const TestVoxel& voxel, std::uint32_t seed) {
    if (!test_active(voxel)) return kTestBackground;
    return static_cast<float>(test_hash(voxel, seed) & 1023U) / 256;
}

}  // namespace lightsieve
