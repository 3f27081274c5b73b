#include "nodes/common/deep_merge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightsieve {
namespace {

/// Where less than this is left, what follows is added to the last sample: it could not be seen behind it.
constexpr float kNothingLeft = 1e-4F;

/// Which straight lines come near enough to a sum that grows in steps: the cone of the swing filter (Elmeleegy et al. 2009),
/// with both ends of every step inside.
class Cone {
  public:
    /// tolerance  below 0: any line does
    explicit Cone(float tolerance) : tolerance_(tolerance) {}
    /// Whether a line from 0 to what the sum is after a step so far away does; if so, lines must do from now on.
    bool admit(float distance, float step) {
        const float before = sum_;
        sum_ += step;
        if (tolerance_ < 0) return true;
        if (std::abs(step) > tolerance_) return false;
        if (!(distance > 0)) return std::abs(sum_) <= tolerance_;
        const float slope = sum_ / distance;
        if (slope < low_ || slope > high_) return false;
        low_ = std::max(low_, (std::max(before, sum_) - tolerance_) / distance);
        high_ = std::min(high_, (std::min(before, sum_) + tolerance_) / distance);
        return true;
    }

  private:
    float tolerance_;
    float sum_ = 0, low_ = -kInfinity, high_ = kInfinity;
};

class Merger {
  public:
    Merger(std::span<const float> depths, std::span<const Color> opacities,
           std::span<const float> values, std::size_t n_values, const DeepTolerance& tolerance)
        : depths_(depths),
          opacities_(opacities),
          values_(values),
          n_values_(n_values),
          tolerance_(tolerance),
          order_(depths.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::stable_sort(order_.begin(), order_.end(),
                         [&](std::size_t a, std::size_t b) { return depths[a] < depths[b]; });
    }

    DeepRun run() {
        for (std::size_t begin = 0; begin < order_.size();) {
            const std::size_t end = end_of_run(begin);
            emit(begin, end);
            begin = end;
        }
        return std::move(out_);
    }

  private:
    /// How many samples one may stand for.
    [[nodiscard]] std::size_t end_of_run(std::size_t begin) const {
        std::size_t end = begin + 1;
        const float first = depths_[order_[begin]];
        // Samples of one depth are one, whatever they bring.
        while (end < order_.size() && depths_[order_[end]] == first)
            ++end;
        if (!tolerance_.merge) return end;
        while (end < order_.size() && depths_[order_[end]] - first <= tolerance_.depth)
            ++end;
        Cone alpha(tolerance_.alpha);
        std::vector<Cone> others;
        for (std::size_t v = 0; v < n_values_; ++v)
            others.emplace_back(v < tolerance_.values.size() ? tolerance_.values[v] : -1.0F);
        std::size_t straight = begin;
        for (std::size_t i = begin; i < order_.size(); ++i) {
            const std::size_t sample = order_[i];
            const float distance = depths_[sample] - first;
            bool fits = alpha.admit(distance, average(opacities_[sample]));
            for (std::size_t v = 0; v < n_values_ && fits; ++v)
                fits = others[v].admit(distance, values_[sample * n_values_ + v]);
            if (!fits) break;
            straight = i + 1;
        }
        return std::max(end, straight);
    }

    void emit(std::size_t begin, std::size_t end) {
        float opacity = 0;
        std::vector<float> values(n_values_, 0.0F);
        for (std::size_t i = begin; i < end; ++i) {
            opacity += average(opacities_[order_[i]]);
            for (std::size_t v = 0; v < n_values_; ++v)
                values[v] += values_[order_[i] * n_values_ + v];
        }
        if (left_ < kNothingLeft && !out_.front.empty()) return add_to_last(values);
        out_.front.push_back(depths_[order_[begin]]);
        out_.back.push_back(depths_[order_[end - 1]]);
        out_.alpha.push_back(std::clamp(opacity / left_, 0.0F, 1.0F));
        for (const float v : values)
            out_.values.push_back(v / left_);
        before_last_ = left_;
        left_ *= 1 - out_.alpha.back();
    }

    void add_to_last(const std::vector<float>& values) {
        const std::size_t at = out_.values.size() - n_values_;
        for (std::size_t v = 0; v < n_values_; ++v)
            out_.values[at + v] += values[v] / before_last_;
    }

    std::span<const float> depths_;
    std::span<const Color> opacities_;
    std::span<const float> values_;
    std::size_t n_values_;
    const DeepTolerance& tolerance_;
    std::vector<std::size_t> order_;
    float left_ = 1;         ///< that samples so far let through
    float before_last_ = 1;  ///< the same before the last one
    DeepRun out_;
};

}  // namespace

DeepRun merge_deep(std::span<const float> depths, std::span<const Color> opacities,
                   std::span<const float> values, std::size_t n_values,
                   const DeepTolerance& tolerance) {
    return Merger(depths, opacities, values, n_values, tolerance).run();
}

}  // namespace lightsieve
