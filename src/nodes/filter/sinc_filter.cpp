// sinc_filter: the ideal low-pass filter of one pixel, windowed. Arnold does not say which window it uses.
#include <cmath>

#include "nodes/common/separable_filter.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct SincFilter {
    float width = 6;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType SincFilter::describe() {
    Describe<SincFilter> d(
        "sinc_filter", NodeKind::Filter,
        "Sinc under a Lanczos window: sharp, with negative lobes that ring at edges.");
    d.param("width", &SincFilter::width, "Width of the support.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

double sinc(double x) {
    constexpr double kPiD = 3.14159265358979323846;
    // Below this sin(x)/x is 1 in double precision.
    return std::abs(x) < 1e-8 ? 1 : std::sin(kPiD * x) / (kPiD * x);
}

/// Source: Duchon 1979, "Lanczos filtering in one and two dimensions".
std::unique_ptr<PixelFilter> SincFilter::make_filter(NodeContext&) const {
    const double r = double{width} / 2;
    return std::make_unique<SeparableFilter>(width / 2,
                                             [r](double x) { return sinc(x) * sinc(x / r); });
}

}  // namespace

NodeType node_sinc_filter() { return SincFilter::describe(); }

}  // namespace lightsieve
