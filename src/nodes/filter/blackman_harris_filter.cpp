// blackman_harris_filter: the four-term Blackman-Harris window.
#include "nodes/common/blackman_harris.h"
#include "nodes/common/separable_filter.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct BlackmanHarrisFilter {
    float width = 3;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType BlackmanHarrisFilter::describe() {
    Describe<BlackmanHarrisFilter> d(
        "blackman_harris_filter", NodeKind::Filter,
        "Blackman-Harris window: smooth, close to a narrow Gaussian.");
    d.param("width", &BlackmanHarrisFilter::width, "Width of the support.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

std::unique_ptr<PixelFilter> BlackmanHarrisFilter::make_filter(NodeContext&) const {
    const double r = double{width} / 2;
    return std::make_unique<SeparableFilter>(width / 2,
                                             [r](double x) { return blackman_harris(x / r); });
}

}  // namespace

NodeType node_blackman_harris_filter() { return BlackmanHarrisFilter::describe(); }

}  // namespace lightsieve
