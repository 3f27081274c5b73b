// min_pixel_width: curves and points that are too thin for the camera samples to find reliably are drawn wider, and as much
// more transparent, so that their mean stays what it is and a few samples give it.
//
// The width on the picture is that for the camera of the frame (common/dicing.h), where the shape itself stands: instances of it have
// the same radii. Rays of all kinds meet the wider shape, so shadows and reflections keep their mean, too.
#pragma once

#include <cmath>

#include "nodes/common/dicing.h"
#include "scene/value.h"

namespace lightsieve {

class PixelWidth {
  public:
    /// min_width  least width on the picture [pixels]; 0 and less, or not finite: nothing is widened
    /// matrix     world_from_object of the shape; the first key counts
    PixelWidth(float min_width, const Array<Mat4f>& matrix, NodeContext& context)
        : view_(context.camera(), context.frame()),
          place_(matrix.empty() ? Mat4f{} : matrix[0]),
          scale_(std::cbrt(std::abs(place_.determinant3()))),
          least_(std::isfinite(min_width) && scale_ > 0 ? std::max(min_width, 0.0F) : 0) {}

    [[nodiscard]] bool acts() const { return least_ > 0; }
    /// The radius to draw in place of `radius` at `p`; object space.
    [[nodiscard]] float widened(Vec3f p, float radius) const {
        // What a pixel covers at that distance; the thing's own size would count where the camera is inside of it.
        constexpr float kUnit = 1e-6F;
        const float pixels = view_.pixels(place_.point(p), kUnit) / kUnit;
        const float needed = pixels > 0 ? least_ / (2 * pixels * scale_) : 0;
        return std::isfinite(needed) ? std::max(radius, needed) : radius;
    }

  private:
    DicingView view_;
    Mat4f place_;
    float scale_, least_;
};

}  // namespace lightsieve
