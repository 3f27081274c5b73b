// Gradient noise in three dimensions and time, and sums of octaves of it. Arnold's own functions are private: these have the
// same range and parameters, not the same bumps.
//
// Source: Perlin 2002, "Improving Noise" (the fade curve; gradients by a hash, here of 32 bits so that the pattern has no
// visible period).
#pragma once

#include <cmath>
#include <cstdint>

#include "nodes/math/math_node.h"

namespace lightsieve {

namespace perlin_detail {

inline std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::int32_t z, std::int32_t w) {
    std::uint32_t h = mixed_bits(0x5bd1e995U, static_cast<std::uint32_t>(x));
    h = mixed_bits(h, static_cast<std::uint32_t>(y));
    h = mixed_bits(h, static_cast<std::uint32_t>(z));
    return w == 0 ? h : mixed_bits(h, static_cast<std::uint32_t>(w));
}
/// One of the twelve directions to the edges of a cube, times (x, y, z).
inline float gradient(std::uint32_t hash, Vec3f p) {
    const std::uint32_t h = hash & 15U;
    const float u = h < 8 ? p.x : p.y, v = h < 4 ? p.y : h == 12 || h == 14 ? p.x : p.z;
    return ((h & 1U) != 0 ? -u : u) + ((h & 2U) != 0 ? -v : v);
}
inline float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
/// A whole number that fits, whatever comes in.
inline std::int32_t cell_of(float x) {
    constexpr float kFar = 1e9F;
    return static_cast<std::int32_t>(std::floor(x > -kFar ? std::fmin(x, kFar) : -kFar));
}
/// Noise of one moment.
inline float noise3(Vec3f p, std::int32_t moment) {
    const std::int32_t x = cell_of(p.x), y = cell_of(p.y), z = cell_of(p.z);
    const Vec3f f{p.x - static_cast<float>(x), p.y - static_cast<float>(y),
                  p.z - static_cast<float>(z)};
    const Vec3f s{fade(unit(f.x)), fade(unit(f.y)), fade(unit(f.z))};
    const auto corner = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        const Vec3f from{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
        return gradient(lattice_hash(x + i, y + j, z + k, moment), f - from);
    };
    const auto row = [&](std::int32_t j, std::int32_t k) {
        return lerp(corner(0, j, k), corner(1, j, k), s.x);
    };
    const auto plane = [&](std::int32_t k) { return lerp(row(0, k), row(1, k), s.y); };
    return lerp(plane(0), plane(1), s.z);
}

}  // namespace perlin_detail

/// Noise in [-1,1], 0 at whole coordinates, that changes smoothly with the time.
[[nodiscard]] inline float perlin_noise(Vec3f p, float time = 0) {
    using namespace perlin_detail;
    if (!is_finite(p) || !std::isfinite(time)) return 0;
    const std::int32_t t = cell_of(time);
    const float f = time - static_cast<float>(t);
    const float first = noise3(p, t);
    return f > 0 ? lerp(first, noise3(p, t + 1), fade(unit(f))) : first;
}

/// Octaves of noise, each half as strong as the one before; in [-1,1].
[[nodiscard]] inline float fractal_noise(Vec3f p, std::int32_t octaves, float lacunarity,
                                         float time = 0) {
    constexpr std::int32_t kMost = 32;  // finer ones are below the resolution of floats
    float sum = 0, weight = 1, total = 0;
    for (std::int32_t i = 0; i < std::clamp(octaves, 1, kMost); ++i) {
        sum += weight * perlin_noise(p, time);
        total += weight;
        weight *= 0.5F;
        // The octaves must not meet in the origin.
        p = p * lacunarity + Vec3f{17.3F, -9.1F, 5.7F};
    }
    return sum / total;
}

}  // namespace lightsieve
