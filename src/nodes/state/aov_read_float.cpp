// aov_read_float: reads a number that was written into an AOV.
#include "nodes/state/aov_read.h"

namespace lightsieve {
namespace {

struct AovReadFloat : AovRead {
    static NodeType describe() {
        Describe<AovReadFloat> d("aov_read_float", NodeKind::Shader,
                                 "Reads a number that was written into an AOV.");
        describe_aov_read(d);
        return d.done();
    }
    [[nodiscard]] float eval(const ShadePoint& at) const { return read(at).rgb.r; }
};

}  // namespace

NodeType node_aov_read_float() { return AovReadFloat::describe(); }

}  // namespace lightsieve
