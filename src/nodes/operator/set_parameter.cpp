// set_parameter: gives parameters of the selected nodes other values.
#include "nodes/operator/operator_common.h"

namespace lightsieve {
namespace {

struct SetParameter : SelectingOperator {
    Array<Name> assignment;
    Array<bool> enable_assignment;

    static NodeType describe() {
        Describe<SetParameter> d("set_parameter", NodeKind::Operator,
                                 "Gives parameters of the selected nodes other values.");
        describe_selecting_operator(d);
        d.param("assignment", &SetParameter::assignment,
                "`PARAMETER=VALUE`, one a string: numbers, words, texts in quotes, links; "
                "`TYPE NAME=VALUE` declares user data.");
        d.param("enable_assignment", &SetParameter::enable_assignment,
                "Which of the assignments are made; none: all.");
        return d.done();
    }

    void edit_scene(OperatorContext& context) const {
        cook_inputs(context);
        if (!enable) return;
        const std::vector<NodeInstance*> nodes = select(context);
        for (std::uint32_t i = 0; i < assignment.n; ++i) {
            if (i < enable_assignment.n && !enable_assignment[i]) continue;
            if (assignment[i].empty()) continue;
            std::size_t n_met = 0;
            std::vector<std::string> known;
            for (NodeInstance* node : nodes) {
                if (context.assign(*node, assignment[i].view())) {
                    ++n_met;
                } else if (known.empty()) {
                    for (const ParamInfo& param : node->type().params)
                        known.push_back(param.name.str());
                }
            }
            context.met(assignment[i].view(), n_met, known);
        }
    }
};

}  // namespace

NodeType node_set_parameter() { return SetParameter::describe(); }

}  // namespace lightsieve
