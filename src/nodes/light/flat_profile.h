// What makes a flat light less than an even Lambertian emitter: `spread`, `roundness`, `soft_edge`.
//
// All three are factors on the radiance. Arnold does not publish its curves; these are documented choices:
//   spread     a grid of slats in front of the light, like a photographer's: light leaves up to the half angle
//              h = spread * 90 degrees, as 1 - tan(angle) / tan(h), and as much of it in all as without the grid.
//              Source: the soft-box grid of Blender's Cycles, of which the normalisation is the integral below.
//   roundness  the superellipse of superellipse.h, within the quadrilateral. The part that is cut off is dark: what is
//              left is as bright as before.
//   soft_edge  a smoothstep from the outline inward, over that part of the way to the middle.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/vec.h"
#include "nodes/light/superellipse.h"

namespace lightsieve {

/// Radiance of a flat light by the angle to its normal.
class Spread {
  public:
    /// As wide as it gets: a factor of 1.
    Spread() = default;
    /// spread  1: to all sides, 0: as near to parallel as is supported
    explicit Spread(float spread) {
        // A beam of no angle would have infinite radiance; and within 1e-3 of 1 tangents have no digits left.
        constexpr double kMinHalfAngle = 0.005;
        constexpr float kWide = 0.999F;
        if (!(spread < kWide)) return;
        const double half =
            std::max(static_cast<double>(std::max(spread, 0.0F)) * 0.5 * static_cast<double>(kPi),
                     kMinHalfAngle);
        tangent_ = static_cast<float>(std::tan(half));
        cosine_ = static_cast<float>(std::cos(half));
        // Integral of (1 - tan t / tan h) cos t over the directions within h, over pi: 1 - h / tan h.
        peak_ = static_cast<float>(1 / (1 - half / std::tan(half)));
    }

    [[nodiscard]] bool is_wide() const { return tangent_ == kInfinity; }
    /// The factor on the radiance in a direction.
    ///
    /// normal     unit
    /// direction  of any length, on the lit side
    [[nodiscard]] float at(Vec3f normal, Vec3f direction) const {
        if (is_wide()) return 1;
        // Not from the cosine, which has no digits for narrow beams.
        const float tangent = length(cross(normal, direction)) / dot(normal, direction);
        return tangent < tangent_ ? peak_ * (1 - tangent / tangent_) : 0;
    }
    /// The factor along the normal, the largest there is.
    [[nodiscard]] float peak() const { return peak_; }
    /// Tangent and cosine of the half angle beyond which it is dark.
    [[nodiscard]] float tangent() const { return tangent_; }
    [[nodiscard]] float cosine() const { return cosine_; }

  private:
    float tangent_ = kInfinity, cosine_ = 0, peak_ = 1;
};

/// Radiance of a quadrilateral light by the place on it.
class Outline {
  public:
    /// The whole quadrilateral: a factor of 1.
    Outline() : shape_(0) {}
    Outline(float roundness, float soft_edge)
        : shape_(roundness), soft_(std::clamp(soft_edge, 0.0F, 1.0F)) {}

    [[nodiscard]] bool is_whole() const { return shape_.is_square() && !(soft_ > 0); }
    /// uv  in [0,1]^2 over the quadrilateral
    [[nodiscard]] float at(Vec2f uv) const {
        if (is_whole()) return 1;
        const float inside = 1 - shape_.norm(std::abs(2 * uv.x - 1), std::abs(2 * uv.y - 1));
        if (!(inside > 0)) return 0;
        if (!(inside < soft_)) return 1;
        const float t = inside / soft_;
        return t * t * (3 - 2 * t);
    }

  private:
    Superellipse shape_;
    float soft_ = 0;
};

/// Both together.
struct FlatProfile {
    Outline outline;
    Spread spread;

    [[nodiscard]] bool is_plain() const { return spread.is_wide() && outline.is_whole(); }
    /// normal, direction  as for Spread; uv: place on the light
    [[nodiscard]] float at(Vec3f normal, Vec3f direction, Vec2f uv) const {
        return is_plain() ? 1 : spread.at(normal, direction) * outline.at(uv);
    }
};

}  // namespace lightsieve
