// generalized_schlick_bsdf: a mirror whose reflectance is given face on and at the edge.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct GeneralizedSchlick : MicrofacetCommon {
    Color color0{1, 1, 1}, color82{1, 1, 1}, color90{1, 1, 1};
    float exponent = 5;
    ScatterMode scatter_mode = ScatterMode::Reflect;

    static NodeType describe() {
        Describe<GeneralizedSchlick> d(
            "generalized_schlick_bsdf", NodeKind::Shader,
            "Reflection whose strength is given face on, at 82 degrees and at the edge.");
        d.lobe(0, EventKind::Reflection, EventLobe::Specular, "", "Reflection.");
        d.param("color0", &GeneralizedSchlick::color0, "Reflectance face on.").range(0, 1);
        d.param("color82", &GeneralizedSchlick::color82,
                "Factor on the plain curve at 82 degrees, where metals dip.")
            .range(0, 1);
        d.param("color90", &GeneralizedSchlick::color90, "Reflectance at the edge.").range(0, 1);
        d.param("exponent", &GeneralizedSchlick::exponent, "Of the curve between them.").pending();
        d.param("scatter_mode", &GeneralizedSchlick::scatter_mode,
                "R: reflects, T: refracts, RT: both.")
            .names({"R", "T", "RT"})
            .pending();
        describe_microfacets(d);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        const SchlickReflect base(alpha(), color0, color90, color82);
        const LobeModel model =
            thinfilm_thickness > 0
                ? LobeModel(FilmedSchlickReflect(thinfilm_thickness, thinfilm_ior, base))
                : LobeModel(base);
        out.add(0, model, Color::grey(unit(weight)), frame(at, out, tangent), caustics);
    }
};

}  // namespace

NodeType node_generalized_schlick_bsdf() { return GeneralizedSchlick::describe(); }

}  // namespace lightsieve
