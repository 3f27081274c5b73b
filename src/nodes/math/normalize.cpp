// normalize: a vector with length 1.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct Normalize {
    Vec3f input;

    static NodeType describe() {
        Describe<Normalize> d("normalize", NodeKind::Shader, "A vector brought to length 1.");
        d.param("input", &Normalize::input, "Any vector; 0 0 0 stays as it is.");
        return d.done();
    }
    [[nodiscard]] Vec3f eval(const ShadePoint&) const { return normalize(input, {}); }
};

}  // namespace

NodeType node_normalize() { return Normalize::describe(); }

}  // namespace lightsieve
