// multiply: a closure, tinted, or the product of two colours.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Multiply {
    ShaderRef in1;
    Color in2{1, 1, 1};
    Color input1{1, 1, 1}, input2{1, 1, 1};

    static NodeType describe() {
        Describe<Multiply> d("multiply", NodeKind::Shader,
                             "A closure with a factor (MaterialX) or the product of two colours "
                             "(Arnold).");
        d.lobe(0, EventKind::Object, EventLobe::None, "", "The product, shown unlit.");
        d.param("in1", &Multiply::in1, "The closure.");
        d.param("in2", &Multiply::in2, "Factor on all that it does.").range(0, 1);
        d.param("input1", &Multiply::input1, "A colour; acts where no closure is linked.");
        d.param("input2", &Multiply::input2, "Another colour.");
        return d.done();
    }

    [[nodiscard]] Color value(const ShadePoint&) const { return input1 * input2; }
    [[nodiscard]] static bool reads_coordinates() { return false; }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        if (!in1) return out.emit(0, value(at));
        add_scaled(in1, positive(in2), at, out);
    }
};

}  // namespace

NodeType node_multiply() { return Multiply::describe(); }

}  // namespace lightsieve
