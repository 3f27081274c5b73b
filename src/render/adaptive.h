// Which pixels get more samples: those of blocks whose picture is still noisy.
//
// A block of pixels goes on until the noise that halves of its samples show is below a threshold, or until it has the most
// samples. All pixels of a block have the same number, so one pixel that was lucky does not stop early by itself, which would
// darken what is rare and bright. Decisions look at the block alone: tiles and threads change nothing.
// Source: Dammertz, Hanika, Keller and Lensch 2010, "A Hierarchical Automatic Stopping Condition for Monte Carlo Global
// Illumination".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/film.h"

namespace lightsieve {

/// Side of a block [pixels]. Buckets are whole blocks, but for the right and lower edge of the picture.
inline constexpr int kAdaptiveBlock = 8;

/// Noise of a block: root of the mean of variance over brightness. Of two pixels with the same standard error the darker one
/// counts more, as for the eye.
///
/// Returns infinity if a pixel has too few samples to tell.
[[nodiscard]] double block_noise(std::span<const PixelNoise> pixels);

/// How many samples the pixels of a bucket have and get next.
class SampleSchedule {
  public:
    /// least, most  samples a pixel; least > 0
    /// threshold    for block_noise; only used where most > least
    SampleSchedule(int width, int height, int least, int most, double threshold);

    /// Whether a sample is one of the half that tells noise. Halves are made of runs of samples that are well spread by
    /// themselves: neighbours in a Sobol sequence are not.
    [[nodiscard]] bool in_half(int index) const { return (index / run_) % 2 == 0; }

    /// Samples that pixels of blocks that go on have so far, and shall have after the next round.
    [[nodiscard]] int done() const { return done_; }
    [[nodiscard]] int target() const { return target_; }
    /// Whether the block with this pixel goes on.
    [[nodiscard]] bool goes_on(int x, int y) const { return goes_on_[block_of(x, y)] != 0; }
    /// The round is over: chooses the next one.
    ///
    /// noise  of all pixels of the bucket, row by row; not looked at before the least samples are taken
    void next_round(std::span<const PixelNoise> noise);
    /// Whether next_round will look at the noise.
    [[nodiscard]] bool decides() const { return target_ >= least_ && target_ < most_; }
    /// No block goes on.
    [[nodiscard]] bool finished() const;
    /// Where it is, to go on later.
    void save(ByteWriter& out) const;
    /// What `save` wrote for a bucket of the same size, with as many samples as here or fewer. False if it does not fit.
    [[nodiscard]] bool load(ByteReader& in);
    /// Pixels that stopped at the end of the last round.
    [[nodiscard]] int n_stopped() const { return n_stopped_; }

  private:
    [[nodiscard]] std::size_t block_of(int x, int y) const {
        return static_cast<std::size_t>(y / kAdaptiveBlock) * columns_ +
               static_cast<std::size_t>(x / kAdaptiveBlock);
    }
    [[nodiscard]] int next_target() const;

    int width_, height_, least_, most_, run_;
    double threshold_;
    std::size_t columns_;
    int done_ = 0, target_ = 0, n_stopped_ = 0;
    std::vector<std::uint8_t> goes_on_;  ///< by block
};

}  // namespace lightsieve
