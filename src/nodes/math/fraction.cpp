// fraction: fractional part of each channel.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_fraction() {
    return channel_node<[](float x) { return x - std::floor(x); }>(
        "fraction", "What each channel is above the next lower whole number.");
}

}  // namespace lightsieve
