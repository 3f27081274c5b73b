// Pixel filters, importance-sampled: a sample belongs to one pixel and carries no weight where the filter is positive.
#pragma once

#include "core/vec.h"

namespace lightsieve {

class PixelFilter {
  public:
    virtual ~PixelFilter() = default;
    /// Half of the full support, in pixels.
    [[nodiscard]] virtual float radius() const = 0;
    /// Value at an offset from the pixel's centre, not normalised.
    [[nodiscard]] virtual float eval(Vec2f offset) const = 0;
    struct Sample {
        Vec2f offset;  ///< from the pixel's centre, in pixels
        float weight =
            1;  ///< eval / (pdf * integral of eval): 1, or +-a constant for filters with negative lobes
    };
    [[nodiscard]] virtual Sample sample(Vec2f u) const = 0;
    /// Density of sample() at an offset, per square pixel.
    [[nodiscard]] virtual float pdf(Vec2f offset) const = 0;
    /// Keeps the sample nearest to the camera instead of a mean (closest_filter).
    [[nodiscard]] virtual bool closest() const { return false; }
};

}  // namespace lightsieve
