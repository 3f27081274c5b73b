// is_finite: whether a colour is made of numbers.
//
// What linked shaders give is made finite before it arrives here (0 stands for what is not), so that in a network the
// answer is always yes; scenes that choose between a value and 0 by it get the same picture.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct IsFinite {
    Color input;

    static NodeType describe() {
        Describe<IsFinite> d("is_finite", NodeKind::Shader,
                             "1 if no channel is infinite or not a number, else 0.");
        d.param("input", &IsFinite::input, "What is tested.");
        return d.done();
    }
    [[nodiscard]] bool eval(const ShadePoint&) const { return is_finite(input); }
};

}  // namespace

NodeType node_is_finite() { return IsFinite::describe(); }

}  // namespace lightsieve
