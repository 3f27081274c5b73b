// aov_write_int: writes a whole number into an AOV.
#include "nodes/state/aov_write.h"

namespace lightsieve {
namespace {

struct AovWriteInt : AovWrite<std::int32_t> {
    static NodeType describe() {
        Describe<AovWriteInt> d("aov_write_int", NodeKind::Shader,
                                "Writes a whole number into an AOV.");
        describe_aov_write(d);
        return d.done();
    }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        write(at, out, {Color::grey(static_cast<float>(aov_input)), 1}, false);
    }
};

}  // namespace

NodeType node_aov_write_int() { return AovWriteInt::describe(); }

}  // namespace lightsieve
