// ramp_float: numbers along a line, between keys.
#include <array>

#include "nodes/texture/ramp.h"

namespace lightsieve {
namespace {

constexpr std::array<float, 2> kRise{0, 1};

struct RampFloat : RampCommon {
    Array<float> value{kRise.data(), 2, 1};

    static NodeType describe() {
        Describe<RampFloat> d("ramp_float", NodeKind::Shader,
                              "Numbers along a line, between keys.");
        describe_ramp(d);
        d.param("value", &RampFloat::value, "Values of the keys; left out: from 0 to 1.");
        return d.done();
    }
    [[nodiscard]] float eval(const ShadePoint& at) const {
        const std::uint32_t n = n_keys(value.n);
        if (n == 0) return 0;
        const auto key_value = [&](std::uint32_t key) { return value[key]; };
        return type == RampType::FourCorner ? corner_value(*this, n, at, key_value)
                                            : ramp_value(*this, n, place(at), key_value);
    }
};

}  // namespace

NodeType node_ramp_float() { return RampFloat::describe(); }

}  // namespace lightsieve
