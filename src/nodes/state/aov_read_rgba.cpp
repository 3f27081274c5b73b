// aov_read_rgba: reads a colour with alpha that was written into an AOV.
#include "nodes/state/aov_read.h"

namespace lightsieve {
namespace {

struct AovReadRgba : AovRead {
    static NodeType describe() {
        Describe<AovReadRgba> d("aov_read_rgba", NodeKind::Shader,
                                "Reads a colour with alpha that was written into an AOV.");
        describe_aov_read(d);
        return d.done();
    }
    [[nodiscard]] Rgba eval(const ShadePoint& at) const { return read(at); }
};

}  // namespace

NodeType node_aov_read_rgba() { return AovReadRgba::describe(); }

}  // namespace lightsieve
