// Motion keys on the shutter's clock.
//
// A node spreads its keys evenly over motion_start .. motion_end; the camera's shutter opens and closes on the same
// clock. Rays carry times in [0,1] within the shutter, so every key list is resampled to even steps over it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace lightsieve {

struct Shutter {
    float start = 0, end = 0;
    [[nodiscard]] bool instant() const { return !(end > start); }
};

/// A key list's own clock.
struct MotionRange {
    float start = 0, end = 1;
};

/// Keys resampled evenly over the shutter; one key if nothing moves. Outside of its range a list keeps its ends.
///
/// Exact where the range is the shutter's, and for up to two keys that cover it; otherwise kinks move to the nearest step.
/// blend(a, b, t) interpolates two keys.
template <class T, class Blend>
[[nodiscard]] std::vector<T> keys_over_shutter(std::span<const T> keys, MotionRange range,
                                               Shutter shutter, const Blend& blend) {
    const auto at = [&](float time) -> T {
        const float length = range.end - range.start;
        const float x = length > 0 ? (time - range.start) / length : 0;
        const float k = std::fmin(std::fmax(x, 0.0F), 1.0F) * static_cast<float>(keys.size() - 1);
        const std::size_t i = std::min(static_cast<std::size_t>(k), keys.size() - 2);
        return blend(keys[i], keys[i + 1], k - static_cast<float>(i));
    };
    if (keys.size() == 1) return {keys[0]};
    if (shutter.instant()) return {at(shutter.start)};
    if (range.start == shutter.start && range.end == shutter.end)
        return {keys.begin(), keys.end()};
    // As many steps as keys fall into the shutter, more where the motion begins or ends inside of it.
    constexpr std::size_t kMaxSteps = 128;
    const float per_key = (range.end - range.start) / static_cast<float>(keys.size() - 1);
    const float inside = per_key > 0 ? (shutter.end - shutter.start) / per_key : 1;
    const bool covered = range.start <= shutter.start && range.end >= shutter.end;
    const std::size_t steps = std::min(kMaxSteps, static_cast<std::size_t>(std::ceil(inside)) *
                                                      (covered && keys.size() == 2 ? 1 : 4));
    const std::size_t n = std::max<std::size_t>(1, steps);
    std::vector<T> out;
    for (std::size_t i = 0; i <= n; ++i)
        out.push_back(at(shutter.start + (shutter.end - shutter.start) * static_cast<float>(i) /
                                             static_cast<float>(n)));
    return out;
}

}  // namespace lightsieve
