// aov_read_rgb: reads a colour that was written into an AOV.
#include "nodes/state/aov_read.h"

namespace lightsieve {
namespace {

struct AovReadRgb : AovRead {
    static NodeType describe() {
        Describe<AovReadRgb> d("aov_read_rgb", NodeKind::Shader,
                               "Reads a colour that was written into an AOV.");
        describe_aov_read(d);
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint& at) const { return read(at).rgb; }
};

}  // namespace

NodeType node_aov_read_rgb() { return AovReadRgb::describe(); }

}  // namespace lightsieve
