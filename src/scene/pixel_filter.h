// Pixel filters, importance-sampled: a sample belongs to one pixel and carries no weight where the filter is positive.
#pragma once

#include <cstdint>

#include "core/vec.h"

namespace lightsieve {

/// What becomes of a pixel's samples.
enum class Reduction : std::uint8_t {
    Mean,          ///< their mean, weighed by the filter
    Closest,       ///< the one nearest to the camera
    Farthest,      ///< the one farthest from it; those that met nothing come last
    Variance,      ///< how much they vary, weighed by the filter, each channel by itself
    LumaVariance,  ///< the same of their luminance, in all channels
    Range          ///< the greatest less the smallest, each channel by itself
};

/// Sums of several layers are still those layers' sum.
[[nodiscard]] constexpr bool keeps_sums(Reduction reduction) {
    return reduction == Reduction::Mean || reduction == Reduction::Closest ||
           reduction == Reduction::Farthest;
}
/// One sample stands for the pixel.
[[nodiscard]] constexpr bool keeps_one_sample(Reduction reduction) {
    return reduction == Reduction::Closest || reduction == Reduction::Farthest;
}

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
    [[nodiscard]] virtual Reduction reduction() const { return Reduction::Mean; }
    /// Numbers are shown as colours (heatmap_filter).
    [[nodiscard]] virtual bool shows_heat() const { return false; }
    /// The colour of a number, if they are.
    [[nodiscard]] virtual Color heat(float value) const { return Color::grey(value); }
};

}  // namespace lightsieve
