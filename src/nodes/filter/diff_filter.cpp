// diff_filter: how far a pixel's samples lie apart.
#include "nodes/common/filter_weights.h"

namespace lightsieve {
namespace {

struct DiffFilter {
    float width = 2;
    FilterWeights filter_weights = FilterWeights::Gaussian;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType DiffFilter::describe() {
    Describe<DiffFilter> d("diff_filter", NodeKind::Filter,
                           "The greatest sample of a pixel less the smallest, a channel each.");
    d.param("width", &DiffFilter::width, "Width of the weights' support.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    d.param("filter_weights", &DiffFilter::filter_weights,
            "Samples to which it gives a weight are considered.")
        .names(filter_weight_names());
    return d.done();
}

std::unique_ptr<PixelFilter> DiffFilter::make_filter(NodeContext&) const {
    return std::make_unique<ReducingFilter>(make_weights(filter_weights, width), Reduction::Range);
}

}  // namespace

NodeType node_diff_filter() { return DiffFilter::describe(); }

}  // namespace lightsieve
