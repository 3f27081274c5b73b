// triangle_filter: a tent along x times one along y.
#include "nodes/common/separable_filter.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct TriangleFilter {
    float width = 2;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType TriangleFilter::describe() {
    Describe<TriangleFilter> d("triangle_filter", NodeKind::Filter,
                               "Falls linearly to 0, along x and along y.");
    d.param("width", &TriangleFilter::width, "Width of the support.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

std::unique_ptr<PixelFilter> TriangleFilter::make_filter(NodeContext&) const {
    const double r = double{width} / 2;
    return std::make_unique<SeparableFilter>(width / 2, [r](double x) { return 1 - x / r; });
}

}  // namespace

NodeType node_triangle_filter() { return TriangleFilter::describe(); }

}  // namespace lightsieve
