// switch_operator: lets one of its inputs act.
#include <fmt/format.h>

#include "nodes/operator/operator_common.h"

namespace lightsieve {
namespace {

struct SwitchOperator : OperatorNode {
    std::int32_t index = 0;

    static NodeType describe() {
        Describe<SwitchOperator> d("switch_operator", NodeKind::Operator,
                                   "Lets one of its inputs act.");
        describe_operator(d);
        d.param("index", &SwitchOperator::index,
                "Number of the input that acts, counted from 0; below 0: none.");
        return d.done();
    }

    void edit_scene(OperatorContext& context) const {
        if (!enable || index < 0) return;
        const auto i = static_cast<std::uint32_t>(index);
        if (i < inputs.n) return context.cook(inputs[i]);
        context.diagnostics().warning(
            Code::OperatorUnused,
            fmt::format("input {} of {} is to act: none does", index, inputs.n),
            context.where("index"), "inputs are counted from 0");
    }
};

}  // namespace

NodeType node_switch_operator() { return SwitchOperator::describe(); }

}  // namespace lightsieve
