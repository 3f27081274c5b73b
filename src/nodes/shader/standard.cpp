// standard: the surface of Arnold before standard_surface, which old scenes still use.
//
// Lobes lie beside each other and are added, each with a weight of its own; only the Fresnel switches take light from
// the diffuse part. Reflectance follows Schlick's curve from Ksn (Krn) to 1.
#include <cmath>

#include "nodes/shader/layering.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum Lobes : int {
    kDiffuse,
    kBacklight,
    kSpecular,
    kReflection,
    kRefraction,
    kSubsurface,
    kEmission
};

enum class Distribution : std::int32_t { Beckmann, Ggx };

struct Standard {
    float Kd = 0.7F;
    Color Kd_color{1, 1, 1};
    float diffuse_roughness = 0, Kb = 0;
    float Ks = 0;
    Color Ks_color{1, 1, 1};
    float specular_roughness = 0.466905F, specular_anisotropy = 0.5F, specular_rotation = 0;
    Distribution specular_distribution = Distribution::Ggx;
    bool specular_Fresnel = false;
    float Ksn = 0;
    float Kr = 0;
    Color Kr_color{1, 1, 1};
    bool Fresnel = false;
    float Krn = 0;
    bool Fresnel_use_IOR = false, Fresnel_affect_diff = true;
    float Kt = 0;
    Color Kt_color{1, 1, 1}, transmittance{1, 1, 1};
    float refraction_roughness = 0, IOR = 1, dispersion_abbe = 0;
    float emission = 0;
    Color emission_color{1, 1, 1};
    float Ksss = 0;
    Color Ksss_color{1, 1, 1}, sss_radius{0.1F, 0.1F, 0.1F};
    float direct_diffuse = 1, indirect_diffuse = 1, direct_specular = 1, indirect_specular = 1,
          bounce_factor = 1;
    bool enable_glossy_caustics = false, enable_reflective_caustics = false,
         enable_refractive_caustics = false, enable_internal_reflections = true;
    Color reflection_exit_color{0, 0, 0}, refraction_exit_color{0, 0, 0};
    bool reflection_exit_use_environment = false, refraction_exit_use_environment = false;
    Color opacity{1, 1, 1};
    Vec3f normal{0, 0, 0};

    static NodeType describe();
    void prepare(NodeContext& context);
    void eval(const ShadePoint& at, ClosureSet& out) const;

  private:
    /// Reflectance face on: a number, or that of the index.
    [[nodiscard]] float facing(bool fresnel, float number) const {
        if (!fresnel) return 1;
        return Fresnel_use_IOR ? square((IOR - 1) / (IOR + 1)) : unit(number);
    }
};

