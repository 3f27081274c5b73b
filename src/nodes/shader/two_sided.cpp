// two_sided: another shader on each side.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct TwoSided {
    ShaderRef front, back;

    static NodeType describe() {
        Describe<TwoSided> d("two_sided", NodeKind::Shader,
                             "One shader for each side of a surface.");
        d.param("front", &TwoSided::front, "Shader of the side that the normal points to.");
        d.param("back", &TwoSided::back, "Shader of the other side.");
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        (at.entering ? front : back).closures(at, out);
    }
};

}  // namespace

NodeType node_two_sided() { return TwoSided::describe(); }

}  // namespace lightsieve
