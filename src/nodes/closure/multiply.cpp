// multiply: a closure, tinted.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Multiply {
    ShaderRef in1;
    Color in2{1, 1, 1};

    static NodeType describe() {
        Describe<Multiply> d("multiply", NodeKind::Shader, "A closure with a factor.");
        d.param("in1", &Multiply::in1, "The closure.");
        d.param("in2", &Multiply::in2, "Factor on all that it does.").range(0, 1);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        add_scaled(in1, positive(in2), at, out);
    }
};

}  // namespace

NodeType node_multiply() { return Multiply::describe(); }

}  // namespace lightsieve
