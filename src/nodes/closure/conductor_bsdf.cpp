// conductor_bsdf: a metal by its optical constants.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Conductor : MicrofacetCommon {
    // Gold, as MaterialX has it.
    Color ior{0.183F, 0.421F, 1.373F}, extinction{3.424F, 2.346F, 1.770F};

    static NodeType describe() {
        Describe<Conductor> d(
            "conductor_bsdf", NodeKind::Shader,
            "Reflection by a metal, from its index of refraction and extinction.");
        d.lobe(0, EventKind::Reflection, EventLobe::Specular, "", "Reflection.");
        d.param("ior", &Conductor::ior, "Index of refraction, a channel each.");
        d.param("extinction", &Conductor::extinction, "Extinction, a channel each.");
        describe_microfacets(d);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        const LobeModel model = thinfilm_thickness > 0
                                    ? LobeModel(filmed(ior, extinction))
                                    : LobeModel(ConductorReflect(alpha(), ior, extinction));
        out.add(0, model, Color::grey(unit(weight)), frame(at, out, tangent), caustics);
    }
};

}  // namespace

NodeType node_conductor_bsdf() { return Conductor::describe(); }

}  // namespace lightsieve
