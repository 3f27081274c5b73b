// sign: sign of each channel.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_sign() {
    return channel_node<[](float x) { return static_cast<float>((x > 0) - (x < 0)); }>(
        "sign", "-1, 0 or 1: the sign of each channel.");
}

}  // namespace lightsieve
