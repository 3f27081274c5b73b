// abs: magnitude of each channel.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_abs() {
    return channel_node<[](float x) { return std::abs(x); }>("abs",
                                                             "Each channel without its sign.");
}

}  // namespace lightsieve
