// The forms that most mathematical nodes have, so that one of them is its formula and a line of documentation.
//
//     NodeType node_sqrt() {
//         return channel_node<[](float x) { return std::sqrt(positive(x)); }>("sqrt", "Square root of each channel.");
//     }
//
// Arnold's maths works on colours, channel by channel; links from and to other types convert. Each node keeps a file of its
// own, so that its name is enough to find it. What linked shaders give is finite (what is not arrives as 0); results need
// not be: whoever is linked gets 0 instead.
#pragma once

#include <cmath>
#include <string>

#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {

/// F of each channel of one colour.
template <auto F>
struct ChannelNode {
    Color input;
    [[nodiscard]] Color eval(const ShadePoint&) const {
        return {F(input.r), F(input.g), F(input.b)};
    }
};

template <auto F>
[[nodiscard]] NodeType channel_node(const char* name, std::string doc) {
    Describe<ChannelNode<F>> d(name, NodeKind::Shader, std::move(doc));
    d.param("input", &ChannelNode<F>::input, "What the node works on.");
    return d.done();
}

/// F of each channel of two colours. One is the default of both.
template <auto F, bool One>
struct TwoChannelNode {
    Color first = One ? kWhite : kBlack, second = One ? kWhite : kBlack;
    [[nodiscard]] Color eval(const ShadePoint&) const {
        return {F(first.r, second.r), F(first.g, second.g), F(first.b, second.b)};
    }
};

/// first, second  names of the parameters
template <auto F, bool One = false>
[[nodiscard]] NodeType two_channel_node(const char* name, std::string doc,
                                        const char* first = "input1",
                                        const char* second = "input2") {
    using Node = TwoChannelNode<F, One>;
    Describe<Node> d(name, NodeKind::Shader, std::move(doc));
    d.param(first, &Node::first, "The first colour.");
    d.param(second, &Node::second, "The second colour.");
    return d.done();
}

/// Radians or degrees, as Arnold numbers them.
enum class AngleUnits : std::int32_t { Radians, Degrees };
[[nodiscard]] inline std::vector<std::string> angle_unit_names() { return {"radians", "degrees"}; }

/// Curve through 0 and 1 that goes through (1/2, bias); values outside of 0 to 1 stay as they are.
/// Source: Perlin and Hoffert 1989, "Hypertexture", section 3.
[[nodiscard]] inline float perlin_bias(float x, float bias) {
    if (bias == 0.5F || !(x > 0) || x >= 1) return x;
    if (!(bias > 0)) return 0;
    return bias >= 1 ? 1 : std::pow(x, std::log(bias) / std::log(0.5F));
}
/// S curve through 0, 1/2 and 1, by two biases. Below 1/2 it is steeper in the middle. Source: the same.
[[nodiscard]] inline float perlin_gain(float x, float gain) {
    if (gain == 0.5F) return x;
    return x < 0.5F ? 0.5F * perlin_bias(2 * x, 1 - gain)
                    : 1 - 0.5F * perlin_bias(2 - 2 * x, 1 - gain);
}

/// A colour as hue, saturation and value; hue in [0,1). Source: Smith 1978, "Color Gamut Transform Pairs".
[[nodiscard]] inline Color hsv_from_rgb(Color c) {
    const float high = max_component(c), low = std::min(c.r, std::min(c.g, c.b)), d = high - low;
    if (!(d > 0)) return {0, 0, high};
    const float sector = high == c.r   ? (c.g - c.b) / d
                         : high == c.g ? 2 + (c.b - c.r) / d
                                       : 4 + (c.r - c.g) / d;
    const float hue = sector / 6;
    return {hue - std::floor(hue), high != 0 ? d / high : 0, high};
}
[[nodiscard]] inline Color rgb_from_hsv(Color c) {
    const float h = (c.r - std::floor(c.r)) * 6, s = c.g, v = c.b;
    const auto channel = [&](float n) {
        const float k = std::fmod(n + h, 6.0F);
        return v - v * s * std::clamp(std::min(k, 4 - k), 0.0F, 1.0F);
    };
    return {channel(5), channel(3), channel(1)};
}

/// A hash of 32 bits; for numbers that look random but are the same in every picture. Source: Wellons,
/// "Prospecting for Hash Functions", lowbias32.
[[nodiscard]] constexpr std::uint32_t mixed_bits(std::uint32_t h) {
    h = (h ^ (h >> 16U)) * 0x21f0aaadU;
    h = (h ^ (h >> 15U)) * 0x735a2d97U;
    return h ^ (h >> 15U);
}
[[nodiscard]] constexpr std::uint32_t mixed_bits(std::uint32_t h, std::uint32_t more) {
    return mixed_bits(mixed_bits(h) + more + 0x9e3779b9U);
}
/// In [0,1).
[[nodiscard]] constexpr float unit_from_bits(std::uint32_t h) {
    return static_cast<float>(h >> 8U) * 0x1p-24F;
}

}  // namespace lightsieve
