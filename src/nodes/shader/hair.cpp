// hair: the shader of older scenes, mapped onto the fibre of standard_hair.
//
// Its two highlights become R and TRT, its transmission TT, without pigment: its colours are factors on the light. A gloss
// g is the exponent of a cosine, hence a variance of 1 / g along the fibre.
#include "nodes/shader/hair_common.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum : int { kReflection, kTransmission, kSecond, kDiffuse };

struct OldHair {
    Color rootcolor{0.1F, 0.1F, 0.1F}, tipcolor{0.5F, 0.5F, 0.5F}, opacity{1, 1, 1};
    float ambdiff = 0.6F, spec = 1, gloss = 10, spec_shift = 0;
    Color spec_color{1, 1, 1};
    float spec2 = 0, gloss2 = 7, spec2_shift = 0;
    Color spec2_color{1, 0.4F, 0.1F};
    float transmission = 0, transmission_spread = 1;
    Color transmission_color{1, 0.4F, 0.1F};
    float indirect_diffuse = 1, kd_ind = 1;
    bool diffuse_cache = false;
    Name uparam, vparam;

    static NodeType describe();

    void eval(const ShadePoint& at, ClosureSet& out) const {
        const Color visible = unit(opacity);
        out.transparent(kWhite - visible);
        out.set_indirect({positive(indirect_diffuse), 1});
        const HairFibre fibre(at, out);
        const float along = at.on_curve ? at.curve_uv.y : at.uv.y;
        const Color color = lerp(unit(rootcolor), unit(tipcolor), unit(along));
        out.add(kDiffuse, DiffuseReflect(unit(ambdiff) * color), visible, fibre.side_frame, true);
        const auto add = [&](int lobe, HairPath path, Color weight, float exponent, float shift) {
            HairWidth width = HairWidth::from_roughness(0, 0.3F);
            width.variance = 1 / std::max(positive(exponent), 1e-3F);
            out.add(lobe, HairLobe(path, width, 1.55F, kBlack, deg_to_rad(shift), fibre.offset),
                    visible * weight, fibre.frame, true);
        };
        add(kReflection, HairPath::R, positive(spec) * positive(spec_color), gloss,
            -0.5F * spec_shift);
        add(kSecond, HairPath::TRT, positive(spec2) * positive(spec2_color), gloss2,
            0.25F * spec2_shift);
        add(kTransmission, HairPath::TT, positive(transmission) * positive(transmission_color),
            10 / std::max(positive(transmission_spread), 1e-2F), 0);
    }
};

using H = OldHair;

NodeType OldHair::describe() {
    Describe<H> d("hair", NodeKind::Shader,
                  "The hair shader of older scenes; standard_hair replaces it.");
    d.param("rootcolor", &H::rootcolor, "Diffuse colour at the root.").range(0, 1);
    d.param("tipcolor", &H::tipcolor, "Diffuse colour at the tip.").range(0, 1);
    d.param("opacity", &H::opacity, "Below 1, rays pass straight through for the rest.")
        .range(0, 1);
    d.param("ambdiff", &H::ambdiff, "Weight of the diffuse part.").range(0, 1);
    d.param("spec", &H::spec, "Weight of the first highlight.").range(0, 1);
    d.param("spec_color", &H::spec_color, "Colour of the first highlight.").range(0, 1);
    d.param("gloss", &H::gloss, "Sharpness of the first highlight.").range(1, 1000);
    d.param("spec_shift", &H::spec_shift, "How far the first highlight moves along the fibre.")
        .unit("degrees");
    d.param("spec2", &H::spec2, "Weight of the second highlight.").range(0, 1);
    d.param("spec2_color", &H::spec2_color, "Colour of the second highlight.").range(0, 1);
    d.param("gloss2", &H::gloss2, "Sharpness of the second highlight.").range(1, 1000);
    d.param("spec2_shift", &H::spec2_shift, "How far the second highlight moves along the fibre.")
        .unit("degrees");
    d.param("transmission", &H::transmission, "Weight of light that passes through.").range(0, 1);
    d.param("transmission_color", &H::transmission_color, "Colour of light that passes through.")
        .range(0, 1);
    d.param("transmission_spread", &H::transmission_spread,
            "How wide light that passes through spreads.")
        .range(0, 10);
    d.param("indirect_diffuse", &H::indirect_diffuse,
            "Factor on indirect light of the diffuse part.")
        .range(0, 1);
    d.param("kd_ind", &H::kd_ind, "Old name of indirect_diffuse.").ignored();
    d.param("diffuse_cache", &H::diffuse_cache, "Arnold's cache of diffuse light.").ignored();
    d.param("uparam", &H::uparam, "User data in place of u; not read, here curves know their own.")
        .ignored();
    d.param("vparam", &H::vparam, "User data in place of v; not read, here curves know their own.")
        .ignored();
    d.lobe(kReflection, EventKind::Reflection, EventLobe::Specular, "hair", "First highlight.");
    d.lobe(kTransmission, EventKind::Transmission, EventLobe::Specular, "hair",
           "Transmission through the fibre.");
    d.lobe(kSecond, EventKind::Reflection, EventLobe::Specular, "hair", "Second highlight.");
    d.lobe(kDiffuse, EventKind::Reflection, EventLobe::Diffuse, "hair",
           "Diffuse reflection by the side of the fibre.");
    return d.done();
}

}  // namespace

NodeType node_hair() { return OldHair::describe(); }

}  // namespace lightsieve
