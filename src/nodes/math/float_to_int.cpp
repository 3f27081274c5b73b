// float_to_int: a whole number near a given one.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class Rounding : std::int32_t { Round, Truncate, Floor, Ceil };

struct FloatToInt {
    float input = 0;
    Rounding mode = Rounding::Round;

    static NodeType describe() {
        Describe<FloatToInt> d("float_to_int", NodeKind::Shader, "A whole number near the input.");
        d.param("input", &FloatToInt::input, "Any number.");
        d.param("mode", &FloatToInt::mode, "Which of its neighbours.")
            .names({"round", "truncate", "floor", "ceil"});
        return d.done();
    }
    [[nodiscard]] float eval(const ShadePoint&) const {
        switch (mode) {
            case Rounding::Round: return std::round(input);
            case Rounding::Truncate: return std::trunc(input);
            case Rounding::Floor: return std::floor(input);
            case Rounding::Ceil: break;
        }
        return std::ceil(input);
    }
};

}  // namespace

NodeType node_float_to_int() { return FloatToInt::describe(); }

}  // namespace lightsieve
