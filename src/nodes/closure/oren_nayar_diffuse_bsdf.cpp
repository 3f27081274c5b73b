// oren_nayar_diffuse_bsdf: diffuse reflection of a rough surface.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct OrenNayarDiffuse : ScatterCommon {
    Color color{0.18F, 0.18F, 0.18F};
    float roughness = 0;
    bool energy_compensation = true;

    static NodeType describe() {
        Describe<OrenNayarDiffuse> d(
            "oren_nayar_diffuse_bsdf", NodeKind::Shader,
            "Diffuse reflection of a rough surface that keeps its energy.");
        d.lobe(0, EventKind::Reflection, EventLobe::Diffuse, "", "Diffuse reflection.");
        d.param("color", &OrenNayarDiffuse::color, "Reflectance.").range(0, 1);
        d.param("roughness", &OrenNayarDiffuse::roughness, "0: Lambert; up to 1: like clay.")
            .range(0, 1);
        d.param("energy_compensation", &OrenNayarDiffuse::energy_compensation,
                "Always on: what rough surfaces scatter twice is not lost.")
            .ignored();
        describe_scatter(d);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        out.add(0, DiffuseReflect(positive(color), roughness), Color::grey(unit(weight)),
                frame(at, out), true);
    }
};

}  // namespace

NodeType node_oren_nayar_diffuse_bsdf() { return OrenNayarDiffuse::describe(); }

}  // namespace lightsieve
