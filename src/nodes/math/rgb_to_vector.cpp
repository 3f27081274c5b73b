// rgb_to_vector: a colour's channels as coordinates.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class VectorMode : std::int32_t { Raw, Canonical };

struct RgbToVector {
    Color input;
    VectorMode mode = VectorMode::Raw;

    static NodeType describe() {
        Describe<RgbToVector> d("rgb_to_vector", NodeKind::Shader,
                                "A colour's channels as coordinates.");
        d.param("input", &RgbToVector::input, "The colour.");
        d.param("mode", &RgbToVector::mode, "raw: as they are; canonical: 0..1 becomes -1..1.")
            .names({"raw", "canonical"});
        return d.done();
    }
    [[nodiscard]] Vec3f eval(const ShadePoint&) const {
        const Vec3f v{input.r, input.g, input.b};
        return mode == VectorMode::Raw ? v : v * 2 - Vec3f{1, 1, 1};
    }
};

}  // namespace

NodeType node_rgb_to_vector() { return RgbToVector::describe(); }

}  // namespace lightsieve
