// openpbr_surface: the Academy's layered surface.
//
// From the top: fuzz, coat, emission, then metal or a dielectric that transmits, scatters below its surface or reflects diffusely.
// What a layer lets through is one colour, `left_`, taken for the view direction.
// Source: Portsmouth et al., "OpenPBR Surface specification" 1.1; section numbers in comments are its own.
#include <cmath>

#include "nodes/shader/layering.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum Lobes : int {
    kDiffuse,
    kFuzz,
    kSpecular,
    kMetal,
    kCoat,
    kTransmission,
    kSubsurface,
    kEmission,
    kInterior
};

struct OpenPbrSurface {
    float base_weight = 1;
    Color base_color{0.8F, 0.8F, 0.8F};
    float base_diffuse_roughness = 0, base_metalness = 0;
    float specular_weight = 1;
    Color specular_color{1, 1, 1};
    float specular_roughness = 0.3F, specular_ior = 1.5F, specular_roughness_anisotropy = 0;
    float transmission_weight = 0;
    Color transmission_color{1, 1, 1};
    float transmission_depth = 0;
    Color transmission_scatter{0, 0, 0};
    float transmission_scatter_anisotropy = 0, transmission_dispersion_scale = 0,
          transmission_dispersion_abbe_number = 20;
    bool transmission_transmit_aovs = false;
    float subsurface_weight = 0;
    Color subsurface_color{0.8F, 0.8F, 0.8F};
    float subsurface_radius = 1;
    Color subsurface_radius_scale{1, 0.5F, 0.25F};
    float subsurface_scatter_anisotropy = 0;
    float fuzz_weight = 0;
    Color fuzz_color{1, 1, 1};
    float fuzz_roughness = 0.5F;
    float coat_weight = 0;
    Color coat_color{1, 1, 1};
    float coat_roughness = 0, coat_roughness_anisotropy = 0, coat_ior = 1.6F, coat_darkening = 1;
    float thin_film_weight = 0, thin_film_thickness = 0.5F, thin_film_ior = 1.4F;
    float emission_luminance = 0;
    Color emission_color{1, 1, 1};
    float geometry_opacity = 1;
    bool geometry_thin_walled = false;
    /// World space; act only when linked.
    Vec3f geometry_normal{0, 0, 0}, geometry_tangent{0, 0, 0}, geometry_coat_normal{0, 0, 0},
        geometry_coat_tangent{0, 0, 0};
    std::int32_t dielectric_priority = 0;
    bool caustics = false, internal_reflections = true, exit_to_background = false;

    static NodeType describe();
    void prepare(NodeContext& context);
    [[nodiscard]] bool reads_coordinates() const {
        return specular_roughness_anisotropy > 0 || coat_roughness_anisotropy > 0;
    }
    void eval(const ShadePoint& at, ClosureSet& out) const;
};

/// Widths along both axes. Section 3.4.1, eq. "alpha_t, alpha_b".
GgxAlpha stretched(float roughness, float anisotropy) {
    const float squared = square(unit(roughness)), narrow = 1 - unit(anisotropy);
    const float along = squared * std::sqrt(2 / (1 + narrow * narrow));
    return {along, narrow * along};
}

/// Reflectance face on.
float facing_reflectance(float ior) { return square((ior - 1) / (ior + 1)); }

/// One evaluation: walks down the layers and adds their lobes.
class Layering {
  public:
    Layering(const OpenPbrSurface& s, const ShadePoint& at, ClosureSet& out, Color visible)
        : s_(s),
          at_(at),
          out_(out),
          left_(visible),
          coat_(unit(s.coat_weight)),
          transmission_(unit(s.transmission_weight)),
          inside_(!at.entering && !s.geometry_thin_walled && transmission_ > 0),
          index_{modulated_ior(), abbe_number(s), at},
          base_(oriented(at, out, s.geometry_normal)) {
        if (!(transmission_ > 0) || s.geometry_thin_walled) return;
        out.set_interior({interior(), index_.inside(), s.dielectric_priority});
        if (index_.disperses()) out.disperse();
    }

    /// Section 3.8: fuzz over everything.
    void add_fuzz() {
        const float weight = unit(s_.fuzz_weight);
        if (!(weight > 0) || inside_) return;
        const LayerLobe fuzz(SheenReflect(s_.fuzz_roughness), base_);
        fuzz.add_to(out_, kFuzz, left_ * (weight * positive(s_.fuzz_color)), s_.caustics);
        left_ *= fuzz.leaves(Color::grey(weight));
    }

