#include "render/adaptive.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lightsieve {
namespace {

/// Samples that a pixel takes in one go. A bucket of more fills evenly: when it is stopped it shows all of itself, with noise.
constexpr int kSamplesInOneGo = 64;
/// Darker pixels count as being this bright, or black ones would have to be without any noise.
constexpr double kDarkest = 1e-3;

}  // namespace

double block_noise(std::span<const PixelNoise> pixels) {
    double sum = 0;
    for (const PixelNoise& p : pixels)
        sum += p.variance / std::max(p.mean, kDarkest);
    return pixels.empty() ? 0 : std::sqrt(sum / static_cast<double>(pixels.size()));
}

SampleSchedule::SampleSchedule(int width, int height, int least, int most, double threshold)
    : width_(width),
      height_(height),
      least_(least),
      most_(std::max(least, most)),
      run_(static_cast<int>(std::bit_floor(static_cast<unsigned>(std::max(1, least / 2))))),
      threshold_(threshold),
      columns_(static_cast<std::size_t>((width + kAdaptiveBlock - 1) / kAdaptiveBlock)),
      goes_on_(columns_ * static_cast<std::size_t>((height + kAdaptiveBlock - 1) / kAdaptiveBlock),
               1) {
    target_ = next_target();
}

/// By halves again once noise decides, in whole pairs of runs so that the halves stay alike.
int SampleSchedule::next_target() const {
    if (done_ < least_) return std::min(least_, done_ + kSamplesInOneGo);
    const int pair = 2 * run_, wanted = done_ + std::max(1, done_ / 2);
    return std::min(
        {most_, (wanted + pair - 1) / pair * pair, done_ + std::max(kSamplesInOneGo, pair)});
}

bool SampleSchedule::finished() const {
    return done_ >= most_ ||
           std::ranges::all_of(goes_on_, [](std::uint8_t goes_on) { return goes_on == 0; });
}

void SampleSchedule::save(ByteWriter& out) const {
    out.put(done_);
    out.put(goes_on_);
}

bool SampleSchedule::load(ByteReader& in) {
    if (!in.get(done_) || !in.get(goes_on_, goes_on_.size()) || done_ < 0 || done_ > most_)
        return false;
    target_ = next_target();
    return true;
}

void SampleSchedule::next_round(std::span<const PixelNoise> noise) {
    const bool decide = decides();
    done_ = target_;
    n_stopped_ = 0;
    if (done_ >= most_) return;
    target_ = next_target();
    if (!decide) return;
    std::vector<PixelNoise> block;
    for (int y = 0; y < height_; y += kAdaptiveBlock)
        for (int x = 0; x < width_; x += kAdaptiveBlock) {
            std::uint8_t& goes_on = goes_on_[block_of(x, y)];
            if (goes_on == 0) continue;
            const int x1 = std::min(width_, x + kAdaptiveBlock),
                      y1 = std::min(height_, y + kAdaptiveBlock);
            block.clear();
            for (int v = y; v < y1; ++v)
                for (int u = x; u < x1; ++u)
                    block.push_back(noise[static_cast<std::size_t>(v * width_ + u)]);
            if (block_noise(block) < threshold_) {
                goes_on = 0;
                n_stopped_ += static_cast<int>(block.size());
            }
        }
}

}  // namespace lightsieve
