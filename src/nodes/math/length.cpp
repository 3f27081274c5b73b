// length: how long a vector is.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class LengthMode : std::int32_t { Euclidian, Quadrance, Manhattan };

struct Length {
    Vec3f input;
    LengthMode mode = LengthMode::Euclidian;

    static NodeType describe() {
        Describe<Length> d("length", NodeKind::Shader, "Length of a vector.");
        d.param("input", &Length::input, "The vector.");
        d.param("mode", &Length::mode, "The length, its square, or the way along the axes.")
            .names({"euclidian", "quadrance", "manhattan"});
        return d.done();
    }
    [[nodiscard]] float eval(const ShadePoint&) const {
        switch (mode) {
            case LengthMode::Euclidian: return length(input);
            case LengthMode::Quadrance: return length_squared(input);
            case LengthMode::Manhattan: break;
        }
        return std::abs(input.x) + std::abs(input.y) + std::abs(input.z);
    }
};

}  // namespace

NodeType node_length() { return Length::describe(); }

}  // namespace lightsieve