    /// Section 3.7: reflection, tint and darkening of what is below.
    void add_coat() {
        if (!(coat_ > 0)) return;
        Color through = unit(positive(s_.coat_color));
        if (!inside_) {
            const OrientedFrame frame =
                oriented(at_, out_, s_.geometry_coat_normal, s_.geometry_coat_tangent,
                         s_.coat_roughness_anisotropy);
            const LayerLobe coat(
                dielectric_reflection(stretched(s_.coat_roughness, s_.coat_roughness_anisotropy),
                                      s_.coat_ior),
                frame);
            through *= coat.leaves();
            coat.add_to(out_, kCoat, left_ * coat_, s_.caustics);
        }
        left_ *= lerp(kWhite, through, coat_);
    }

    void add_emission() {
        if (!(s_.emission_luminance > 0)) return;
        out_.emit(kEmission, left_ * (s_.emission_luminance * positive(s_.emission_color)));
    }

    void darken() {
        const float amount = coat_ * unit(s_.coat_darkening);
        if (amount > 0 && !inside_) left_ *= lerp(kWhite, darkening(), amount);
    }

    /// Section 3.5: reflectance face on and its tint at 82 degrees.
    void add_metal() {
        const float metalness = unit(s_.base_metalness);
        if (metalness > 0) {
            const Color facing = unit(positive(s_.base_weight) * positive(s_.base_color));
            const SchlickReflect metal(specular_alpha(), facing, kWhite,
                                       unit(positive(s_.specular_color)));
            const Color weight = left_ * (metalness * unit(s_.specular_weight));
            const std::uint8_t frame = specular_frame().index;
            out_.add(kMetal, metal, weight * (1 - film()), frame, s_.caustics);
            if (film() > 0)
                out_.add(kMetal, FilmedSchlickReflect(film_nm(), s_.thin_film_ior, metal),
                         weight * film(), frame, s_.caustics);
        }
        left_ *= 1 - metalness;
    }

    void add_specular() {
        if (is_black(left_)) return;
        const Color tint = positive(s_.specular_color);
        const bool body = transmission_ > 0 && !s_.geometry_thin_walled;
        const OrientedFrame frame = specular_frame();
        const LayerLobe gloss(
            dielectric_reflection(specular_alpha(), body ? index_.reflecting() : modulated_ior()),
            frame);
        if (!inside_ || s_.internal_reflections)
            gloss.add_to(out_, kSpecular, left_ * tint * (1 - film()), s_.caustics);
        Color through = gloss.leaves();
        if (film() > 0) {
            const LayerLobe filmed(FilmReflect(specular_alpha(), film_nm(), s_.thin_film_ior,
                                               Color::grey(modulated_ior()), kBlack),
                                   frame);
            filmed.add_to(out_, kSpecular, left_ * tint * film(), s_.caustics);
            through = lerp(through, filmed.leaves(), film());
        }
        left_ *= through;
    }

    void add_transmission() {
        if (transmission_ > 0 && !is_black(left_)) {
            const bool tints_inside = s_.transmission_depth > 0 && !s_.geometry_thin_walled;
            const Color weight =
                left_ *
                (transmission_ * (tints_inside ? kWhite : positive(s_.transmission_color)));
            const LobeModel model =
                s_.geometry_thin_walled
                    ? LobeModel(ThinTransmit::through_sheet(specular_alpha(), s_.specular_ior))
                    : LobeModel(DielectricTransmit(specular_alpha(), index_.refracting()));
            out_.add(kTransmission, model, weight, specular_frame().index, s_.caustics);
            if (!s_.caustics) out_.transmit_shadow(weight);
        }
        left_ *= 1 - transmission_;
    }

    void add_base() {
        if (is_black(left_)) return;
        const float subsurface = unit(s_.subsurface_weight);
        const Color reflectance = positive(s_.base_weight) * positive(s_.base_color);
        if (subsurface < 1 && !is_black(reflectance))
            out_.add(kDiffuse, DiffuseReflect(reflectance, s_.base_diffuse_roughness),
                     left_ * (1 - subsurface), base_.index, true);
        if (subsurface > 0) add_subsurface(left_ * subsurface);
    }

