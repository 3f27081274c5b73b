// heatmap_filter: numbers for people: blue is little, red is much.
#include <algorithm>

#include "nodes/common/filter_weights.h"

namespace lightsieve {
namespace {

struct HeatmapFilter {
    float width = 2, minimum = 0, maximum = 1;
    FilterWeights filter_weights = FilterWeights::Gaussian;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext& context) const;
};

NodeType HeatmapFilter::describe() {
    Describe<HeatmapFilter> d("heatmap_filter", NodeKind::Filter,
                              "Numbers as colours from blue to red.");
    d.param("width", &HeatmapFilter::width, "Width of the weights' support.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    d.param("minimum", &HeatmapFilter::minimum, "The number that is blue.");
    d.param("maximum", &HeatmapFilter::maximum, "The number that is red.");
    d.param("filter_weights", &HeatmapFilter::filter_weights, "The weights of samples.")
        .names(filter_weight_names());
    return d.done();
}

/// Blue, cyan, green, yellow, red in equal steps.
class Heatmap final : public WeighingFilter {
  public:
    Heatmap(std::unique_ptr<PixelFilter> weights, float low, float high)
        : WeighingFilter(std::move(weights)), low_(low), high_(high) {}
    [[nodiscard]] bool shows_heat() const override { return true; }
    [[nodiscard]] Color heat(float value) const override {
        const float range = high_ - low_;
        const float t = range != 0 ? (value - low_) / range : value > low_ ? 1.0F : 0.0F;
        const float x = 4 * std::clamp(t, 0.0F, 1.0F);
        const auto unit = [](float v) { return std::clamp(v, 0.0F, 1.0F); };
        return {unit(x - 2), unit(std::min(x, 4 - x)), unit(2 - x)};
    }

  private:
    float low_, high_;
};

std::unique_ptr<PixelFilter> HeatmapFilter::make_filter(NodeContext&) const {
    return std::make_unique<Heatmap>(make_weights(filter_weights, width), minimum, maximum);
}

}  // namespace

NodeType node_heatmap_filter() { return HeatmapFilter::describe(); }

}  // namespace lightsieve
