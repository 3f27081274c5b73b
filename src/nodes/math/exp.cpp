// exp: exponential of each channel.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_exp() {
    return channel_node<[](float x) { return std::exp(x); }>("exp",
                                                             "e to the power of each channel.");
}

}  // namespace lightsieve
