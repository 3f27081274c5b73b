// standard_surface: the layered surface of Arnold and MaterialX.
//
// Layers from the top: opacity, coat, emission, metal or specular reflection, transmission or sheen over the diffuse
// base. What a layer lets through to those below is one colour, `left_`, taken for the view direction (not
// reciprocal, as the specification wants it). Source: Georgiev et al., "Autodesk Standard Surface" 1.0.1, section 4.
#include <cmath>

#include "bsdf/closure.h"
#include "nodes/shader/id_aovs.h"
#include "nodes/shader/layering.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum class SubsurfaceType : std::int32_t { Diffusion, Randomwalk, RandomwalkV2 };

/// Indices of the lobes, in the order of description.
enum Lobes : int {
    kDiffuse,
    kSheen,
    kSpecular,
    kMetal,
    kCoat,
    kTransmission,
    kSubsurface,
    kEmission,
    kInterior
};

struct StandardSurface : IdAovs {
    float base = 1;
    Color base_color{0.8F, 0.8F, 0.8F};
    float diffuse_roughness = 0, metalness = 0;
    float specular = 1;
    Color specular_color{1, 1, 1};
    float specular_roughness = 0.2F, specular_IOR = 1.5F, specular_anisotropy = 0,
          specular_rotation = 0;
    float transmission = 0;
    Color transmission_color{1, 1, 1};
    float transmission_depth = 0;
    Color transmission_scatter{0, 0, 0};
    float transmission_scatter_anisotropy = 0, transmission_dispersion = 0,
          transmission_extra_roughness = 0;
    float transmission_shadow_density = 0.5F;
    bool transmit_aovs = false;
    std::int32_t dielectric_priority = 0;
    float subsurface = 0;
    Color subsurface_color{1, 1, 1}, subsurface_radius{1, 1, 1};
    float subsurface_scale = 1, subsurface_anisotropy = 0;
    SubsurfaceType subsurface_type = SubsurfaceType::Randomwalk;
    float sheen = 0;
    Color sheen_color{1, 1, 1};
    float sheen_roughness = 0.3F;
    bool thin_walled = false;
    float coat = 0;
    Color coat_color{1, 1, 1};
    float coat_roughness = 0.1F, coat_IOR = 1.5F, coat_anisotropy = 0, coat_rotation = 0;
    float coat_affect_color = 0, coat_affect_roughness = 0;
    float thin_film_thickness = 0, thin_film_IOR = 1.5F;
    float emission = 0;
    Color emission_color{1, 1, 1}, opacity{1, 1, 1};
    /// World space; 0 0 0: the hit's own. Act only when linked: prepare() clears values that the file wrote.
    Vec3f normal{0, 0, 0}, coat_normal{0, 0, 0}, tangent{0, 0, 0};
    bool caustics = false, internal_reflections = true, exit_to_background = false;
    float indirect_diffuse = 1, indirect_specular = 1;

    static NodeType describe();
    void prepare(NodeContext& context);
    [[nodiscard]] bool reads_coordinates() const {
        return specular_anisotropy > 0 || coat_anisotropy > 0;
    }
    void eval(const ShadePoint& at, ClosureSet& out) const;
};

// Layers ------------------------------------------------------------------------------------------------------------

/// One evaluation: walks down the layers and adds their lobes.
class Layering {
  public:
    Layering(const StandardSurface& s, const ShadePoint& at, ClosureSet& out, Color visible)
        : s_(s),
          at_(at),
          out_(out),
          left_(visible),
          coat_(unit(s.coat)),
          transmission_(unit(s.transmission)),
          inside_(!at.entering && !s.thin_walled && transmission_ > 0),
          index_{s.specular_IOR, s.transmission_dispersion, at},
          base_(oriented(at, out, s.normal)) {
        out.set_indirect({positive(s.indirect_diffuse), positive(s.indirect_specular)});
        if (transmission_ > 0 && !s.thin_walled) {
            out.set_interior({interior(), index_.inside(), s.dielectric_priority});
            if (index_.disperses()) out.disperse();
        }
    }

