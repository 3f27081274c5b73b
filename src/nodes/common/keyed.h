// Parameters with motion keys, read at a shutter time.
//
// Keys are spread evenly over motion_start..motion_end of their node; the camera's shutter opens over
// shutter_start..shutter_end on the same clock. Renderer times are fractions of the shutter, so `Keyed` is made
// with both intervals and answers in shutter fractions. Between keys values change linearly; matrices element by
// element, as core/matrix.h says. Outside the keys the nearest one holds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "scene/value.h"

namespace lightsieve {

/// An interval on the clock of motion keys, in frames.
struct ClockInterval {
    float start = 0, end = 0;
};

inline Vec2f lerp(Vec2f a, Vec2f b, float t) { return a + (b - a) * t; }
inline Vec3f lerp(Vec3f a, Vec3f b, float t) { return a + (b - a) * t; }

/// One value a motion key.
template <class T>
class Keyed {
  public:
    Keyed() = default;
    /// keys     at least one
    /// motion   where the first and the last key lie; shutter: what times 0 and 1 mean
    Keyed(std::vector<T> keys, ClockInterval motion, ClockInterval shutter)
        : keys_(std::move(keys)) {
        const float span = motion.end - motion.start;
        const float n_segments = static_cast<float>(keys_.size() - 1);
        // Keys without an interval to lie in cannot move anything: the first one holds.
        if (!(std::abs(span) > 0)) return;
        offset_ = (shutter.start - motion.start) / span * n_segments;
        scale_ = (shutter.end - shutter.start) / span * n_segments;
    }

    /// The value at a shutter time in [0,1).
    [[nodiscard]] T at(float time) const {
        if (keys_.size() == 1) return keys_.front();
        const float last = static_cast<float>(keys_.size() - 1);
        const float x = std::clamp(offset_ + scale_ * time, 0.0F, last);
        const std::size_t i = std::min(static_cast<std::size_t>(x), keys_.size() - 2);
        return lerp(keys_[i], keys_[i + 1], x - static_cast<float>(i));
    }
    [[nodiscard]] const std::vector<T>& keys() const { return keys_; }
    [[nodiscard]] bool moves() const { return keys_.size() > 1; }

  private:
    std::vector<T> keys_{T{}};
    float offset_ = 0, scale_ = 0;  ///< shutter time to position among the keys
};

/// The keys of an array parameter that holds one value a key. Writers give the keys either as keys (`1 N TYPE`) or
/// as elements (`N 1 TYPE`); an empty array gives `fallback`.
template <class T>
[[nodiscard]] std::vector<T> key_values(const Array<T>& array, T fallback) {
    const std::size_t count = std::size_t{array.n} * array.n_keys;
    if (count == 0) return {fallback};
    return std::vector<T>(array.data, array.data + count);
}

}  // namespace lightsieve