  private:
    /// What the body is filled with. Source: OpenPBR 1.1, section "Translucent base".
    [[nodiscard]] Medium interior() const {
        if (!(s_.transmission_depth > 0)) return {};
        return interior_medium(out_, kInterior, s_.transmission_color, s_.transmission_depth,
                               s_.transmission_scatter * (1 / s_.transmission_depth),
                               Phase(s_.transmission_scatter_anisotropy));
    }
    /// Section 3.6; of a thin wall half is reflected and half transmitted (3.9.1).
    void add_subsurface(Color weight) {
        const Color color = positive(s_.subsurface_color);
        const Color radius = positive(s_.subsurface_radius) * positive(s_.subsurface_radius_scale);
        const float g = s_.subsurface_scatter_anisotropy;
        if (s_.geometry_thin_walled) {
            const float forward = unit(0.5F * (1 + g));
            out_.add(kSubsurface, DiffuseTransmit(color, s_.base_diffuse_roughness),
                     weight * forward, base_.index, true);
            out_.add(kDiffuse, DiffuseReflect(color, s_.base_diffuse_roughness),
                     weight * (1 - forward), base_.index, true);
        } else {
            add_below_surface(out_, kSubsurface, color, radius, g, weight, base_.index,
                              s_.base_diffuse_roughness);
        }
    }

    /// Light that the base reflects and the coat sends back to it is absorbed there: (1 - K) / (1 - E K). Section 3.7.1.
    [[nodiscard]] Color darkening() const {
        const float ior = std::clamp(s_.coat_ior, 1.0F, 3.0F);
        const float facing = facing_reflectance(ior);
        // Seen from below: a rough base sends light to all sides, a smooth one back as it came.
        const float rough = 1 - (1 - facing) / square(ior);
        const float metalness = unit(s_.base_metalness), roughness = unit(s_.specular_roughness);
        const float k = lerp(facing, rough, lerp(1.0F, roughness, metalness));
        const float below = facing_reflectance(modulated_ior());
        const Color diffuse =
            lerp(unit(positive(s_.base_weight) * positive(s_.base_color)),
                 unit(positive(s_.subsurface_color)), unit(s_.subsurface_weight));
        const Color dielectric = lerp(diffuse, kWhite, transmission_) * (1 - below) +
                                 unit(positive(s_.specular_color)) * below;
        const Color metal =
            unit(positive(s_.base_weight) * positive(s_.base_color)) * unit(s_.specular_weight);
        const Color e = lerp(dielectric, metal, metalness);
        const auto one = [&](float albedo) { return (1 - k) / (1 - albedo * k); };
        return {one(e.r), one(e.g), one(e.b)};
    }

    [[nodiscard]] OrientedFrame specular_frame() {
        if (!(s_.specular_roughness_anisotropy > 0)) return base_;
        if (!has_specular_frame_)
            specular_ = oriented(at_, out_, s_.geometry_normal, s_.geometry_tangent,
                                 s_.specular_roughness_anisotropy);
        has_specular_frame_ = true;
        return specular_;
    }
    /// A rough coat blurs what is below it. Section 3.7.2.
    [[nodiscard]] GgxAlpha specular_alpha() const {
        const float own = unit(s_.specular_roughness), coat = unit(s_.coat_roughness);
        const float blurred =
            std::pow(std::min(1.0F, square(square(own)) + 2 * square(square(coat))), 0.25F);
        return stretched(lerp(own, blurred, coat_), s_.specular_roughness_anisotropy);
    }
    /// Part of the surface that has the film; a film lies on the outside of bodies. Section 3.4.4.
    [[nodiscard]] float film() const {
        const bool has_film = s_.thin_film_thickness > 0 && !inside_ && !s_.geometry_thin_walled;
        return has_film ? unit(s_.thin_film_weight) : 0;
    }
    [[nodiscard]] float film_nm() const { return 1000 * s_.thin_film_thickness; }
    /// specular_weight scales the reflectance face on. Section 3.4.2.
    [[nodiscard]] float modulated_ior() const {
        // Below a coat the interface is that between coat and base; turned over where that would reflect totally.
        float ior = lerp(s_.specular_ior, s_.specular_ior / std::max(s_.coat_ior, 1.0F), coat_);
        if (coat_ > 0 && ior < 1) ior = 1 / std::max(ior, 1e-3F);
        const float root =
            std::min(std::sqrt(positive(s_.specular_weight) * facing_reflectance(ior)), 0.999F);
        const float e = ior < 1 ? -root : root;
        return (1 + e) / (1 - e);
    }
    /// Section 3.6.1: the scale divides the Abbe number. 0: no dispersion.
    [[nodiscard]] static float abbe_number(const OpenPbrSurface& s) {
        const float scale = positive(s.transmission_dispersion_scale);
        return scale > 0 ? positive(s.transmission_dispersion_abbe_number) / scale : 0;
    }

