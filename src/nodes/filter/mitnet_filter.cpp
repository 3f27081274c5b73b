// mitnet_filter: the spline that Mitchell and Netravali found to be the best compromise.
#include "nodes/common/separable_filter.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct MitnetFilter {
    float width = 4;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType MitnetFilter::describe() {
    Describe<MitnetFilter> d(
        "mitnet_filter", NodeKind::Filter,
        "Mitchell-Netravali spline: between sharp and smooth, with small negative lobes.");
    d.param("width", &MitnetFilter::width, "Width of the support.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

/// Source: Mitchell and Netravali 1988, eq. 8 with B = C = 1/3.
double mitchell_netravali(double t) {
    if (t < 1) return ((7 * t - 12) * t * t + 16.0 / 3) / 6;
    return (((-7.0 / 3 * t + 12) * t - 20) * t + 32.0 / 3) / 6;
}

std::unique_ptr<PixelFilter> MitnetFilter::make_filter(NodeContext&) const {
    const double scale = 4 / double{width};
    return std::make_unique<SeparableFilter>(
        width / 2, [scale](double x) { return mitchell_netravali(x * scale); });
}

}  // namespace

NodeType node_mitnet_filter() { return MitnetFilter::describe(); }

}  // namespace lightsieve
