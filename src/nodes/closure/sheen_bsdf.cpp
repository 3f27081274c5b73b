// sheen_bsdf: the glow of cloth.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Sheen : ScatterCommon {
    Color color{1, 1, 1};
    float roughness = 0.3F;

    static NodeType describe() {
        Describe<Sheen> d("sheen_bsdf", NodeKind::Shader,
                          "The glow that fibres give to cloth and dust.");
        d.lobe(0, EventKind::Reflection, EventLobe::Specular, "sheen", "Reflection by fibres.");
        d.param("color", &Sheen::color, "Tint of the glow.").range(0, 1);
        d.param("roughness", &Sheen::roughness, "How far the glow spreads from the edge.")
            .range(0, 1);
        describe_scatter(d);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        out.add(0, SheenReflect(roughness), unit(weight) * positive(color), frame(at, out), true);
    }
};

}  // namespace

NodeType node_sheen_bsdf() { return Sheen::describe(); }

}  // namespace lightsieve