    /// coat * coat_brdf, then lerp(1, coat_color * (1 - R), coat) for all below.
    void add_coat() {
        if (!(coat_ > 0)) return;
        Color through = unit(s_.coat_color);
        // Seen from inside of a transparent body the coat only tints: its reflection is on the other side.
        if (!inside_) {
            const OrientedFrame frame = oriented(at_, out_, s_.coat_normal, s_.tangent,
                                                 s_.coat_anisotropy, s_.coat_rotation);
            const LayerLobe coat(
                dielectric_reflection(
                    GgxAlpha::from_roughness(unit(s_.coat_roughness), s_.coat_anisotropy),
                    s_.coat_IOR),
                frame);
            through *= coat.leaves();
            coat.add_to(out_, kCoat, left_ * coat_, s_.caustics);
        }
        left_ *= lerp(kWhite, through, coat_);
    }

    void add_emission() {
        if (!(s_.emission > 0)) return;
        const Color radiance = left_ * (positive(s_.emission) * positive(s_.emission_color));
        if (!is_black(radiance)) out_.emit(kEmission, radiance);
    }

    /// metalness * metal_brdf + (1 - metalness) * ...
    void add_metal() {
        const float metalness = unit(s_.metalness);
        if (metalness > 0) {
            const Color reflectivity = unit(positive(s_.base) * positive(s_.base_color));
            const Color edge_tint = unit(positive(s_.specular) * positive(s_.specular_color));
            const auto metal = ConductorReflect::from_artistic(specular_alpha(roughness(0)),
                                                               reflectivity, edge_tint);
            out_.add(kMetal, has_film() ? filmed(metal.alpha, metal.n, metal.k) : LobeModel(metal),
                     left_ * metalness, specular_frame().index, s_.caustics);
        }
        left_ *= 1 - metalness;
    }

    /// specular * specular_color * spec_brdf + (1 - specular * specular_color * R) * ...
    /// Through a sheet the index alone decides: with specular 0, too, it darkens what is behind it by 1 - R
    /// (AiMicrofacetThinWallRefractionBSDF takes the index and has its own Fresnel factor).
    void add_specular() {
        const Color weight = positive(s_.specular) * positive(s_.specular_color);
        if (is_black(left_) || (is_black(weight) && !is_sheet())) return;
        const GgxAlpha alpha = specular_alpha(roughness(0));
        const LayerLobe gloss(has_film() ? filmed(alpha, Color::grey(s_.specular_IOR), kBlack)
                                         : dielectric_reflection(alpha, reflecting_ior()),
                              specular_frame());
        if (!inside_ || s_.internal_reflections)
            gloss.add_to(out_, kSpecular, left_ * weight, s_.caustics);
        if (is_sheet()) through_sheet_ = left_ * gloss.leaves();
        left_ *= gloss.leaves(weight);
    }

    /// transmission * transmission_color * spec_btdf + (1 - transmission) * ...
    void add_transmission() {
        if (transmission_ > 0 && !is_black(left_)) {
            const bool tints_inside = s_.transmission_depth > 0 && !s_.thin_walled;
            const Color tint =
                transmission_ * (tints_inside ? kWhite : positive(s_.transmission_color));
            const GgxAlpha alpha = specular_alpha(roughness(s_.transmission_extra_roughness));
            const LobeModel model =
                is_sheet() ? LobeModel(ThinTransmit::through_sheet(alpha, s_.specular_IOR))
                           : LobeModel(DielectricTransmit(alpha, index_.refracting()));
            out_.add(kTransmission, model, (is_sheet() ? through_sheet_ : left_) * tint,
                     specular_frame().index, s_.caustics);
            if (!s_.caustics) out_.transmit_shadow(left_ * tint);
        }
        left_ *= 1 - transmission_;
    }

    /// sheen * sheen_color * sheen_brdf + (1 - sheen * R) * ...
    void add_sheen() {
        const float sheen = unit(s_.sheen);
        if (!(sheen > 0) || is_black(left_)) return;
        const LayerLobe fibres(SheenReflect(s_.sheen_roughness), base_);
        fibres.add_to(out_, kSheen, left_ * (sheen * positive(s_.sheen_color)), s_.caustics);
        left_ *= fibres.leaves(Color::grey(sheen));
    }

