// checkerboard: two colours in cells of the texture coordinates, averaged over the ray's footprint.
#include <cmath>

#include "nodes/texture/uv_set.h"

namespace lightsieve {
namespace {

struct Checkerboard {
    Color color1{1, 1, 1}, color2{0, 0, 0};
    float u_frequency = 1, v_frequency = 1, u_offset = 0, v_offset = 0;
    float contrast = 1, filter_strength = 1, filter_offset = 0;
    Name uvset;

    static NodeType describe();
    [[nodiscard]] Color eval(const ShadePoint& at) const;
};

NodeType Checkerboard::describe() {
    Describe<Checkerboard> d("checkerboard", NodeKind::Shader,
                             "Two colours in the cells of a checkerboard.");
    d.param("color1", &Checkerboard::color1, "Colour of the odd cells.");
    d.param("color2", &Checkerboard::color2,
            "Colour of the even cells, among them the one at the origin.");
    d.param("u_frequency", &Checkerboard::u_frequency, "Pairs of cells a unit of u.");
    d.param("v_frequency", &Checkerboard::v_frequency, "Pairs of cells a unit of v.");
    d.param("u_offset", &Checkerboard::u_offset, "Added to u.");
    d.param("v_offset", &Checkerboard::v_offset, "Added to v.");
    d.param("contrast", &Checkerboard::contrast, "0: both cells have the mean colour.")
        .range(0, 1);
    d.param("filter_strength", &Checkerboard::filter_strength,
            "Factor on the width over which cells are averaged.")
        .range(0, 1);
    d.param("filter_offset", &Checkerboard::filter_offset,
            "Added to that width, in units of the texture coordinates.")
        .range(0, 1);
    d.param("uvset", &Checkerboard::uvset, "Set of texture coordinates; empty: the first.");
    return d.done();
}

/// +1 in even cells, -1 in odd ones.
float parity(float x) { return std::fmod(std::abs(std::floor(x)), 2.0F) == 0 ? 1.0F : -1.0F; }

/// Mean of the parity over [x - w/2, x + w/2]. Its integral is a triangle wave of period 2.
float parity_mean(float x, float width) {
    // Below this the difference of the integrals would be rounding noise.
    constexpr float kSharp = 1e-3F;
    if (!(width > kSharp)) return parity(x);
    const auto integral = [](float t) {
        const float f = t - 2 * std::floor(t * 0.5F);
        return f < 1 ? f : 2 - f;
    };
    return (integral(x + width * 0.5F) - integral(x - width * 0.5F)) / width;
}

Color Checkerboard::eval(const ShadePoint& at) const {
    // c = floor(2 n u) + floor(2 m v): even is color2, odd is color1.
    const float nu = 2 * u_frequency, nv = 2 * v_frequency;
    const UvPoint at_uv = uv_of_set(at, uvset);
    const float width = std::fmax(at_uv.width * filter_strength + filter_offset, 0.0F);
    const float even = parity_mean(nu * (at_uv.uv.x + u_offset), std::abs(nu) * width) *
                       parity_mean(nv * (at_uv.uv.y + v_offset), std::abs(nv) * width);
    if (!std::isfinite(even)) return lerp(color1, color2, 0.5F);
    return lerp(color1, color2, 0.5F + 0.5F * contrast * even);
}

}  // namespace

NodeType node_checkerboard() { return Checkerboard::describe(); }

}  // namespace lightsieve
