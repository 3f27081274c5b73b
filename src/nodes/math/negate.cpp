// negate: each channel with the other sign.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_negate() {
    return channel_node<[](float x) { return -x; }>("negate", "Each channel with the other sign.");
}

}  // namespace lightsieve
