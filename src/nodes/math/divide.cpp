// divide: quotient of two colours.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_divide() {
    return two_channel_node<[](float a, float b) { return b != 0 ? a / b : 0.0F; }, true>(
        "divide", "The first colour over the second, 0 where that is 0.");
}

}  // namespace lightsieve