    const OpenPbrSurface& s_;
    const ShadePoint& at_;
    ClosureSet& out_;
    Color left_;  ///< share of the light that the layers above let through
    float coat_, transmission_;
    bool inside_;  ///< of a transparent body
    BodyIndex index_;
    OrientedFrame base_, specular_{};
    bool has_specular_frame_ = false;
};

void OpenPbrSurface::eval(const ShadePoint& at, ClosureSet& out) const {
    const Color visible = Color::grey(unit(geometry_opacity));
    out.transparent(kWhite - visible);
    if (is_black(visible)) return;
    Layering layers(*this, at, out, visible);
    layers.add_fuzz();
    layers.add_coat();
    layers.add_emission();
    layers.darken();
    layers.add_metal();
    layers.add_specular();
    layers.add_transmission();
    layers.add_base();
}

void OpenPbrSurface::prepare(NodeContext& context) {
    if (!context.is_linked("geometry_normal")) geometry_normal = {};
    if (!context.is_linked("geometry_tangent")) geometry_tangent = {};
    if (!context.is_linked("geometry_coat_normal")) geometry_coat_normal = {};
    if (!context.is_linked("geometry_coat_tangent")) geometry_coat_tangent = {};
}

// Parameters --------------------------------------------------------------------------------------------------------

using S = OpenPbrSurface;

void describe_base(Describe<S>& d) {
    d.param("base_weight", &S::base_weight,
            "Weight of the diffuse base and of the metal's colour.")
        .range(0, 1);
    d.param("base_color", &S::base_color,
            "Reflectance of the diffuse base, or of the metal seen face on.")
        .range(0, 1);
    d.param("base_diffuse_roughness", &S::base_diffuse_roughness,
            "0: Lambert; up to 1: rougher, like clay.")
        .range(0, 1);
    d.param("base_metalness", &S::base_metalness, "Mix from a dielectric (0) to a metal (1).")
        .range(0, 1);
    d.param("specular_weight", &S::specular_weight,
            "Factor on the reflectance of the dielectric face on, and on the metal.")
        .range(0, 1);
    d.param("specular_color", &S::specular_color,
            "Tint of the reflection; of metals at 82 degrees.")
        .range(0, 1);
    d.param("specular_roughness", &S::specular_roughness,
            "0: a mirror. The width of the microfacets is its square.")
        .range(0, 1);
    d.param("specular_ior", &S::specular_ior, "Index of refraction.").range(1, 3);
    d.param("specular_roughness_anisotropy", &S::specular_roughness_anisotropy,
            "Stretches highlights across the tangent.")
        .range(0, 1);
}

void describe_interior(Describe<S>& d) {
    d.param("transmission_weight", &S::transmission_weight,
            "Mix from the diffuse base (0) to a clear body (1).")
        .range(0, 1);
    d.param("transmission_color", &S::transmission_color, "Tint of what is seen through the body.")
        .range(0, 1);
    d.param("transmission_depth", &S::transmission_depth,
            "Depth at which the interior has transmission_color; 0: tinted at the surface.")
        .unit("scene units");
    d.param("transmission_scatter", &S::transmission_scatter,
            "What of the light is scattered, not absorbed, within transmission_depth.");
    d.param("transmission_scatter_anisotropy", &S::transmission_scatter_anisotropy,
            "Mean cosine of that scattering: above 0 light goes on forward.")
        .range(-1, 1);
    d.param("transmission_dispersion_scale", &S::transmission_dispersion_scale,
            "How much the index depends on the wavelength; 0: not.")
        .range(0, 1);
    d.param("transmission_dispersion_abbe_number", &S::transmission_dispersion_abbe_number,
            "Abbe number at scale 1.")
        .range(9, 91);
    d.param("transmission_transmit_aovs", &S::transmission_transmit_aovs,
            "What is seen through the surface goes to its own AOVs, alpha and data layers.");
    d.param("subsurface_weight", &S::subsurface_weight,
            "Mix from diffuse reflection to subsurface scattering.")
        .range(0, 1);
    d.param("subsurface_color", &S::subsurface_color, "Reflectance of subsurface scattering.")
        .range(0, 1);
    d.param("subsurface_radius", &S::subsurface_radius, "Mean free path.").unit("scene units");
    d.param("subsurface_radius_scale", &S::subsurface_radius_scale,
            "Factor on subsurface_radius, a channel each.");
    d.param("subsurface_scatter_anisotropy", &S::subsurface_scatter_anisotropy,
            "Mean cosine of the scattering: above 0 light goes on forward.")
        .range(-1, 1);
}

