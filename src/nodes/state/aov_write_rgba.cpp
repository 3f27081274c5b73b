// aov_write_rgba: writes a colour with alpha into an AOV.
#include "nodes/state/aov_write.h"

namespace lightsieve {
namespace {

struct AovWriteRgba : AovWrite<Rgba> {
    bool blend_opacity = true;

    static NodeType describe() {
        Describe<AovWriteRgba> d("aov_write_rgba", NodeKind::Shader,
                                 "Writes a colour with alpha into an AOV.");
        describe_aov_write(d);
        d.param("blend_opacity", &AovWriteRgba::blend_opacity,
                "Behind transparent surfaces the AOV goes on, by opacity.");
        return d.done();
    }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        write(at, out, aov_input, blend_opacity);
    }
};

}  // namespace

NodeType node_aov_write_rgba() { return AovWriteRgba::describe(); }

}  // namespace lightsieve
