// subtract: difference of two colours.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_subtract() {
    return two_channel_node<[](float a, float b) { return a - b; }>(
        "subtract", "The first colour minus the second.");
}

}  // namespace lightsieve
