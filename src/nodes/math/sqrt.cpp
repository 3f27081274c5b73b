// sqrt: square root of each channel.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_sqrt() {
    return channel_node<[](float x) { return std::sqrt(positive(x)); }>(
        "sqrt", "Square root of each channel, 0 below 0.");
}

}  // namespace lightsieve
