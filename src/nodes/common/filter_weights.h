// Filters as parameters of filters: variance_filter, diff_filter, heatmap_filter and cryptomatte_filter take their weights from
// one of these.
#pragma once

#include <memory>

#include "scene/describe.h"
#include "scene/pixel_filter.h"

namespace lightsieve {

/// In the order of `filter_weight_names`.
enum class FilterWeights : std::int32_t { BlackmanHarris, Box, Cone, Disk, Gaussian, Triangle };

[[nodiscard]] std::vector<std::string> filter_weight_names();

/// A filter of that kind. width: of the support [pixels]
[[nodiscard]] std::unique_ptr<PixelFilter> make_weights(FilterWeights kind, float width);

/// The weights of one filter with another use of them.
class WeighingFilter : public PixelFilter {
  public:
    explicit WeighingFilter(std::unique_ptr<PixelFilter> weights) : weights_(std::move(weights)) {}
    [[nodiscard]] float radius() const final { return weights_->radius(); }
    [[nodiscard]] float eval(Vec2f offset) const final { return weights_->eval(offset); }
    [[nodiscard]] Sample sample(Vec2f u) const final { return weights_->sample(u); }
    [[nodiscard]] float pdf(Vec2f offset) const final { return weights_->pdf(offset); }

  private:
    std::unique_ptr<PixelFilter> weights_;
};

/// The same for a reduction.
class ReducingFilter final : public WeighingFilter {
  public:
    ReducingFilter(std::unique_ptr<PixelFilter> weights, Reduction reduction)
        : WeighingFilter(std::move(weights)), reduction_(reduction) {}
    [[nodiscard]] Reduction reduction() const override { return reduction_; }

  private:
    Reduction reduction_;
};

}  // namespace lightsieve
