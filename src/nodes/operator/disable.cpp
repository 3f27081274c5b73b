// disable: takes the selected nodes out of the scene.
#include "nodes/operator/operator_common.h"

namespace lightsieve {
namespace {

struct Disable : SelectingOperator {
    static NodeType describe() {
        Describe<Disable> d("disable", NodeKind::Operator,
                            "Takes the selected nodes out of the scene, with all that refers to "
                            "them.");
        describe_selecting_operator(d);
        return d.done();
    }

    void edit_scene(OperatorContext& context) const {
        cook_inputs(context);
        if (enable) context.disable(select(context));
    }
};

}  // namespace

NodeType node_disable() { return Disable::describe(); }

}  // namespace lightsieve
