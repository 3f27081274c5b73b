// compare: whether two numbers stand in a relation.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class Test : std::int32_t { Equal, NotEqual, Greater, Less, GreaterOrEqual, LessOrEqual };

struct Compare {
    Test test = Test::Equal;
    float input1 = 0, input2 = 0;

    static NodeType describe() {
        Describe<Compare> d("compare", NodeKind::Shader,
                            "1 if two numbers stand in a relation, else 0.");
        d.param("test", &Compare::test, "The relation of input1 to input2.")
            .names({"==", "!=", ">", "<", ">=", "<="});
        d.param("input1", &Compare::input1, "The number on the left.");
        d.param("input2", &Compare::input2, "The number on the right.");
        return d.done();
    }
    [[nodiscard]] bool eval(const ShadePoint&) const {
        switch (test) {
            case Test::Equal: return input1 == input2;
            case Test::NotEqual: return input1 != input2;
            case Test::Greater: return input1 > input2;
            case Test::Less: return input1 < input2;
            case Test::GreaterOrEqual: return input1 >= input2;
            case Test::LessOrEqual: return input1 <= input2;
        }
        return false;
    }
};

}  // namespace

NodeType node_compare() { return Compare::describe(); }

}  // namespace lightsieve
