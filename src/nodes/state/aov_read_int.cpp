// aov_read_int: reads a whole number that was written into an AOV.
#include <algorithm>
#include <cmath>

#include "nodes/state/aov_read.h"

namespace lightsieve {
namespace {

struct AovReadInt : AovRead {
    static NodeType describe() {
        Describe<AovReadInt> d("aov_read_int", NodeKind::Shader,
                               "Reads a whole number that was written into an AOV.");
        describe_aov_read(d);
        return d.done();
    }
    [[nodiscard]] std::int32_t eval(const ShadePoint& at) const {
        constexpr float kMost = 2147483520;  // the largest float that is an int
        const float value = std::round(read(at).rgb.r);
        return std::isfinite(value) ? static_cast<std::int32_t>(std::clamp(value, -kMost, kMost))
                                    : 0;
    }
};

}  // namespace

NodeType node_aov_read_int() { return AovReadInt::describe(); }

}  // namespace lightsieve
