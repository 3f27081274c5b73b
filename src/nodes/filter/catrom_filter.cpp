// catrom_filter: the Catmull-Rom spline, which passes through the samples that it interpolates.
#include "nodes/common/separable_filter.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct CatromFilter {
    float width = 4;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType CatromFilter::describe() {
    Describe<CatromFilter> d("catrom_filter", NodeKind::Filter,
                             "Catmull-Rom spline: sharpens, with negative lobes.");
    d.param("width", &CatromFilter::width, "Width of the support.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

/// Source: Mitchell and Netravali 1988, eq. 8 with B = 0, C = 1/2.
double catmull_rom(double t) {
    return t < 1 ? (1.5 * t - 2.5) * t * t + 1 : ((-0.5 * t + 2.5) * t - 4) * t + 2;
}

std::unique_ptr<PixelFilter> CatromFilter::make_filter(NodeContext&) const {
    const double scale = 4 / double{width};
    return std::make_unique<SeparableFilter>(width / 2,
                                             [scale](double x) { return catmull_rom(x * scale); });
}

}  // namespace

NodeType node_catrom_filter() { return CatromFilter::describe(); }

}  // namespace lightsieve
