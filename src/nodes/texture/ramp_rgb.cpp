// ramp_rgb: colours along a line, between keys.
#include <array>

#include "nodes/texture/ramp.h"

namespace lightsieve {
namespace {

constexpr std::array<Color, 2> kBlackToWhite{kBlack, kWhite};

struct RampRgb : RampCommon {
    Array<Color> color{kBlackToWhite.data(), 2, 1};

    static NodeType describe() {
        Describe<RampRgb> d("ramp_rgb", NodeKind::Shader, "Colours along a line, between keys.");
        describe_ramp(d);
        d.param("color", &RampRgb::color, "Values of the keys; left out: from black to white.");
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint& at) const {
        const std::uint32_t n = n_keys(color.n);
        Color out;
        if (n == 0) return out;
        const float t = place(at);
        for (int c = 0; c < 3; ++c) {
            const auto channel = [&](std::uint32_t key) { return color[key][c]; };
            out[c] = type == RampType::FourCorner ? corner_value(*this, n, at, channel)
                                                  : ramp_value(*this, n, t, channel);
        }
        return out;
    }
};

}  // namespace

NodeType node_ramp_rgb() { return RampRgb::describe(); }

}  // namespace lightsieve
