// min: smaller channels of two colours.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_min() {
    return two_channel_node<[](float a, float b) { return std::fmin(a, b); }>(
        "min", "The smaller of two colours, channel by channel.");
}

}  // namespace lightsieve
