// gaussian_filter: a round Gaussian cut off at its radius, Arnold's usual filter.
#include "nodes/common/gaussian_pixel_filter.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct GaussianFilter {
    float width = 2;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType GaussianFilter::describe() {
    Describe<GaussianFilter> d("gaussian_filter", NodeKind::Filter,
                               "A Gaussian, cut off at its radius.");
    d.param("width", &GaussianFilter::width,
            "Diameter of the support; the Gaussian falls to exp(-2) at its edge.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

std::unique_ptr<PixelFilter> GaussianFilter::make_filter(NodeContext&) const {
    return std::make_unique<GaussianPixelFilter>(width / 2);
}

}  // namespace

NodeType node_gaussian_filter() { return GaussianFilter::describe(); }

}  // namespace lightsieve
