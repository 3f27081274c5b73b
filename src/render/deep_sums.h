// Deep pixels of one bucket: what every surface along each camera sample brings, for drivers of deep files.
//
// Nothing is merged here, for how much may be lost by that is for the driver to say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/bytes.h"
#include "core/vec.h"
#include "scene/driver.h"

namespace lightsieve {

class DeepSums {
  public:
    /// driver    index in AovPlan::drivers
    /// n_values  channels of its layers but alpha
    DeepSums(std::uint32_t driver, std::size_t n_values) : driver_(driver), n_values_(n_values) {}
    [[nodiscard]] std::uint32_t driver() const { return driver_; }
    [[nodiscard]] std::size_t n_values() const { return n_values_; }
    /// Forgets everything.
    void begin(std::size_t n_pixels);
    /// Adds a place of a camera sample; nothing if it brings and hides nothing.
    void add(std::size_t pixel, float depth, Color opacity, std::span<const double> values,
             double weight);
    /// norms  for each pixel: what its weights are multiplied by
    [[nodiscard]] DeepBucket resolve(std::span<const double> norms) const;

    /// [bytes]
    [[nodiscard]] std::size_t memory() const;
    void save(ByteWriter& out) const;
    /// What `save` wrote, after `begin`. False if it does not fit.
    [[nodiscard]] bool load(ByteReader& in);

  private:
    struct Pixel {
        std::vector<float> depths;
        std::vector<Color> opacities;
        std::vector<float> values;
    };
    std::uint32_t driver_;
    std::size_t n_values_;
    std::vector<Pixel> pixels_;
};

}  // namespace lightsieve