void Standard::eval(const ShadePoint& at, ClosureSet& out) const {
    const Color visible = unit(opacity);
    out.transparent(kWhite - visible);
    if (is_black(visible)) return;
    out.set_indirect({positive(indirect_diffuse), positive(indirect_specular)});
    const OrientedFrame base = oriented(at, out, normal);
    const bool inside = !at.entering && Kt > 0;
    Color diffuse = visible;
    const auto reflect = [&](int lobe, float weight, Color tint, GgxAlpha alpha, bool fresnel,
                             float normal_reflectance, bool caustics) {
        const Color factor = positive(weight) * positive(tint);
        if (is_black(factor) || (inside && !enable_internal_reflections)) return;
        const LayerLobe gloss(
            SchlickReflect(alpha, Color::grey(facing(fresnel, normal_reflectance)), kWhite), base);
        gloss.add_to(out, lobe, visible * factor, caustics);
        if (fresnel && Fresnel_affect_diff) diffuse *= gloss.leaves(factor);
    };
    reflect(kSpecular, Ks, Ks_color, GgxAlpha::from_roughness(unit(specular_roughness)),
            specular_Fresnel, Ksn, enable_glossy_caustics);
    reflect(kReflection, Kr, Kr_color, GgxAlpha(), Fresnel, Krn, enable_reflective_caustics);
    const Color refracted = positive(Kt) * positive(Kt_color);
    if (!is_black(refracted)) {
        const BodyIndex index(IOR, dispersion_abbe, at);
        out.set_interior({interior_medium(out, -1, transmittance, 1, {}), index.inside()});
        if (index.disperses()) out.disperse();
        out.add(kRefraction,
                DielectricTransmit(GgxAlpha::from_roughness(unit(refraction_roughness)),
                                   index.refracting()),
                visible * refracted, base.index, enable_refractive_caustics);
        if (!enable_refractive_caustics) out.transmit_shadow(visible * refracted);
    }
    const Color reflectance = positive(Kd) * positive(Kd_color);
    if (!is_black(reflectance)) {
        // Light from behind is added: the front stays as bright (the felt of test_0079, whose Kb is 1).
        out.add(kDiffuse, rough_diffuse(reflectance, diffuse_roughness), diffuse, base.index,
                true);
        out.add(kBacklight, DiffuseTransmit(reflectance, diffuse_roughness), diffuse * unit(Kb),
                base.index, true);
    }
    if (Ksss > 0)
        add_below_surface(out, kSubsurface, positive(Ksss_color), positive(sss_radius), 0,
                          diffuse * unit(Ksss), base.index);
    if (emission > 0) out.emit(kEmission, visible * (emission * positive(emission_color)));
}

void Standard::prepare(NodeContext& context) {
    if (!context.is_linked("normal")) normal = {};
}

using S = Standard;

void describe_diffuse(Describe<S>& d) {
    d.param("Kd", &S::Kd, "Weight of the diffuse reflection.").range(0, 1);
    d.param("Kd_color", &S::Kd_color, "Reflectance.").range(0, 1);
    d.param("diffuse_roughness", &S::diffuse_roughness, "0: Lambert; up to 1: like clay.")
        .range(0, 1);
    d.param("Kb", &S::Kb, "Weight of diffuse light from behind, as through a leaf; it is added.")
        .range(0, 1);
    d.param("Ksss", &S::Ksss, "Weight of subsurface scattering.").range(0, 1);
    d.param("Ksss_color", &S::Ksss_color, "Reflectance of subsurface scattering.").range(0, 1);
    d.param("sss_radius", &S::sss_radius, "Mean free path, a channel each.").unit("scene units");
    d.param("emission", &S::emission, "Weight of the emission.").range(0, kInfinity);
    d.param("emission_color", &S::emission_color, "Radiance emitted.");
}

void describe_specular(Describe<S>& d) {
    d.param("Ks", &S::Ks, "Weight of the glossy reflection.").range(0, 1);
    d.param("Ks_color", &S::Ks_color, "Its tint.").range(0, 1);
    d.param("specular_roughness", &S::specular_roughness, "Width of the highlights.").range(0, 1);
    d.param("specular_anisotropy", &S::specular_anisotropy, "0.5: the same in all directions.")
        .range(0, 1)
        .pending();
    d.param("specular_rotation", &S::specular_rotation,
            "Turns the highlights; acts with specular_anisotropy.")
        .ignored();
    d.param("specular_distribution", &S::specular_distribution,
            "Of the microfacets; highlights are those of ggx here.")
        .names({"beckmann", "ggx"})
        .pending();
    d.param("specular_Fresnel", &S::specular_Fresnel, "Reflects more at the edge.");
    d.param("Ksn", &S::Ksn, "Reflectance face on, with specular_Fresnel.").range(0, 1);
    d.param("Kr", &S::Kr, "Weight of the mirror reflection.").range(0, 1);
    d.param("Kr_color", &S::Kr_color, "Its tint.").range(0, 1);
    d.param("Fresnel", &S::Fresnel, "The mirror reflects more at the edge.");
    d.param("Krn", &S::Krn, "Reflectance face on, with Fresnel.").range(0, 1);
    d.param("Fresnel_use_IOR", &S::Fresnel_use_IOR, "Reflectance face on follows from IOR.");
    d.param("Fresnel_affect_diff", &S::Fresnel_affect_diff,
            "What is reflected is missing below, with specular_Fresnel or Fresnel.");
}

