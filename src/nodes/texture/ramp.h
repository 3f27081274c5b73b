// What ramp_rgb and ramp_float share: where on the ramp a point lies, and what is there.
//
// Keys are not sorted in files. Sources: Arnold's parameter names; monotone cubics as in Fritsch and Carlson 1980, "Monotone
// Piecewise Cubic Interpolation".
#pragma once

#include <algorithm>
#include <cmath>

#include "nodes/shader/shader_common.h"
#include "nodes/texture/uv_set.h"
#include "scene/describe.h"

namespace lightsieve {

enum class RampType : std::int32_t {
    Custom,
    U,
    V,
    Diagonal,
    Radial,
    Circular,
    Box,
    UxV,
    FourCorner,
    Time
};
enum class ImplicitUvs : std::int32_t { Off, CurvesOnly, On };

/// Parameters but for the keys' values. Parameter structs derive from it.
struct RampCommon {
    RampType type = RampType::Custom;
    float input = 0;
    Array<float> position;
    Array<std::int32_t> interpolation;
    Name uvset;
    ImplicitUvs use_implicit_uvs = ImplicitUvs::CurvesOnly;
    bool wrap_uvs = false;

    [[nodiscard]] Vec2f uv(const ShadePoint& at) const {
        const bool implicit = use_implicit_uvs == ImplicitUvs::On ||
                              (use_implicit_uvs == ImplicitUvs::CurvesOnly && at.on_curve);
        const Vec2f uv = implicit && at.on_curve ? at.curve_uv : uv_of_set(at, uvset).uv;
        const auto wrapped = [](float x) { return x >= 0 && x <= 1 ? x : x - std::floor(x); };
        return wrap_uvs ? Vec2f{wrapped(uv.x), wrapped(uv.y)} : uv;
    }
    /// Where on the ramp a point lies.
    [[nodiscard]] float place(const ShadePoint& at) const {
        const Vec2f p = uv(at), c{p.x - 0.5F, p.y - 0.5F};
        switch (type) {
            case RampType::Custom: return input;
            case RampType::U: return p.x;
            case RampType::V: return p.y;
            case RampType::Diagonal: return 0.5F * (p.x + p.y);
            case RampType::Radial: return 0.5F + std::atan2(c.y, c.x) * (0.5F * kInvPi);
            case RampType::Circular: return std::sqrt(2 * (c.x * c.x + c.y * c.y));
            case RampType::Box: return 2 * std::max(std::abs(c.x), std::abs(c.y));
            case RampType::UxV: return p.x * p.y;
            case RampType::FourCorner: return 0;
            case RampType::Time: return at.time;
        }
        return 0;
    }
    /// Keys that have a position and a value.
    [[nodiscard]] std::uint32_t n_keys(std::uint32_t n_values) const {
        return position.empty() ? n_values : std::min(position.n, n_values);
    }
    [[nodiscard]] float position_of(std::uint32_t key, std::uint32_t n) const {
        if (!position.empty()) return position[key];
        return n > 1 ? static_cast<float>(key) / static_cast<float>(n - 1) : 0;
    }
};

template <class T>
void describe_ramp(Describe<T>& d) {
    d.param("type", &T::type, "What moves along the ramp: input, a direction of uv, or the time.")
        .names({"custom", "u", "v", "diagonal", "radial", "circular", "box", "uxv", "four_corner",
                "time"});
    d.param("input", &T::input, "Place on the ramp for type custom.");
    d.param("position", &T::position,
            "Places of the keys, in any order; none: evenly from 0 to 1.");
    d.param("interpolation", &T::interpolation,
            "From each key to the next: 0 constant, 1 linear, 2 Catmull-Rom, 3 monotone cubic.");
    d.param("uvset", &T::uvset, "Set of texture coordinates; empty: the first.");
    d.param("use_implicit_uvs", &T::use_implicit_uvs,
            "Whether curves use the place along and across the strand instead of their uv.")
        .names({"off", "curves_only", "on"});
    d.param("wrap_uvs", &T::wrap_uvs, "Repeats the ramp outside of 0 to 1.");
}

/// The four keys around a place, in the order of their positions; at the ends the outer ones repeat.
struct RampKeys {
    std::uint32_t before, first, second, after;
};

/// The key that follows `x` (or precedes it), none: `missing`. Keys of one place count in the order of the file.
template <class Ramp>
[[nodiscard]] RampKeys keys_around(const Ramp& ramp, std::uint32_t n, float t) {
    // By (position, index): a strict order even if positions repeat.
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
        const float pa = ramp.position_of(a, n), pb = ramp.position_of(b, n);
        return pa < pb || (pa == pb && a < b);
    };
    std::int64_t first = -1, second = -1;
    for (std::uint32_t i = 0; i < n; ++i) {
        if (ramp.position_of(i, n) <= t) {
            if (first < 0 || less(static_cast<std::uint32_t>(first), i)) first = i;
        } else if (second < 0 || less(i, static_cast<std::uint32_t>(second))) {
            second = i;
        }
    }
    if (first < 0) first = second;
    if (second < 0) second = first;
    const auto a = static_cast<std::uint32_t>(first), b = static_cast<std::uint32_t>(second);
    std::int64_t before = -1, after = -1;
    for (std::uint32_t i = 0; i < n; ++i) {
        if (less(i, a) && (before < 0 || less(static_cast<std::uint32_t>(before), i))) before = i;
        if (less(b, i) && (after < 0 || less(i, static_cast<std::uint32_t>(after)))) after = i;
    }
    return {before < 0 ? a : static_cast<std::uint32_t>(before), a, b,
            after < 0 ? b : static_cast<std::uint32_t>(after)};
}

