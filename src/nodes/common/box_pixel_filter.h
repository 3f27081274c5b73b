// The square that box_filter takes the mean over, and that closest_filter and farthest_filter choose from.
#pragma once

#include <cmath>

#include "scene/pixel_filter.h"

namespace lightsieve {

class BoxPixelFilter final : public PixelFilter {
  public:
    /// radius  half of the square's side [pixels]
    explicit BoxPixelFilter(float radius, Reduction reduction = Reduction::Mean)
        : radius_(radius), reduction_(reduction) {}
    [[nodiscard]] float radius() const override { return radius_; }
    [[nodiscard]] float eval(Vec2f offset) const override {
        return std::abs(offset.x) <= radius_ && std::abs(offset.y) <= radius_ ? 1.0F : 0.0F;
    }
    [[nodiscard]] Sample sample(Vec2f u) const override {
        return {{(2 * u.x - 1) * radius_, (2 * u.y - 1) * radius_}, 1};
    }
    [[nodiscard]] float pdf(Vec2f offset) const override {
        return eval(offset) / (4 * radius_ * radius_);
    }
    [[nodiscard]] Reduction reduction() const override { return reduction_; }

  private:
    float radius_;
    Reduction reduction_;
};

}  // namespace lightsieve
