// absorption_vdf: a medium that only absorbs.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct AbsorptionVdf {
    Color absorption{0, 0, 0};

    static NodeType describe() {
        Describe<AbsorptionVdf> d("absorption_vdf", NodeKind::Shader,
                                  "A medium that only absorbs: it makes no event.");
        d.fills_volumes();
        d.param("absorption", &AbsorptionVdf::absorption, "Absorption coefficient.")
            .unit("1 / scene unit");
        return d.done();
    }

    void eval(const ShadePoint&, ClosureSet& out) const {
        out.add_medium(-1, positive(absorption), kBlack);
    }
};

}  // namespace

NodeType node_absorption_vdf() { return AbsorptionVdf::describe(); }

}  // namespace lightsieve
