// Warps of uniform numbers to directions and discs, and tabulated distributions.
//
// Every warp takes u in [0,1)^2 and has its density beside it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace lightsieve {

/// The largest float below 1.
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1F;

/// Uniform on the unit disc. Source: Shirley and Chiu 1997.
[[nodiscard]] Vec2f sample_concentric_disk(Vec2f u);
/// Cosine-weighted around +z; density cos/pi per solid angle.
[[nodiscard]] Vec3f sample_cosine_hemisphere(Vec2f u);
/// Uniform on the sphere; density 1/(4 pi).
[[nodiscard]] Vec3f sample_uniform_sphere(Vec2f u);
/// Uniform in the cone of half angle acos(cos_max) around +z; density 1/(2 pi (1 - cos_max)).
/// one_minus_cos_max  1 - cos of the half angle, given apart because narrow cones would lose it to rounding
[[nodiscard]] Vec3f sample_uniform_cone(Vec2f u, float one_minus_cos_max);
/// Uniform barycentrics (b0, b1) of a triangle; b2 = 1 - b0 - b1.
[[nodiscard]] Vec2f sample_uniform_triangle(Vec2f u);

/// Power heuristic with exponent 2 for one sample of each strategy. Source: Veach 1997, eq. 9.13.
[[nodiscard]] constexpr float power_heuristic(float pdf, float other) {
    if (!(pdf > 0)) return 0;
    const float r = other / pdf;
    return 1 / (1 + r * r);
}

/// A piecewise constant density over n equal cells of [0,1).
class Distribution1D {
  public:
    Distribution1D() = default;
    /// values >= 0; if all are 0 the distribution is uniform.
    explicit Distribution1D(std::span<const float> values);
    struct Sample {
        std::size_t index;  ///< the cell
        float x;            ///< in [0,1)
        float pdf;          ///< density over [0,1)
        float remapped;     ///< u stretched over the chosen cell, to be used again
    };
    [[nodiscard]] Sample sample(float u) const;
    /// Density over [0,1) of cell `index`.
    [[nodiscard]] float pdf(std::size_t index) const;
    /// Probability of cell `index`.
    [[nodiscard]] float probability(std::size_t index) const;
    [[nodiscard]] std::size_t size() const { return cdf_.empty() ? 0 : cdf_.size() - 1; }
    /// Mean of the values.
    [[nodiscard]] float integral() const { return integral_; }

  private:
    std::vector<float> cdf_;
    float integral_ = 0;
};

/// A piecewise constant density over [0,1)^2, row by row. For environment maps.
class Distribution2D {
  public:
    Distribution2D() = default;
    Distribution2D(std::span<const float> values, std::size_t width, std::size_t height);
    struct Sample {
        Vec2f uv;
        float pdf;  ///< density over the unit square
    };
    [[nodiscard]] Sample sample(Vec2f u) const;
    [[nodiscard]] float pdf(Vec2f uv) const;
    [[nodiscard]] float integral() const { return rows_.integral(); }

  private:
    std::vector<Distribution1D> columns_;
    Distribution1D rows_;
};

}  // namespace lightsieve