    /// (1 - subsurface) * base * base_color * diffuse_brdf + subsurface * subsurface_mix
    void add_base() {
        if (is_black(left_)) return;
        const float subsurface = unit(s_.subsurface);
        const Color reflectance = positive(s_.base) * darkened(s_.base_color);
        if (subsurface < 1 && !is_black(reflectance))
            out_.add(kDiffuse, rough_diffuse(reflectance, s_.diffuse_roughness),
                     left_ * (1 - subsurface), base_.index, true);
        if (!(subsurface > 0)) return;
        const Color color = darkened(s_.subsurface_color), weight = left_ * subsurface;
        const Color radius = positive(s_.subsurface_radius) * positive(s_.subsurface_scale);
        if (s_.thin_walled) {
            out_.add(kSubsurface, DiffuseTransmit(color, s_.diffuse_roughness), weight,
                     base_.index, true);
        } else {
            add_below_surface(out_, kSubsurface, color, radius, s_.subsurface_anisotropy, weight,
                              base_.index, s_.diffuse_roughness);
        }
    }

  private:
    /// What the body is filled with.
    [[nodiscard]] Medium interior() const {
        if (!(s_.transmission_depth > 0)) return {};
        return interior_medium(out_, kInterior, s_.transmission_color, s_.transmission_depth,
                               s_.transmission_scatter, Phase(s_.transmission_scatter_anisotropy));
    }
    [[nodiscard]] OrientedFrame specular_frame() {
        if (!(s_.specular_anisotropy > 0)) return base_;
        if (!has_specular_frame_)
            specular_ = oriented(at_, out_, s_.normal, s_.tangent, s_.specular_anisotropy,
                                 s_.specular_rotation);
        has_specular_frame_ = true;
        return specular_;
    }

    /// Roughness of the specular layers below a coat: lerp(r, 1, coat * coat_affect_roughness * coat_roughness).
    [[nodiscard]] float roughness(float extra) const {
        const float affect = coat_ * unit(s_.coat_affect_roughness) * unit(s_.coat_roughness);
        return lerp(unit(s_.specular_roughness + extra), 1.0F, affect);
    }
    [[nodiscard]] GgxAlpha specular_alpha(float r) const {
        return GgxAlpha::from_roughness(r, s_.specular_anisotropy);
    }
    /// Glass without thickness.
    [[nodiscard]] bool is_sheet() const { return s_.thin_walled && transmission_ > 0; }
    /// A film lies on the outside of bodies, below the coat.
    [[nodiscard]] bool has_film() const {
        return s_.thin_film_thickness > 0 && !inside_ && !s_.thin_walled;
    }
    [[nodiscard]] LobeModel filmed(GgxAlpha alpha, Color n, Color k) const {
        return FilmReflect(alpha, s_.thin_film_thickness, s_.thin_film_IOR, n, k);
    }
    /// n(far side) / n(side of wo) for reflection; opaque surfaces and sheets border on air.
    [[nodiscard]] float reflecting_ior() const {
        return transmission_ > 0 && !s_.thin_walled ? index_.reflecting() : s_.specular_IOR;
    }

    /// Colours below the coat: raised to 1 + coat * coat_affect_color.
    [[nodiscard]] Color darkened(Color c) const {
        c = positive(c);
        const float exponent = 1 + coat_ * positive(s_.coat_affect_color);
        if (exponent == 1) return c;
        return {std::pow(c.r, exponent), std::pow(c.g, exponent), std::pow(c.b, exponent)};
    }

    const StandardSurface& s_;
    const ShadePoint& at_;
    ClosureSet& out_;
    Color left_;           ///< share of the light that the layers above let through
    Color through_sheet_;  ///< what the reflection of a sheet leaves of it
    float coat_, transmission_;
    bool inside_;  ///< of a transparent body
    BodyIndex index_;
    OrientedFrame base_, specular_{};
    bool has_specular_frame_ = false;
};

void StandardSurface::eval(const ShadePoint& at, ClosureSet& out) const {
    write_ids(at);
    const Color visible = unit(opacity);
    out.transparent(kWhite - visible);
    if (is_black(visible)) return;
    Layering layers(*this, at, out, visible);
    layers.add_coat();
    layers.add_emission();
    layers.add_metal();
    layers.add_specular();
    layers.add_transmission();
    layers.add_sheen();
    layers.add_base();
}

void StandardSurface::prepare(NodeContext& context) {
    prepare_ids(context);
    if (!context.is_linked("normal")) normal = {};
    if (!context.is_linked("coat_normal")) coat_normal = {};
    if (!context.is_linked("tangent")) tangent = {};
}

