// closest_filter: the sample nearest to the camera, unmixed; for depth, positions, normals and numbers.
#include "nodes/common/box_pixel_filter.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct ClosestFilter {
    float width = 1;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext&) const {
        return std::make_unique<BoxPixelFilter>(width / 2, Reduction::Closest);
    }
};

NodeType ClosestFilter::describe() {
    Describe<ClosestFilter> d("closest_filter", NodeKind::Filter,
                              "The sample nearest to the camera instead of a mean.");
    d.param("width", &ClosestFilter::width, "Side of the square in which samples are considered.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    return d.done();
}

}  // namespace

NodeType node_closest_filter() { return ClosestFilter::describe(); }

}  // namespace lightsieve
