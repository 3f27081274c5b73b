// dot: inner product of two vectors.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct Dot {
    Vec3f input1, input2;

    static NodeType describe() {
        Describe<Dot> d("dot", NodeKind::Shader, "Inner product of two vectors.");
        d.param("input1", &Dot::input1, "The first vector.");
        d.param("input2", &Dot::input2, "The second vector.");
        return d.done();
    }
    [[nodiscard]] float eval(const ShadePoint&) const { return dot(input1, input2); }
};

}  // namespace

NodeType node_dot() { return Dot::describe(); }

}  // namespace lightsieve
