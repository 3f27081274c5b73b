// rgb_to_float: one number from a colour.
#include "nodes/math/color_to_float.h"

namespace lightsieve {
namespace {

struct RgbToFloat {
    Color input;
    ColorToFloat mode = ColorToFloat::Average;

    static NodeType describe() {
        Describe<RgbToFloat> d("rgb_to_float", NodeKind::Shader, "One number from a colour.");
        d.param("input", &RgbToFloat::input, "The colour.");
        d.param("mode", &RgbToFloat::mode, "How the channels are taken together.")
            .names({"min", "max", "average", "sum", "luminance", "r", "g", "b"});
        return d.done();
    }
    [[nodiscard]] float eval(const ShadePoint&) const { return float_from(input, mode); }
};

}  // namespace

NodeType node_rgb_to_float() { return RgbToFloat::describe(); }

}  // namespace lightsieve
