// What operators share: a switch, what acts before them, and mostly a selection.
//
// An operator derives from `OperatorNode` and defines edit_scene(OperatorContext&), which first lets its inputs act.
// scene/selection.h says how selections are written.
#pragma once

#include <string>
#include <vector>

#include "scene/describe.h"
#include "scene/operator_context.h"

namespace lightsieve {

struct OperatorNode {
    bool enable = true;
    Array<NodeRef> inputs;

  protected:
    void cook_inputs(OperatorContext& context) const {
        for (const NodeRef& input : inputs.first_key())
            context.cook(input);
    }
};

struct SelectingOperator : OperatorNode {
    Name selection;

  protected:
    /// The selected nodes, after the inputs have acted; a selection that meets nothing anywhere is reported.
    [[nodiscard]] std::vector<NodeInstance*> select(OperatorContext& context) const {
        std::vector<NodeInstance*> out = context.selected();
        context.met("", out.size(), {});
        return out;
    }
};

template <class T>
void describe_operator(Describe<T>& d) {
    d.param("enable", &OperatorNode::enable, "Off: only the inputs act.");
    d.param("inputs", &OperatorNode::inputs, "Operators that act before this one, in order.");
}

template <class T>
void describe_selecting_operator(Describe<T>& d) {
    describe_operator(d);
    d.param("selection", &SelectingOperator::selection,
            "Nodes that are edited: names with * and ?, .(@node=='polymesh'), .(param==1), "
            "#collection, "
            "joined by and, or, not.");
}

}  // namespace lightsieve
