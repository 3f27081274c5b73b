// facing_ratio: how much a surface faces the viewer.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct FacingRatio {
    float bias = 0.5F, gain = 0.5F;
    bool linear = false, invert = false;

    static NodeType describe() {
        Describe<FacingRatio> d("facing_ratio", NodeKind::Shader,
                                "1 where a surface faces the viewer, 0 where it is seen edge-on.");
        d.param("bias", &FacingRatio::bias, "Value that 1/2 becomes.").range(0, 1);
        d.param("gain", &FacingRatio::gain,
                "Below 1/2 middle values are spread, above they are drawn together.")
            .range(0, 1);
        d.param("linear", &FacingRatio::linear, "By the angle rather than by its cosine.");
        d.param("invert", &FacingRatio::invert, "1 at the edges.");
        return d.done();
    }
    [[nodiscard]] float eval(const ShadePoint& at) const {
        float x = unit(std::abs(dot(at.normal, at.wo)));
        if (linear) x = 1 - std::acos(x) * (2 * kInvPi);
        x = perlin_gain(perlin_bias(x, bias), gain);
        return invert ? 1 - x : x;
    }
};

}  // namespace

NodeType node_facing_ratio() { return FacingRatio::describe(); }

}  // namespace lightsieve
