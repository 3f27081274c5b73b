// Sums of mattes in one bucket, and what files say of them.
//
// Ids cannot be averaged: every pixel keeps the weight that each id got. The layers are made when the bucket is done:
// ids by weight, the greatest first. A sample's surfaces share its weight by opacity, what is left is nothing (id 0).
// Order of samples and of ids is fixed, so the sums do not depend on threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/bytes.h"
#include "core/diagnostics.h"
#include "core/vec.h"
#include "scene/driver.h"

namespace lightsieve {

struct AovPlan;
struct PlannedDriver;

/// A surface that a camera sample sees, for one matte.
struct MatteHit {
    std::uint32_t matte = 0;  ///< by number (AovPlan::mattes)
    std::uint32_t id = 0;     ///< bits of a float
    float weight = 0;         ///< of the sample: what opacity leaves of it
};

/// One matte in all pixels of a bucket.
class MatteSums {
  public:
    explicit MatteSums(std::uint32_t matte) : matte_(matte) {}
    [[nodiscard]] std::uint32_t matte() const { return matte_; }
    /// Forgets everything.
    void begin(std::size_t n_pixels);
    void clear(std::size_t pixel) { pixels_[pixel].clear(); }
    /// Adds one sample.
    ///
    /// hits    of all mattes
    /// weight  of the pixel filter
    void add(std::size_t pixel, std::span<const MatteHit> hits, double weight);

    /// An id and how much of the pixel it covers.
    struct Covered {
        std::uint32_t id = 0;  ///< bits of a float; 0 is nothing
        float coverage = 0;
    };
    /// The ids at two ranks, each {0, 0} where there are fewer.
    ///
    /// norm  what weights are multiplied by
    [[nodiscard]] std::array<Covered, 2> ranks(std::size_t pixel, std::size_t first,
                                               double norm) const;
    /// [bytes]
    [[nodiscard]] std::size_t memory() const {
        std::size_t sum = pixels_.capacity() * sizeof(pixels_[0]);
        for (const auto& pixel : pixels_)
            sum += pixel.capacity() * sizeof(Entry);
        return sum;
    }
    void save(ByteWriter& out) const;
    /// What `save` wrote, after `begin`. False if it does not fit.
    [[nodiscard]] bool load(ByteReader& in);
    /// A colour for every id, by coverage: for people, not for masks.
    [[nodiscard]] Color preview(std::size_t pixel, double norm) const;

  private:
    struct Entry {
        std::uint32_t id = 0;
        double weight = 0;
    };
    void add_id(std::vector<Entry>& entries, std::uint32_t id, double weight) const;

    std::uint32_t matte_;
    std::vector<std::vector<Entry>> pixels_;  ///< by id
};

/// Puts into a file's header which of its layers are mattes, and their names.
void describe_mattes(const AovPlan& plan, const PlannedDriver& driver, ImageHeader& header);

/// Writes the manifests that are to stand beside the driver's file. False with a report if the disk refuses.
[[nodiscard]] bool write_sidecars(const AovPlan& plan, const PlannedDriver& driver,
                                  Diagnostics& diagnostics);

}  // namespace lightsieve
