// trigo: trigonometric functions of each channel.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class Function : std::int32_t { Cos, Sin, Tan, Acos, Asin, Atan, Cosh, Sinh, Tanh };

struct Trigo {
    Color input;
    Function function = Function::Cos;
    AngleUnits units = AngleUnits::Radians;
    float frequency = 1, phase = 0;

    static NodeType describe();
    [[nodiscard]] Color eval(const ShadePoint&) const;

  private:
    [[nodiscard]] float of(float x) const;
};

NodeType Trigo::describe() {
    Describe<Trigo> d("trigo", NodeKind::Shader,
                      "A trigonometric function of input * frequency + phase.");
    d.param("input", &Trigo::input, "Argument, channel by channel.");
    d.param("function", &Trigo::function, "The function.")
        .names({"cos", "sin", "tan", "acos", "asin", "atan", "cosh", "sinh", "tanh"});
    d.param("units", &Trigo::units,
            "Of the argument of cos, sin and tan and of the result of their inverses.")
        .names(angle_unit_names());
    d.param("frequency", &Trigo::frequency, "Factor on the input.");
    d.param("phase", &Trigo::phase, "Added to the argument.");
    return d.done();
}

float Trigo::of(float x) const {
    const float degrees = units == AngleUnits::Degrees ? kPi / 180 : 1.0F;
    switch (function) {
        case Function::Cos: return std::cos(x * degrees);
        case Function::Sin: return std::sin(x * degrees);
        case Function::Tan: return std::tan(x * degrees);
        case Function::Acos: return std::acos(std::clamp(x, -1.0F, 1.0F)) / degrees;
        case Function::Asin: return std::asin(std::clamp(x, -1.0F, 1.0F)) / degrees;
        case Function::Atan: return std::atan(x) / degrees;
        case Function::Cosh: return std::cosh(x);
        case Function::Sinh: return std::sinh(x);
        case Function::Tanh: return std::tanh(x);
    }
    return 0;
}

Color Trigo::eval(const ShadePoint&) const {
    const auto channel = [&](float x) { return of(x * frequency + phase); };
    return {channel(input.r), channel(input.g), channel(input.b)};
}

}  // namespace

NodeType node_trigo() { return Trigo::describe(); }

}  // namespace lightsieve
