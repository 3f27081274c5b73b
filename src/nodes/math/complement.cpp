// complement: 1 minus each channel.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_complement() {
    return channel_node<[](float x) { return 1 - x; }>("complement", "1 minus each channel.");
}

}  // namespace lightsieve