/// Value of one channel at `t`. value(key) gives the keys' values; n > 0
template <class Value>
[[nodiscard]] float ramp_value(const RampCommon& ramp, std::uint32_t n, float t,
                               const Value& value) {
    const RampKeys k = keys_around(ramp, n, t);
    const float x1 = ramp.position_of(k.first, n), x2 = ramp.position_of(k.second, n);
    const float y1 = value(k.first), y2 = value(k.second);
    if (!(x2 > x1)) return y1;
    const float width = x2 - x1, s = std::clamp((t - x1) / width, 0.0F, 1.0F);
    const std::int32_t how = ramp.interpolation.empty()
                                 ? 1
                                 : ramp.interpolation[std::min(k.first, ramp.interpolation.n - 1)];
    if (how == 0) return y1;
    if (how != 2 && how != 3) return lerp(y1, y2, s);
    // Slopes at both ends, by the neighbours' differences; the outer keys repeat at the ends.
    const float x0 = ramp.position_of(k.before, n), x3 = ramp.position_of(k.after, n);
    const float d1 = (y2 - y1) / width;
    const float d0 = x1 > x0 ? (y1 - value(k.before)) / (x1 - x0) : d1,
                d2 = x3 > x2 ? (value(k.after) - y2) / (x3 - x2) : d1;
    float m1 = 0.5F * (d0 + d1), m2 = 0.5F * (d1 + d2);
    if (how == 3) {
        // No overshoot: flat where the direction turns, and never steeper than three times the chord.
        const auto limited = [&](float m, float a, float b) {
            if (a * b <= 0) return 0.0F;
            const float most = 3 * std::min(std::abs(a), std::abs(b));
            return std::clamp(m, -most, most);
        };
        m1 = limited(m1, d0, d1), m2 = limited(m2, d1, d2);
    }
    const float s2 = s * s, s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * y1 + (s3 - 2 * s2 + s) * width * m1 + (3 * s2 - 2 * s3) * y2 +
           (s3 - s2) * width * m2;
}

/// The same for four values at the corners of the uv square: lower left, lower right, upper left, upper right.
template <class Value>
[[nodiscard]] float corner_value(const RampCommon& ramp, std::uint32_t n, const ShadePoint& at,
                                 const Value& value) {
    const Vec2f p = ramp.uv(at);
    const auto corner = [&](std::uint32_t i) { return value(std::min(i, n - 1)); };
    const float x = unit(p.x), y = unit(p.y);
    return lerp(lerp(corner(0), corner(1), x), lerp(corner(2), corner(3), x), y);
}

}  // namespace lightsieve
