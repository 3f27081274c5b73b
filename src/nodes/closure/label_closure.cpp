// label_closure: gives the light of any shader a label.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct LabelClosure {
    ShaderRef closure;
    Name label;

    static NodeType describe() {
        Describe<LabelClosure> d(
            "label_closure", NodeKind::Shader,
            "A shader whose every lobe carries a label, for light path expressions.");
        d.param("closure", &LabelClosure::closure, "The shader.");
        d.param("label", &LabelClosure::label,
                "Takes the place of the lobes' own labels; empty: they keep them.");
        return d.done();
    }

    [[nodiscard]] static bool reads_coordinates() { return false; }
    // The compiler gives the label to the events of `closure`: here is nothing left to do.
    void eval(const ShadePoint& at, ClosureSet& out) const { closure.closures(at, out); }
};

}  // namespace

NodeType node_label_closure() { return LabelClosure::describe(); }

}  // namespace lightsieve
