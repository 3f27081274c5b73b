// float_to_rgb: three numbers as a colour.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct FloatToRgb {
    float r = 0, g = 0, b = 0;

    static NodeType describe() {
        Describe<FloatToRgb> d("float_to_rgb", NodeKind::Shader, "Three numbers as a colour.");
        d.param("r", &FloatToRgb::r, "The red channel.");
        d.param("g", &FloatToRgb::g, "The green channel.");
        d.param("b", &FloatToRgb::b, "The blue channel.");
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint&) const { return {r, g, b}; }
};

}  // namespace

NodeType node_float_to_rgb() { return FloatToRgb::describe(); }

}  // namespace lightsieve
