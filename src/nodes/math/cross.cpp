// cross: vector product.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct Cross {
    Vec3f input1, input2;

    static NodeType describe() {
        Describe<Cross> d("cross", NodeKind::Shader, "Vector product of two vectors.");
        d.param("input1", &Cross::input1, "The first vector.");
        d.param("input2", &Cross::input2, "The second vector.");
        return d.done();
    }
    [[nodiscard]] Vec3f eval(const ShadePoint&) const { return cross(input1, input2); }
};

}  // namespace

NodeType node_cross() { return Cross::describe(); }

}  // namespace lightsieve
