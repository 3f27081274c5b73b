// clamp: keeps channels within limits.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class ClampMode : std::int32_t { Scalar, Color };

struct Clamp {
    Color input;
    ClampMode mode = ClampMode::Scalar;
    float min = 0, max = 1;
    Color min_color{0, 0, 0}, max_color{1, 1, 1};

    static NodeType describe() {
        Describe<Clamp> d("clamp", NodeKind::Shader, "Keeps channels within limits.");
        d.param("input", &Clamp::input, "What is limited.");
        d.param("mode", &Clamp::mode, "One pair of limits for all channels, or two colours.")
            .names({"scalar", "color"});
        d.param("min", &Clamp::min, "Lower limit for mode scalar.");
        d.param("max", &Clamp::max, "Upper limit for mode scalar.");
        d.param("min_color", &Clamp::min_color, "Lower limits for mode color.");
        d.param("max_color", &Clamp::max_color, "Upper limits for mode color.");
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint&) const {
        const bool scalar = mode == ClampMode::Scalar;
        const Color low = scalar ? Color::grey(min) : min_color,
                    high = scalar ? Color::grey(max) : max_color;
        Color out;
        for (int c = 0; c < 3; ++c)
            out[c] = std::fmin(std::fmax(input[c], low[c]), high[c]);
        return out;
    }
};

}  // namespace

NodeType node_clamp() { return Clamp::describe(); }

}  // namespace lightsieve
