// rgba_to_float: one number from a colour with alpha.
#include "nodes/math/color_to_float.h"

namespace lightsieve {
namespace {

struct RgbaToFloat {
    Rgba input{{0, 0, 0}, 1};
    ColorToFloat mode = ColorToFloat::Average;

    static NodeType describe();
    [[nodiscard]] float eval(const ShadePoint&) const;
};

NodeType RgbaToFloat::describe() {
    Describe<RgbaToFloat> d("rgba_to_float", NodeKind::Shader,
                            "One number from a colour with alpha.");
    d.param("input", &RgbaToFloat::input, "The colour.");
    d.param("mode", &RgbaToFloat::mode,
            "How the channels are taken together, alpha among them; luminance times alpha.")
        .names({"min", "max", "average", "sum", "luminance", "r", "g", "b", "a"});
    return d.done();
}

float RgbaToFloat::eval(const ShadePoint&) const {
    const float colour = float_from(input.rgb, mode);
    switch (mode) {
        case ColorToFloat::Min: return std::fmin(colour, input.a);
        case ColorToFloat::Max: return std::fmax(colour, input.a);
        case ColorToFloat::Average: return (colour * 3 + input.a) * 0.25F;
        case ColorToFloat::Sum: return colour + input.a;
        case ColorToFloat::Luminance: return colour * input.a;
        case ColorToFloat::A: return input.a;
        default: return colour;
    }
}

}  // namespace

NodeType node_rgba_to_float() { return RgbaToFloat::describe(); }

}  // namespace lightsieve
