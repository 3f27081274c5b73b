// Sample points as a pure function of (pixel, sample index, dimension, seed): Owen-scrambled Sobol, padded.
//
// Each pair of dimensions is a two-dimensional Sobol sequence, shuffled and scrambled by hashes of its own, so any
// number of dimensions keeps the quality of the first two, and a picture can be resumed at any sample.
// Source: Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4).
#pragma once

#include <array>
#include <cstdint>

#include "core/vec.h"

namespace lightsieve {

/// Mixes two words to one that looks random. Word: std::uint32_t, or a vector of them.
template <class Word>
[[nodiscard]] constexpr Word hash_combine(Word seed, Word v) {
    // Source: the 32-bit finaliser "lowbias32" of Wellons 2018, "Prospecting for Hash Functions".
    Word x = seed ^ (v + 0x9e3779b9U + (seed << 6U) + (seed >> 2U));
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    x ^= x >> 16U;
    return x;
}

/// A float in [0,1) from the top 24 bits.
[[nodiscard]] constexpr float unit_float(std::uint32_t x) {
    return static_cast<float>(x >> 8U) * 0x1p-24F;
}

/// The sample points of one (pixel, sample): cheap to make, no state but the counter of dimensions.
class Sampler {
  public:
    Sampler(std::uint32_t pixel_x, std::uint32_t pixel_y, std::uint32_t sample_index,
            std::uint32_t seed)
        : pixel_(hash_combine(hash_combine(hash_combine(0x68bc21ebU, seed), pixel_x), pixel_y)),
          index_(sample_index) {}

    /// The two-dimensional point of pair number `pair`; the same arguments always give the same point.
    [[nodiscard]] Vec2f at2(std::uint32_t pair) const;
    /// The points of four neighbouring pairs, `pair` to `pair + 3`: the same as of at2, for the price of about one.
    [[nodiscard]] std::array<Vec2f, 4> at2x4(std::uint32_t pair) const;

    /// The points of part `part` of `n` of this sample, where it splits: as well spread over all parts of all samples as
    /// samples are.
    ///
    /// family  parts of different families have nothing to do with each other
    [[nodiscard]] Sampler split(std::uint32_t family, std::uint32_t part, std::uint32_t n) const {
        Sampler out = *this;
        out.pixel_ = hash_combine(hash_combine(pixel_, 0x2545f491U + family), n);
        out.index_ = index_ * n + part;
        return out;
    }

    /// Independent uniform numbers for choices that need no stratification (merging terms), apart from the points.
    [[nodiscard]] float random(std::uint32_t stream) const {
        return unit_float(hash_combine(hash_combine(pixel_ ^ 0xa511e9b3U, index_), stream));
    }

  private:
    std::uint32_t pixel_;
    std::uint32_t index_;
};

}  // namespace lightsieve
