// How far a layer's samples lie apart, pixel by pixel: for filters that are no means (variance_filter, diff_filter).
//
// A mean of light is made from sums of atoms; a spread needs every sample's value of the layer itself. It is only kept for
// layers that ask for it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/bytes.h"
#include "scene/pixel_filter.h"

namespace lightsieve {

class SampleSpread {
  public:
    /// A layer's channels in one sample.
    using Values = std::array<double, 4>;

    /// layer  index in AovPlan::layers
    SampleSpread(std::uint32_t layer, Reduction reduction)
        : layer_(layer), reduction_(reduction) {}
    [[nodiscard]] std::uint32_t layer() const { return layer_; }
    /// Forgets everything.
    void begin(std::size_t n_pixels) { pixels_.assign(n_pixels, {}); }
    /// Adds one sample. weight: of the filter; samples without any do not count
    void add(std::size_t pixel, const Values& values, double weight);
    /// Variance, unbiased if weights are equal, or range; 0 where there are too few samples.
    [[nodiscard]] Values spread(std::size_t pixel) const;

    [[nodiscard]] std::size_t memory() const { return pixels_.capacity() * sizeof(Pixel); }
    void save(ByteWriter& out) const { out.put(pixels_); }
    /// What `save` wrote, after `begin`. False if it does not fit.
    [[nodiscard]] bool load(ByteReader& in) { return in.get(pixels_, pixels_.size()); }

  private:
    struct Pixel {
        double weight = 0, squares = 0;  ///< sums of weights and of their squares
        Values mean{}, deviation{};      ///< of a variance: West's running sums
        Values least{}, greatest{};      ///< of a range
    };
    std::uint32_t layer_;
    Reduction reduction_;
    std::vector<Pixel> pixels_;
};

}  // namespace lightsieve
