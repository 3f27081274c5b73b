// variance_filter: the variance of a pixel's samples, for denoisers and for finding noise.
//
// It looks at the samples that the other filters of the camera have placed, so it costs no rays.
#include "nodes/common/filter_weights.h"

namespace lightsieve {
namespace {

struct VarianceFilter {
    float width = 3;
    bool scalar_mode = false;
    FilterWeights filter_weights = FilterWeights::Gaussian;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType VarianceFilter::describe() {
    Describe<VarianceFilter> d("variance_filter", NodeKind::Filter,
                               "How much the samples of a pixel vary.");
    d.param("width", &VarianceFilter::width, "Width of the weights' support.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    d.param("filter_weights", &VarianceFilter::filter_weights, "The weights of samples.")
        .names(filter_weight_names());
    d.param("scalar_mode", &VarianceFilter::scalar_mode,
            "Of the luminance, the same number in all channels; else each channel by itself.");
    return d.done();
}

std::unique_ptr<PixelFilter> VarianceFilter::make_filter(NodeContext&) const {
    return std::make_unique<ReducingFilter>(
        make_weights(filter_weights, width),
        scalar_mode ? Reduction::LumaVariance : Reduction::Variance);
}

}  // namespace

NodeType node_variance_filter() { return VarianceFilter::describe(); }

}  // namespace lightsieve
