// include_graph: lets the operators of another file act.
#include "nodes/operator/operator_common.h"

namespace lightsieve {
namespace {

struct IncludeGraph : OperatorNode {
    Name filename, target;

    static NodeType describe() {
        Describe<IncludeGraph> d("include_graph", NodeKind::Operator,
                                 "Lets the operators of another file act.");
        describe_operator(d);
        d.param("filename", &IncludeGraph::filename, "An .ass file with operators.");
        d.param("target", &IncludeGraph::target,
                "The last operator of the chain; none: those that no other one has as input.");
        return d.done();
    }

    void edit_scene(OperatorContext& context) const {
        cook_inputs(context);
        if (enable && !filename.empty()) context.cook_file(filename.view(), target);
    }
};

}  // namespace

NodeType node_include_graph() { return IncludeGraph::describe(); }

}  // namespace lightsieve
