// aov_write_float: writes a number into an AOV.
#include "nodes/state/aov_write.h"

namespace lightsieve {
namespace {

struct AovWriteFloat : AovWrite<float> {
    bool blend_opacity = true;

    static NodeType describe() {
        Describe<AovWriteFloat> d("aov_write_float", NodeKind::Shader,
                                  "Writes a number into an AOV.");
        describe_aov_write(d);
        d.param("blend_opacity", &AovWriteFloat::blend_opacity,
                "Behind transparent surfaces the AOV goes on, by opacity.");
        return d.done();
    }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        write(at, out, {Color::grey(aov_input), aov_input}, blend_opacity);
    }
};

}  // namespace

NodeType node_aov_write_float() { return AovWriteFloat::describe(); }

}  // namespace lightsieve
