// add: two closures, both whole.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Add {
    ShaderRef in1, in2;

    static NodeType describe() {
        Describe<Add> d("add", NodeKind::Shader,
                        "The sum of two closures; whoever adds sees to it that no more light "
                        "leaves than comes.");
        d.param("in1", &Add::in1, "A closure.");
        d.param("in2", &Add::in2, "Another closure.");
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        in1.closures(at, out);
        in2.closures(at, out);
    }
};

}  // namespace

NodeType node_add() { return Add::describe(); }

}  // namespace lightsieve
