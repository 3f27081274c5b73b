// float_to_rgba: four numbers as a colour with alpha.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct FloatToRgba {
    float r = 0, g = 0, b = 0, a = 1;

    static NodeType describe() {
        Describe<FloatToRgba> d("float_to_rgba", NodeKind::Shader,
                                "Four numbers as a colour with alpha.");
        d.param("r", &FloatToRgba::r, "The red channel.");
        d.param("g", &FloatToRgba::g, "The green channel.");
        d.param("b", &FloatToRgba::b, "The blue channel.");
        d.param("a", &FloatToRgba::a, "The alpha channel.");
        return d.done();
    }
    [[nodiscard]] Rgba eval(const ShadePoint&) const { return {{r, g, b}, a}; }
};

}  // namespace

NodeType node_float_to_rgba() { return FloatToRgba::describe(); }

}  // namespace lightsieve
