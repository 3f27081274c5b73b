// random: a colour that looks random, the same for the same input. Arnold's own hash is private: another of even spread.
#include <bit>

#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class InputType : std::int32_t { Int, Float, Color };

struct Random {
    InputType input_type = InputType::Int;
    std::int32_t input_int = 0;
    float input_float = 0;
    Color input_color;
    std::int32_t seed = 0;
    bool grayscale = false;

    static NodeType describe();
    [[nodiscard]] Color eval(const ShadePoint&) const;
};

NodeType Random::describe() {
    Describe<Random> d("random", NodeKind::Shader,
                       "A random colour in 0..1, the same wherever the input is the same.");
    d.param("input_type", &Random::input_type, "Which input counts.")
        .names({"int", "float", "color"});
    d.param("input_int", &Random::input_int, "For input_type int.");
    d.param("input_float", &Random::input_float, "For input_type float.");
    d.param("input_color", &Random::input_color, "For input_type color.");
    d.param("seed", &Random::seed, "Another seed gives other colours.");
    d.param("grayscale", &Random::grayscale, "One number for all channels.");
    return d.done();
}

Color Random::eval(const ShadePoint&) const {
    // -0 and 0 are one number.
    const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v + 0.0F); };
    std::uint32_t h = mixed_bits(static_cast<std::uint32_t>(seed), 0);
    switch (input_type) {
        case InputType::Int: h = mixed_bits(h, static_cast<std::uint32_t>(input_int)); break;
        case InputType::Float: h = mixed_bits(h, bits(input_float)); break;
        case InputType::Color:
            for (int c = 0; c < 3; ++c)
                h = mixed_bits(h, bits(input_color[c]));
            break;
    }
    const auto channel = [&](std::uint32_t i) { return unit_from_bits(mixed_bits(h, i)); };
    return grayscale ? Color::grey(channel(0)) : Color{channel(0), channel(1), channel(2)};
}

}  // namespace

NodeType node_random() { return Random::describe(); }

}  // namespace lightsieve
