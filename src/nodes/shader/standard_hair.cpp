// standard_hair: the fibre of hair and fur.
//
// The paths R, TT and TRT through the fibre by Chiang et al. 2016 (bsdf/hair.h), tinted each for itself, blended with a
// diffuse one; every event carries the label "hair". Pigment and base colour both absorb.
#include "nodes/shader/hair_common.h"
#include "nodes/shader/id_aovs.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum : int { kReflection, kTransmission, kSecond, kDiffuse, kEmission };

struct StandardHair : IdAovs {
    float base = 1, melanin = 1, melanin_redness = 0.5F, melanin_randomize = 0;
    Color base_color{1, 1, 1};
    float roughness = 0.2F, roughness_azimuthal = 0.2F, ior = 1.55F, shift = 3;
    bool roughness_anisotropic = false;
    Color specular_tint{1, 1, 1}, specular2_tint{1, 1, 1}, transmission_tint{1, 1, 1};
    float diffuse = 0, emission = 0, indirect_diffuse = 1, indirect_specular = 1;
    Color diffuse_color{1, 1, 1}, emission_color{1, 1, 1}, opacity{1, 1, 1};
    std::int32_t extra_depth = 16, extra_samples = 0;

    static NodeType describe();

    void prepare(NodeContext& context) { prepare_ids(context); }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        write_ids(at);
        const Color visible = unit(opacity);
        out.transparent(kWhite - visible);
        out.set_indirect({positive(indirect_diffuse), positive(indirect_specular)});
        const float diffuse_part = unit(diffuse);
        const HairFibre fibre(at, out);
        add_paths(at, fibre, visible * (1 - diffuse_part), out);
        out.add(kDiffuse, DiffuseReflect(unit(diffuse_color)), visible * diffuse_part,
                fibre.side_frame, true);
        out.emit(kEmission, visible * (positive(emission) * positive(emission_color)));
    }

  private:
    void add_paths(const ShadePoint& at, const HairFibre& fibre, Color weight,
                   ClosureSet& out) const {
        if (is_black(weight)) return;
        const float around = roughness_anisotropic ? unit(roughness_azimuthal) : unit(roughness);
        const HairWidth width = HairWidth::from_roughness(unit(roughness), around);
        // Strands differ in how much pigment they have: between none and twice as much.
        const float varied = 1 + unit(melanin_randomize) * (2 * random_of_curve(at) - 1);
        const Color absorption =
            hair_absorption_from_color(unit(base) * unit(base_color), around) +
            hair_absorption_from_melanin(unit(melanin), melanin_redness) * varied;
        const auto add = [&](int lobe, HairPath path, Color tint) {
            out.add(
                lobe,
                HairLobe(path, width.of(path), ior, absorption, deg_to_rad(shift), fibre.offset),
                weight * positive(tint), fibre.frame, true);
        };
        add(kReflection, HairPath::R, specular_tint);
        add(kTransmission, HairPath::TT, transmission_tint);
        add(kSecond, HairPath::TRT, specular2_tint);
        add(kSecond, HairPath::Rest, specular2_tint);
    }
};

using S = StandardHair;

void describe_light(Describe<S>& d) {
    d.param("specular_tint", &S::specular_tint, "Factor on the first highlight, R.").range(0, 1);
    d.param("specular2_tint", &S::specular2_tint, "Factor on the coloured highlight, TRT.")
        .range(0, 1);
    d.param("transmission_tint", &S::transmission_tint,
            "Factor on light that passes through the fibre, TT.")
        .range(0, 1);
    d.param("diffuse", &S::diffuse,
            "From specular (0) to wholly diffuse (1), for dirt and plants.")
        .range(0, 1);
    d.param("diffuse_color", &S::diffuse_color, "Reflectance of the diffuse part.").range(0, 1);
    d.param("emission", &S::emission, "Weight of the emission.").range(0, kInfinity);
    d.param("emission_color", &S::emission_color, "Radiance emitted.");
    d.param("opacity", &S::opacity, "Below 1, rays pass straight through for the rest.")
        .range(0, 1);
    d.param("extra_depth", &S::extra_depth,
            "Bounces that highlights and transmission may make beyond GI_specular_depth.")
        .range(0, 100);
    d.param("extra_samples", &S::extra_samples, "Arnold's further rays a hit.").ignored();
    d.param("indirect_diffuse", &S::indirect_diffuse,
            "Factor on indirect light of the diffuse part.")
        .range(0, 1);
    d.param("indirect_specular", &S::indirect_specular,
            "Factor on indirect light of the highlights.")
        .range(0, 1);
}

NodeType StandardHair::describe() {
    Describe<S> d("standard_hair", NodeKind::Shader, "Hair and fur, for curves.");
    d.param("base", &S::base, "Factor on base_color.").range(0, 1);
    d.param("base_color", &S::base_color,
            "Colour of dyed hair in bulk; the pigment darkens it further.")
        .range(0, 1);
    d.param("melanin", &S::melanin, "Amount of pigment: 0.2 is blonde, 0.5 brown, 1 black.")
        .range(0, 1);
    d.param("melanin_redness", &S::melanin_redness, "Share of the red pigment.").range(0, 1);
    d.param("melanin_randomize", &S::melanin_randomize,
            "How much the amount of pigment differs from strand to strand.")
        .range(0, 1);
    d.param("roughness", &S::roughness, "Width of the highlights.").range(0, 1);
    d.param("roughness_anisotropic", &S::roughness_anisotropic,
            "On: roughness acts along the fibre only, roughness_azimuthal around it.");
    d.param("roughness_azimuthal", &S::roughness_azimuthal,
            "Roughness around the fibre; acts with roughness_anisotropic.")
        .range(0, 1);
    d.param("ior", &S::ior, "Index of refraction of the fibre.").range(1, 3);
    d.param("shift", &S::shift, "Tilt of the scales on the fibre toward its root.")
        .unit("degrees")
        .range(0, 20);
    describe_light(d);
    describe_ids(d);
    d.lobe(kReflection, EventKind::Reflection, EventLobe::Specular, "hair",
           "Reflection by the surface of the fibre, R.");
    d.lobe(kTransmission, EventKind::Transmission, EventLobe::Specular, "hair",
           "Transmission through the fibre, TT.");
    d.lobe(kSecond, EventKind::Reflection, EventLobe::Specular, "hair",
           "Reflection inside of the fibre, TRT and longer paths.");
    d.lobe(kDiffuse, EventKind::Reflection, EventLobe::Diffuse, "hair",
           "Diffuse reflection by the side of the fibre.");
    d.lobe(kEmission, EventKind::Object, EventLobe::None, "hair", "Emission.");
    return d.done();
}

}  // namespace

NodeType node_standard_hair() { return StandardHair::describe(); }

}  // namespace lightsieve
