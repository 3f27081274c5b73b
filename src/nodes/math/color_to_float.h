// What rgb_to_float and rgba_to_float share: the ways from a colour to one number.
#pragma once

#include "nodes/math/math_node.h"

namespace lightsieve {

enum class ColorToFloat : std::int32_t { Min, Max, Average, Sum, Luminance, R, G, B, A };

/// Luminance of a colour whose primaries are those of Rec. 709, which these nodes use whatever the rendering space is.
[[nodiscard]] constexpr float luminance_709(Color c) {
    return 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b;
}

/// The colour channels alone.
[[nodiscard]] inline float float_from(Color c, ColorToFloat mode) {
    switch (mode) {
        case ColorToFloat::Min: return std::fmin(c.r, std::fmin(c.g, c.b));
        case ColorToFloat::Max: return std::fmax(c.r, std::fmax(c.g, c.b));
        case ColorToFloat::Average: return average(c);
        case ColorToFloat::Sum: return c.r + c.g + c.b;
        case ColorToFloat::Luminance: return luminance_709(c);
        case ColorToFloat::R: return c.r;
        case ColorToFloat::G: return c.g;
        case ColorToFloat::B: return c.b;
        case ColorToFloat::A: break;
    }
    return 1;
}

}  // namespace lightsieve
