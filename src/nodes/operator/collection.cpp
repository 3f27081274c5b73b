// collection: a name for a selection, for operators that act later.
#include "nodes/operator/operator_common.h"

namespace lightsieve {
namespace {

struct CollectionOperator : SelectingOperator {
    Name collection;

    static NodeType describe() {
        Describe<CollectionOperator> d("collection", NodeKind::Operator,
                                       "Names a selection: operators that act later write #NAME.");
        describe_selecting_operator(d);
        d.param("collection", &CollectionOperator::collection, "The name, without #.");
        return d.done();
    }

    void edit_scene(OperatorContext& context) const {
        cook_inputs(context);
        if (enable && !collection.empty()) context.define_collection(collection);
    }
};

}  // namespace

NodeType node_collection() { return CollectionOperator::describe(); }

}  // namespace lightsieve
