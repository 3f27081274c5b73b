// aov_write_rgb: writes a colour into an AOV.
#include "nodes/state/aov_write.h"

namespace lightsieve {
namespace {

struct AovWriteRgb : AovWrite<Color> {
    bool blend_opacity = true;

    static NodeType describe() {
        Describe<AovWriteRgb> d("aov_write_rgb", NodeKind::Shader, "Writes a colour into an AOV.");
        describe_aov_write(d);
        d.param("blend_opacity", &AovWriteRgb::blend_opacity,
                "Behind transparent surfaces the AOV goes on, by opacity.");
        return d.done();
    }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        write(at, out, {aov_input, 1}, blend_opacity);
    }
};

}  // namespace

NodeType node_aov_write_rgb() { return AovWriteRgb::describe(); }

}  // namespace lightsieve
