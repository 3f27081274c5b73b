// vector_to_rgb: a vector's coordinates as channels.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class ColorMode : std::int32_t { Raw, Normalized, Canonical };

struct VectorToRgb {
    Vec3f input;
    ColorMode mode = ColorMode::Raw;

    static NodeType describe() {
        Describe<VectorToRgb> d("vector_to_rgb", NodeKind::Shader,
                                "A vector's coordinates as colour channels.");
        d.param("input", &VectorToRgb::input, "The vector.");
        d.param("mode", &VectorToRgb::mode,
                "raw: as they are; canonical: -1..1 becomes 0..1; normalized: the same for the "
                "direction alone.")
            .names({"raw", "normalized", "canonical"});
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint&) const {
        if (mode == ColorMode::Raw) return {input.x, input.y, input.z};
        const Vec3f v = mode == ColorMode::Normalized ? normalize(input, {}) : input;
        return {0.5F + 0.5F * v.x, 0.5F + 0.5F * v.y, 0.5F + 0.5F * v.z};
    }
};

}  // namespace

NodeType node_vector_to_rgb() { return VectorToRgb::describe(); }

}  // namespace lightsieve
