// farthest_filter: the sample farthest from the camera, unmixed: what lies behind edges.
#include "nodes/common/box_pixel_filter.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct FarthestFilter {
    float width = 1;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext&) const {
        return std::make_unique<BoxPixelFilter>(width / 2, Reduction::Farthest);
    }
};

NodeType FarthestFilter::describe() {
    Describe<FarthestFilter> d("farthest_filter", NodeKind::Filter,
                               "The sample farthest from the camera instead of a mean.");
    d.param("width", &FarthestFilter::width, "Side of the square in which samples are considered.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

}  // namespace

NodeType node_farthest_filter() { return FarthestFilter::describe(); }

}  // namespace lightsieve
