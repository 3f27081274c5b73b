// modulo: rest of a division.
#include "nodes/math/math_node.h"

namespace lightsieve {

NodeType node_modulo() {
    return two_channel_node<[](float a, float b) { return b != 0 ? std::fmod(a, b) : 0.0F; },
                            true>("modulo",
                                  "What is left of the first colour when it is divided by the "
                                  "second; it has the sign of the first.",
                                  "input", "divisor");
}

}  // namespace lightsieve
