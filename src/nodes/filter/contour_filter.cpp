// contour_filter: the filter of Arnold's toon shader, whose outlines are not drawn here.
#include "nodes/common/gaussian_pixel_filter.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct ContourFilter {
    float width = 2;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType ContourFilter::describe() {
    Describe<ContourFilter> d("contour_filter", NodeKind::Filter,
                              "Draws outlines around toon shaders in Arnold; here a Gaussian.");
    d.param("width", &ContourFilter::width, "Diameter of the Gaussian.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

std::unique_ptr<PixelFilter> ContourFilter::make_filter(NodeContext& context) const {
    context.diagnostics().warning(Code::ParamPending, "contour_filter draws no outlines yet",
                                  context.where("width"),
                                  "the layer is filtered as gaussian_filter does");
    return std::make_unique<GaussianPixelFilter>(width / 2);
}

}  // namespace

NodeType node_contour_filter() { return ContourFilter::describe(); }

}  // namespace lightsieve
