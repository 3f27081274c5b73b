// merge: joins chains of operators; they act one after the other.
#include "nodes/operator/operator_common.h"

namespace lightsieve {
namespace {

struct Merge : OperatorNode {
    static NodeType describe() {
        Describe<Merge> d("merge", NodeKind::Operator,
                          "Joins chains of operators, which act one after the other.");
        describe_operator(d);
        return d.done();
    }
    void edit_scene(OperatorContext& context) const { cook_inputs(context); }
};

}  // namespace

NodeType node_merge() { return Merge::describe(); }

}  // namespace lightsieve
