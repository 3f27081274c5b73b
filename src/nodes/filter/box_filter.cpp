// box_filter: every place of a square counts alike.
#include "nodes/common/box_pixel_filter.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct BoxFilter {
    float width = 1;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext&) const {
        return std::make_unique<BoxPixelFilter>(width / 2);
    }
};

NodeType BoxFilter::describe() {
    Describe<BoxFilter> d("box_filter", NodeKind::Filter, "The mean over a square.");
    d.param("width", &BoxFilter::width, "Side of the square.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

}  // namespace

NodeType node_box_filter() { return BoxFilter::describe(); }

}  // namespace lightsieve
