// burley_diffuse_bsdf: Disney's diffuse reflection.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct BurleyDiffuse : ScatterCommon {
    Color color{0.18F, 0.18F, 0.18F};
    float roughness = 0;

    static NodeType describe() {
        Describe<BurleyDiffuse> d("burley_diffuse_bsdf", NodeKind::Shader,
                                  "Diffuse reflection that darkens at the edge where smooth and "
                                  "brightens there where rough.");
        d.lobe(0, EventKind::Reflection, EventLobe::Diffuse, "", "Diffuse reflection.");
        d.param("color", &BurleyDiffuse::color, "Reflectance.").range(0, 1);
        d.param("roughness", &BurleyDiffuse::roughness,
                "0: dark toward the edge; 1: bright there.")
            .range(0, 1);
        describe_scatter(d);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        out.add(0, BurleyReflect(positive(color), roughness), Color::grey(unit(weight)),
                frame(at, out), true);
    }
};

}  // namespace

NodeType node_burley_diffuse_bsdf() { return BurleyDiffuse::describe(); }

}  // namespace lightsieve
