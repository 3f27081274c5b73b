#include "nodes/common/filter_weights.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "nodes/common/blackman_harris.h"
#include "nodes/common/box_pixel_filter.h"
#include "nodes/common/gaussian_pixel_filter.h"
#include "nodes/common/separable_filter.h"

namespace lightsieve {
namespace {

/// Round filters: all of a disc alike, or a cone over it.
class RoundFilter final : public PixelFilter {
  public:
    RoundFilter(float radius, bool is_cone) : radius_(radius), is_cone_(is_cone) {}
    [[nodiscard]] float radius() const override { return radius_; }
    [[nodiscard]] float eval(Vec2f offset) const override {
        const float t = std::hypot(offset.x, offset.y) / radius_;
        // A hair beyond the edge belongs to the support: sample() may round there.
        if (t > 1 + 1e-5F) return 0;
        return is_cone_ ? std::max(1 - t, 0.0F) : 1;
    }
    [[nodiscard]] Sample sample(Vec2f u) const override {
        const Vec2f disk = sample_concentric_disk(u);
        if (!is_cone_) return {disk * radius_, 1};
        const float r = std::hypot(disk.x, disk.y);
        if (!(r > 0)) return {{0, 0}, 1};
        // F(t) = 3 t^2 - 2 t^3, the integral of 6 t (1 - t), is inverted by the formula for smoothstep.
        const float share = std::min(r * r, 1.0F);
        const float t = 0.5F - std::sin(std::asin(1 - 2 * share) / 3);
        return {disk * (t * radius_ / r), 1};
    }
    [[nodiscard]] float pdf(Vec2f offset) const override {
        return eval(offset) * (is_cone_ ? 3 : 1) / (kPi * radius_ * radius_);
    }

  private:
    float radius_;
    bool is_cone_;
};

}  // namespace

std::vector<std::string> filter_weight_names() {
    return {"blackman_harris", "box", "cone", "disk", "gaussian", "triangle"};
}

std::unique_ptr<PixelFilter> make_weights(FilterWeights kind, float width) {
    const float r = width / 2;
    const auto separable = [&](auto profile) {
        return std::make_unique<SeparableFilter>(
            r, [r, profile](double x) { return profile(x / double{r}); });
    };
    switch (kind) {
        case FilterWeights::BlackmanHarris: return separable(&blackman_harris);
        case FilterWeights::Box: return std::make_unique<BoxPixelFilter>(r);
        case FilterWeights::Cone: return std::make_unique<RoundFilter>(r, true);
        case FilterWeights::Disk: return std::make_unique<RoundFilter>(r, false);
        case FilterWeights::Gaussian: return std::make_unique<GaussianPixelFilter>(r);
        case FilterWeights::Triangle: return separable([](double t) { return 1 - t; });
    }
    return std::make_unique<GaussianPixelFilter>(r);
}

}  // namespace lightsieve
