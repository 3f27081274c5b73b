// reciprocal: 1 over each channel.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_reciprocal() {
    return channel_node<[](float x) { return x != 0 ? 1 / x : 0.0F; }>(
        "reciprocal", "1 over each channel, 0 for 0.");
}

}  // namespace lightsieve
