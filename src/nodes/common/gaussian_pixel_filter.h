// The round Gaussian of gaussian_filter, cut off at its radius.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "scene/pixel_filter.h"

namespace lightsieve {

/// f(d) = exp(-2 (d/r)^2) for d <= r. Measured on Arnold's pictures: width 2 fits best with this exponent.
class GaussianPixelFilter final : public PixelFilter {
  public:
    /// radius  [pixels]
    explicit GaussianPixelFilter(float radius) : radius_(radius) {}
    [[nodiscard]] float radius() const override { return radius_; }

    [[nodiscard]] float eval(Vec2f offset) const override {
        const float t2 = (offset.x * offset.x + offset.y * offset.y) / (radius_ * radius_);
        // A hair beyond the edge belongs to the support: sample() may round there.
        return t2 <= 1 + 1e-5F ? std::exp(-kExponent * t2) : 0;
    }

    /// The radius of a uniform point of the disc, d^2 = u r^2, is warped by the inverse of F(d) = (1 - exp(-2 d^2/r^2)) / (1 - exp(-2)).
    [[nodiscard]] Sample sample(Vec2f u) const override {
        const Vec2f disk = sample_concentric_disk(u);
        const float u2 = std::min(disk.x * disk.x + disk.y * disk.y, 1.0F);
        if (!(u2 > 0)) return {{0, 0}, 1};
        const float t = std::sqrt(std::min(-std::log1p(-u2 * kMass) / kExponent, 1.0F));
        return {disk * (t * radius_ / std::sqrt(u2)), 1};
    }

    [[nodiscard]] float pdf(Vec2f offset) const override {
        return eval(offset) * kExponent / (kPi * radius_ * radius_ * kMass);
    }

  private:
    static constexpr float kExponent = 2;
    static constexpr float kMass = 0.86466471676F;  ///< 1 - exp(-kExponent)
    float radius_;
};

}  // namespace lightsieve
