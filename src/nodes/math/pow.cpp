// pow: one colour to the power of another.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_pow() {
    return two_channel_node<[](float a, float b) { return std::pow(a, b); }, true>(
        "pow", "The first colour to the power of the second.", "base", "exponent");
}

}  // namespace lightsieve
