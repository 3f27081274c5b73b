// How large things look to a camera, for choosing how finely a shape is cut.
//
// Only the size on the picture counts: what lies outside of it is cut as finely, so that its shadows and reflections fit.
#pragma once

#include "core/vec.h"
#include "scene/node_context.h"

namespace lightsieve {

class DicingView {
  public:
    /// camera  persp_camera, ortho_camera, or another, which is taken for one that sees all around; null: the same
    DicingView(const NodeInstance* camera, NodeContext::Frame frame);

    /// Length on the picture [pixels] of something of `length` scene units at `p`, seen from the side; world space.
    [[nodiscard]] float pixels(Vec3f p, float length) const;

  private:
    Vec3f eye_;
    bool parallel_ = false;
    float pixels_ = 1;  ///< per scene unit, at distance 1 if rays are not parallel
};

}  // namespace lightsieve