void describe_rest(Describe<S>& d) {
    d.param("Kt", &S::Kt, "Weight of the refraction.").range(0, 1);
    d.param("Kt_color", &S::Kt_color, "Its tint.").range(0, 1);
    d.param("transmittance", &S::transmittance,
            "What is left of light after one scene unit inside.")
        .range(0, 1);
    d.param("refraction_roughness", &S::refraction_roughness, "Blur of what is seen through.")
        .range(0, 1);
    d.param("IOR", &S::IOR, "Index of refraction.").range(1, 3);
    d.param("dispersion_abbe", &S::dispersion_abbe, "Abbe number; 0: no dispersion.");
    d.param("indirect_diffuse", &S::indirect_diffuse, "Factor on indirect light of diffuse lobes.")
        .range(0, 1);
    d.param("indirect_specular", &S::indirect_specular,
            "Factor on indirect light of specular reflection.")
        .range(0, 1);
    for (const auto& [name, member] : {std::pair{"direct_diffuse", &S::direct_diffuse},
                                       std::pair{"direct_specular", &S::direct_specular},
                                       std::pair{"bounce_factor", &S::bounce_factor}})
        d.param(name, member, "Factor on one kind of light only.").pending();
    d.param("enable_glossy_caustics", &S::enable_glossy_caustics,
            "Diffuse rays also see the glossy reflection.");
    d.param("enable_reflective_caustics", &S::enable_reflective_caustics,
            "Diffuse rays also see the mirror reflection.");
    d.param("enable_refractive_caustics", &S::enable_refractive_caustics,
            "Diffuse rays also see the refraction.");
    d.param("enable_internal_reflections", &S::enable_internal_reflections,
            "Rays inside of a clear body are reflected.");
    for (const auto& [name, member] :
         {std::pair{"reflection_exit_color", &S::reflection_exit_color},
          std::pair{"refraction_exit_color", &S::refraction_exit_color}})
        d.param(name, member, "Seen by rays past the depth limit; here that is black.").pending();
    for (const auto& [name, member] :
         {std::pair{"reflection_exit_use_environment", &S::reflection_exit_use_environment},
          std::pair{"refraction_exit_use_environment", &S::refraction_exit_use_environment}})
        d.param(name, member, "Such rays see the background; here they do not.").pending();
    d.param("opacity", &S::opacity, "Below 1, rays pass straight through for the rest.")
        .range(0, 1);
    d.param("normal", &S::normal, "Shading normal, world space; acts when linked.");
}

NodeType Standard::describe() {
    Describe<S> d("standard", NodeKind::Shader, "The surface of Arnold before standard_surface.");
    d.lobe(kDiffuse, EventKind::Reflection, EventLobe::Diffuse, "", "Diffuse reflection.");
    d.lobe(kBacklight, EventKind::Transmission, EventLobe::Diffuse, "", "Diffuse transmission.");
    d.lobe(kSpecular, EventKind::Reflection, EventLobe::Specular, "", "Glossy reflection.");
    d.lobe(kReflection, EventKind::Reflection, EventLobe::Specular, "", "Mirror reflection.");
    d.lobe(kRefraction, EventKind::Transmission, EventLobe::Specular, "", "Refraction.");
    d.lobe_below_surface(kSubsurface, "Subsurface scattering.");
    d.lobe(kEmission, EventKind::Object, EventLobe::None, "", "Emission.");
    describe_diffuse(d);
    describe_specular(d);
    describe_rest(d);
    return d.done();
}

}  // namespace

NodeType node_standard() { return Standard::describe(); }

}  // namespace lightsieve