void describe_layers(Describe<S>& d) {
    d.param("fuzz_weight", &S::fuzz_weight, "Weight of the glow of dust and fibres on top.")
        .range(0, 1);
    d.param("fuzz_color", &S::fuzz_color, "Tint of the fuzz.").range(0, 1);
    d.param("fuzz_roughness", &S::fuzz_roughness, "How far the fuzz spreads from the edge.")
        .range(0, 1);
    d.param("coat_weight", &S::coat_weight, "Weight of a clear layer.").range(0, 1);
    d.param("coat_color", &S::coat_color, "Tint of what is seen through the coat.").range(0, 1);
    d.param("coat_roughness", &S::coat_roughness, "Roughness of the coat; it blurs what is below.")
        .range(0, 1);
    d.param("coat_roughness_anisotropy", &S::coat_roughness_anisotropy,
            "Stretches highlights of the coat.")
        .range(0, 1);
    d.param("coat_ior", &S::coat_ior, "Index of refraction of the coat.").range(1, 3);
    d.param("coat_darkening", &S::coat_darkening,
            "How much light is lost that the coat sends back to the base.")
        .range(0, 1);
    d.param("thin_film_weight", &S::thin_film_weight, "Coverage by an iridescent film.")
        .range(0, 1);
    d.param("thin_film_thickness", &S::thin_film_thickness, "Thickness of the film.")
        .unit("micrometres")
        .range(0, 2);
    d.param("thin_film_ior", &S::thin_film_ior, "Index of refraction of the film.").range(1, 3);
    d.param("emission_luminance", &S::emission_luminance, "Weight of the emission.")
        .range(0, kInfinity);
    d.param("emission_color", &S::emission_color, "Radiance emitted, seen through coat and fuzz.");
}

void describe_geometry(Describe<S>& d) {
    d.param("geometry_opacity", &S::geometry_opacity,
            "Below 1, rays pass straight through for the rest.")
        .range(0, 1);
    d.param("geometry_thin_walled", &S::geometry_thin_walled,
            "The surface is a sheet without an interior.");
    d.param("geometry_normal", &S::geometry_normal,
            "Shading normal, world space; acts when linked.");
    d.param("geometry_tangent", &S::geometry_tangent,
            "Direction of anisotropy, world space; acts when linked.");
    d.param("geometry_coat_normal", &S::geometry_coat_normal,
            "Normal of the coat, world space; acts when linked.");
    d.param("geometry_coat_tangent", &S::geometry_coat_tangent,
            "Direction of the coat's anisotropy, world space; acts when linked.");
    d.param("dielectric_priority", &S::dielectric_priority,
            "Where clear bodies overlap, the one of higher priority is there; equals ignore each "
            "other.");
    d.param("caustics", &S::caustics, "Specular lobes are also seen by diffuse rays.");
    d.param("internal_reflections", &S::internal_reflections,
            "Rays inside of a clear body are reflected.");
    d.param("exit_to_background", &S::exit_to_background,
            "Rays past their depth limit see the background instead of black.");
}

NodeType OpenPbrSurface::describe() {
    Describe<S> d("openpbr_surface", NodeKind::Shader,
                  "The OpenPBR layered surface: fuzz, coat, metal, glass, skin or paint.");
    d.lobe(kDiffuse, EventKind::Reflection, EventLobe::Diffuse, "",
           "Diffuse reflection of the base.");
    d.lobe(kFuzz, EventKind::Reflection, EventLobe::Specular, "sheen", "Fuzz.");
    d.lobe(kSpecular, EventKind::Reflection, EventLobe::Specular, "",
           "Specular reflection of the base.");
    d.lobe(kMetal, EventKind::Reflection, EventLobe::Specular, "", "Reflection of metal.");
    d.lobe(kCoat, EventKind::Reflection, EventLobe::Specular, "coat", "Reflection of the coat.");
    d.lobe(kTransmission, EventKind::Transmission, EventLobe::Specular, "",
           "Refraction; straight through where thin-walled.");
    d.lobe_below_surface(kSubsurface,
                         "Subsurface scattering; diffuse transmission where thin-walled.");
    d.lobe(kEmission, EventKind::Object, EventLobe::None, "", "Emission.");
    d.lobe(kInterior, EventKind::Volume, EventLobe::None, "",
           "Scattering inside: transmission_scatter.");
    describe_base(d);
    describe_interior(d);
    describe_layers(d);
    describe_geometry(d);
    return d.done();
}

}  // namespace

NodeType node_openpbr_surface() { return OpenPbrSurface::describe(); }

}  // namespace lightsieve
