// max: larger channels of two colours.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_max() {
    return two_channel_node<[](float a, float b) { return std::fmax(a, b); }>(
        "max", "The larger of two colours, channel by channel.");
}

}  // namespace lightsieve