// Parameters --------------------------------------------------------------------------------------------------------

using S = StandardSurface;

void describe_base(Describe<S>& d) {
    d.param("base", &S::base, "Weight of the diffuse base and of the metal's colour.").range(0, 1);
    d.param("base_color", &S::base_color,
            "Reflectance of the diffuse base, or of the metal seen face on.")
        .range(0, 1);
    d.param("diffuse_roughness", &S::diffuse_roughness, "0: Lambert; up to 1: rougher, like clay.")
        .range(0, 1);
    d.param("metalness", &S::metalness, "Mix from a dielectric (0) to a metal (1).").range(0, 1);
    d.param("specular", &S::specular, "Weight of the specular reflection.").range(0, 1);
    d.param("specular_color", &S::specular_color,
            "Tint of the specular reflection; of metals at the edge.")
        .range(0, 1);
    d.param("specular_roughness", &S::specular_roughness,
            "0: a mirror. The width of the microfacets is its square.")
        .range(0, 1);
    d.param("specular_IOR", &S::specular_IOR, "Index of refraction.").range(1, 3);
    d.param("specular_anisotropy", &S::specular_anisotropy,
            "Stretches highlights across the tangent.")
        .range(0, 1);
    d.param("specular_rotation", &S::specular_rotation, "Turns the direction of anisotropy.")
        .unit("turns")
        .range(0, 1);
}

void describe_transmission(Describe<S>& d) {
    d.param("transmission", &S::transmission, "Mix from the diffuse base (0) to a clear body (1).")
        .range(0, 1);
    d.param("transmission_color", &S::transmission_color, "Tint of what is seen through the body.")
        .range(0, 1);
    d.param("transmission_depth", &S::transmission_depth,
            "Depth at which the interior has transmission_color; 0: tinted at the surface.")
        .unit("scene units");
    d.param("transmission_scatter", &S::transmission_scatter,
            "Scattering coefficient of the interior.")
        .unit("1/scene units");
    d.param("transmission_scatter_anisotropy", &S::transmission_scatter_anisotropy,
            "Mean cosine of that scattering: above 0 light goes on forward.")
        .range(-1, 1);
    d.param("transmission_dispersion", &S::transmission_dispersion,
            "Abbe number: the lower, the more colours part; 0: not at all.");
    d.param("transmission_extra_roughness", &S::transmission_extra_roughness,
            "Added to specular_roughness for transmission.")
        .range(-1, 1);
    d.param("transmission_shadow_density", &S::transmission_shadow_density,
            "Arnold's darkness of shadows of clear bodies.")
        .ignored();
    d.param("transmit_aovs", &S::transmit_aovs,
            "What is seen through the surface goes to its own AOVs, alpha and data layers.");
    d.param("dielectric_priority", &S::dielectric_priority,
            "Where clear bodies overlap, the one of higher priority is there; equals ignore each "
            "other.");
}

void describe_subsurface_and_sheen(Describe<S>& d) {
    d.param("subsurface", &S::subsurface,
            "Mix from diffuse reflection to subsurface scattering; thin_walled: to diffuse "
            "transmission.")
        .range(0, 1);
    d.param("subsurface_color", &S::subsurface_color, "Reflectance of subsurface scattering.")
        .range(0, 1);
    d.param("subsurface_radius", &S::subsurface_radius, "Mean free path, a channel each.")
        .unit("scene units");
    d.param("subsurface_scale", &S::subsurface_scale, "Factor on subsurface_radius.");
    d.param("subsurface_anisotropy", &S::subsurface_anisotropy,
            "Mean cosine of the scattering: above 0 light goes on forward.")
        .range(-1, 1);
    d.param("subsurface_type", &S::subsurface_type,
            "Arnold's choice of methods; here light always walks.")
        .names({"diffusion", "randomwalk", "randomwalk_v2"})
        .ignored();
    d.param("sheen", &S::sheen, "Weight of the glow of cloth.").range(0, 1);
    d.param("sheen_color", &S::sheen_color, "Tint of the sheen.").range(0, 1);
    d.param("sheen_roughness", &S::sheen_roughness, "How far the sheen spreads from the edge.")
        .range(0, 1);
    d.param("thin_walled", &S::thin_walled,
            "The surface is a sheet without an interior: transmission does not bend.");
}

