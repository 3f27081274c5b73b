// add: the sum of two closures, or of two colours.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Add {
    ShaderRef in1, in2;
    Color input1{0, 0, 0}, input2{0, 0, 0};

    static NodeType describe() {
        Describe<Add> d("add", NodeKind::Shader,
                        "The sum of two closures (MaterialX) or of two colours (Arnold).");
        d.lobe(0, EventKind::Object, EventLobe::None, "", "The sum of the colours, shown unlit.");
        d.param("in1", &Add::in1, "A closure.");
        d.param("in2", &Add::in2,
                "Another; whoever adds sees to it that no more light leaves than comes.");
        d.param("input1", &Add::input1, "A colour; acts where no closure is linked.");
        d.param("input2", &Add::input2, "Another colour.");
        return d.done();
    }

    [[nodiscard]] Color value(const ShadePoint&) const { return input1 + input2; }
    [[nodiscard]] static bool reads_coordinates() { return false; }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        if (!in1 && !in2) return out.emit(0, value(at));
        in1.closures(at, out);
        in2.closures(at, out);
    }
};

}  // namespace

NodeType node_add() { return Add::describe(); }

}  // namespace lightsieve
