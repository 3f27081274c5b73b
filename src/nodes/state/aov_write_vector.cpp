// aov_write_vector: writes a vector into an AOV.
#include "nodes/state/aov_write.h"

namespace lightsieve {
namespace {

struct AovWriteVector : AovWrite<Vec3f> {
    static NodeType describe() {
        Describe<AovWriteVector> d("aov_write_vector", NodeKind::Shader,
                                   "Writes a vector into an AOV.");
        describe_aov_write(d);
        return d.done();
    }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        write(at, out, {{aov_input.x, aov_input.y, aov_input.z}, 1}, false);
    }
};

}  // namespace

NodeType node_aov_write_vector() { return AovWriteVector::describe(); }

}  // namespace lightsieve