void describe_coat(Describe<S>& d) {
    d.param("coat", &S::coat, "Weight of a clear layer on top.").range(0, 1);
    d.param("coat_color", &S::coat_color, "Tint of what is seen through the coat.").range(0, 1);
    d.param("coat_roughness", &S::coat_roughness, "Roughness of the coat.").range(0, 1);
    d.param("coat_IOR", &S::coat_IOR, "Index of refraction of the coat.").range(1, 3);
    d.param("coat_anisotropy", &S::coat_anisotropy, "Stretches highlights of the coat.")
        .range(0, 1);
    d.param("coat_rotation", &S::coat_rotation, "Turns the direction of the coat's anisotropy.")
        .unit("turns")
        .range(0, 1);
    d.param("coat_normal", &S::coat_normal, "Normal of the coat, world space; acts when linked.");
    d.param("coat_affect_color", &S::coat_affect_color,
            "How much the coat saturates the diffuse colours below.")
        .range(0, 1);
    d.param("coat_affect_roughness", &S::coat_affect_roughness,
            "How much the coat's roughness blurs the specular layers below.")
        .range(0, 1);
    d.param("thin_film_thickness", &S::thin_film_thickness,
            "Thickness of an iridescent film; 0: none.")
        .unit("nm")
        .range(0, 2000);
    d.param("thin_film_IOR", &S::thin_film_IOR, "Index of refraction of the film.").range(1, 3);
}

void describe_rest(Describe<S>& d) {
    d.param("emission", &S::emission, "Weight of the emission.").range(0, kInfinity);
    d.param("emission_color", &S::emission_color, "Radiance emitted, seen through the coat.");
    d.param("opacity", &S::opacity, "Below 1, rays pass straight through for the rest.")
        .range(0, 1);
    d.param("normal", &S::normal, "Shading normal, world space; acts when linked.");
    d.param("tangent", &S::tangent, "Direction of anisotropy, world space; acts when linked.");
    d.param("caustics", &S::caustics, "Specular lobes are also seen by diffuse rays.");
    d.param("internal_reflections", &S::internal_reflections,
            "Rays inside of a clear body are reflected.");
    d.param("exit_to_background", &S::exit_to_background,
            "Rays past their depth limit see the background instead of black.");
    d.param("indirect_diffuse", &S::indirect_diffuse,
            "Factor on indirect light of diffuse lobes and subsurface scattering.")
        .range(0, 1);
    d.param("indirect_specular", &S::indirect_specular,
            "Factor on indirect light of specular reflection.")
        .range(0, 1);
    describe_ids(d);
}

NodeType StandardSurface::describe() {
    Describe<S> d("standard_surface", NodeKind::Shader,
                  "A layered surface: coat, metal, specular, transmission, sheen, diffuse.");
    describe_base(d);
    describe_transmission(d);
    describe_subsurface_and_sheen(d);
    describe_coat(d);
    describe_rest(d);
    d.lobe(kDiffuse, EventKind::Reflection, EventLobe::Diffuse, "",
           "Diffuse reflection of the base.");
    d.lobe(kSheen, EventKind::Reflection, EventLobe::Specular, "sheen", "Sheen.");
    d.lobe(kSpecular, EventKind::Reflection, EventLobe::Specular, "",
           "Specular reflection, also inside of clear bodies.");
    d.lobe(kMetal, EventKind::Reflection, EventLobe::Specular, "", "Reflection of metal.");
    d.lobe(kCoat, EventKind::Reflection, EventLobe::Specular, "coat", "Reflection of the coat.");
    d.lobe(kTransmission, EventKind::Transmission, EventLobe::Specular, "",
           "Refraction, or straight transmission of thin walls.");
    d.lobe_below_surface(kSubsurface,
                         "Subsurface scattering; diffuse transmission where thin_walled.");
    d.lobe(kEmission, EventKind::Object, EventLobe::None, "", "Emission.");
    d.lobe(kInterior, EventKind::Volume, EventLobe::None, "",
           "Scattering inside: transmission_scatter.");
    return d.done();
}

}  // namespace

NodeType node_standard_surface() { return StandardSurface::describe(); }

}  // namespace lightsieve
