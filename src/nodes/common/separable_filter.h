// Pixel filters f(x) f(y) given by their profile f, sampled exactly.
//
// Samples follow |f| / integral |f|: a table of the integral finds a small cell, Newton's method the place within it,
// with the profile itself as density. So the weight is a constant, with the sign of f; 1 where f has no negative lobes.
// Cells end at zeros of f, where |f| has a kink. Costs some evaluations of f a sample; camera samples are few.
// Source: Ernst, Stamminger, Greiner 2006, "Filter Importance Sampling".
#pragma once

#include <functional>
#include <vector>

#include "scene/pixel_filter.h"

namespace lightsieve {

class SeparableFilter final : public PixelFilter {
  public:
    /// radius   half of the support [pixels]
    /// profile  f on [0, radius], even, continuous; f(0) > 0
    SeparableFilter(float radius, std::function<double(double)> profile);

    [[nodiscard]] float radius() const override { return radius_; }
    [[nodiscard]] float eval(Vec2f offset) const override;
    [[nodiscard]] Sample sample(Vec2f u) const override;
    [[nodiscard]] float pdf(Vec2f offset) const override;

  private:
    [[nodiscard]] double profile_at(float x) const;
    /// Integral of |f| over [a, b] within a cell.
    [[nodiscard]] double magnitude(double a, double b) const;
    /// The place on [-radius, radius] of a uniform number.
    [[nodiscard]] double invert(float u) const;

    float radius_;
    std::function<double(double)> profile_;
    std::vector<double> edges_;       ///< ends of the cells, from 0 to radius
    std::vector<double> cumulative_;  ///< integral of |f| from 0 to each edge
    double scale_ = 1;  ///< (integral of |f| / integral of f) squared: the weight's magnitude
};

}  // namespace lightsieve
