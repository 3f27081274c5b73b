// dielectric_bsdf: the surface of glass, water or varnish.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Dielectric : MicrofacetCommon {
    Color tint{1, 1, 1};
    float ior = 1.5F;
    ScatterMode scatter_mode = ScatterMode::Reflect;

    static NodeType describe() {
        Describe<Dielectric> d("dielectric_bsdf", NodeKind::Shader,
                               "Reflection and refraction by the surface of a clear body.");
        d.lobe(0, EventKind::Reflection, EventLobe::Specular, "", "Reflection.");
        d.lobe(1, EventKind::Transmission, EventLobe::Specular, "", "Refraction.");
        d.param("tint", &Dielectric::tint, "Factor on what is reflected and refracted.")
            .range(0, 1);
        d.param("ior", &Dielectric::ior, "Index of refraction of the side away from the normal.")
            .range(1, 3);
        d.param("scatter_mode", &Dielectric::scatter_mode, "R: reflects, T: refracts, RT: both.")
            .names({"R", "T", "RT"});
        describe_microfacets(d);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        const Color factor = unit(weight) * positive(tint);
        const std::uint8_t own = frame(at, out, tangent);
        // A body that only reflects is seen from outside on both sides; one that refracts has an inside.
        const bool inside = transmits(scatter_mode) && !at.entering;
        const BodyIndex index(ior, 0, at);
        const float eta = transmits(scatter_mode) ? index.refracting() : ior;
        if (transmits(scatter_mode)) out.set_interior({{}, index.inside()});
        const LayerLobe reflection(thinfilm_thickness > 0 && !inside
                                       ? LobeModel(filmed(Color::grey(ior), kBlack))
                                       : LobeModel(DielectricReflect(alpha(), eta)),
                                   {own, out.local_wo(own)});
        if (reflects(scatter_mode)) reflection.add_to(out, 0, factor, caustics);
        if (!transmits(scatter_mode)) return;
        out.add(1, DielectricTransmit(alpha(), eta), factor * reflection.leaves(), own, caustics);
    }
};

}  // namespace

NodeType node_dielectric_bsdf() { return Dielectric::describe(); }

}  // namespace lightsieve
