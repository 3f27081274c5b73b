// toon: the surface of drawn pictures. What of it is light: diffuse base, specular reflection, transmission, sheen, emission.
//
// Lines along edges are made by contour_filter and not by the shader, so their parameters are read here and act there. Tone maps
// and stylized highlights would replace light by something that is none; they are reported, and the light is shown as it is.
#include <cmath>

#include "nodes/shader/layering.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum Lobes : int { kDiffuse, kSpecular, kTransmission, kSheen, kEmission };
enum class BumpMode : std::int32_t { Both, Diffuse, Specular };
enum class NormalType : std::int32_t { Shading, Smoothed, Geometric };

/// Of the lines along edges.
struct ToonEdges {
    Color mask_color{0, 0, 0}, edge_color{0, 0, 0}, edge_tonemap{1, 1, 1};
    float edge_opacity = 1, edge_width_scale = 1;
    Color silhouette_color{0, 0, 0}, silhouette_tonemap{1, 1, 1};
    float silhouette_opacity = 1, silhouette_width_scale = 1;
    std::int32_t priority = 0;
    bool enable_silhouette = false, ignore_throughput = false, enable = true;
    bool id_difference = true, shader_difference = true, user_id = false;
    float uv_threshold = 0, angle_threshold = 180;
    NormalType normal_type = NormalType::Shading;
};

struct Toon : ToonEdges {
    float base = 0.8F;
    Color base_color{1, 1, 1}, base_tonemap{1, 1, 1};
    float specular = 0;
    Color specular_color{1, 1, 1};
    float specular_roughness = 0, specular_anisotropy = 0, specular_rotation = 0;
    Color specular_tonemap{1, 1, 1};
    Name lights;
    Color highlight_color{1, 1, 1};
    float highlight_size = 0.5F;
    Name aov_highlight{"highlight"}, rim_light;
    Color rim_light_color{0, 0, 0};
    float rim_light_width = 1, rim_light_tint = 0;
    Name aov_rim_light{"rim_light"}, aov_prefix;
    float transmission = 0;
    Color transmission_color{1, 1, 1};
    float transmission_roughness = 0, transmission_anisotropy = 0, transmission_rotation = 0;
    float sheen = 0;
    Color sheen_color{1, 1, 1};
    float sheen_roughness = 0.3F;
    float emission = 0;
    Color emission_color{1, 1, 1};
    float IOR = 1.52F;
    Vec3f normal{0, 0, 0}, tangent{0, 0, 0};  ///< world space; act only when linked
    float indirect_diffuse = 0, indirect_specular = 1;
    BumpMode bump_mode = BumpMode::Both;
    bool energy_conserving = true;

    static NodeType describe();
    void prepare(NodeContext& context) {
        if (!context.is_linked("normal")) normal = {};
        if (!context.is_linked("tangent")) tangent = {};
    }
    void eval(const ShadePoint& at, ClosureSet& out) const;

  private:
    [[nodiscard]] OrientedFrame specular_frame(const ShadePoint& at, ClosureSet& out,
                                               float anisotropy, float rotation) const {
        return oriented(at, out, bump_mode == BumpMode::Diffuse ? Vec3f{} : normal, tangent,
                        anisotropy, rotation);
    }
    void add_specular(const ShadePoint& at, ClosureSet& out, float eta, Color& left) const;
    void add_transmission(const ShadePoint& at, ClosureSet& out, float eta, Color& left) const;
};

void Toon::add_specular(const ShadePoint& at, ClosureSet& out, float eta, Color& left) const {
    const Color weight = positive(specular) * positive(specular_color);
    if (is_black(weight)) return;
    const LayerLobe gloss(
        dielectric_reflection(
            GgxAlpha::from_roughness(unit(specular_roughness), specular_anisotropy), eta),
        specular_frame(at, out, specular_anisotropy, specular_rotation));
    gloss.add_to(out, kSpecular, weight, false);
    if (energy_conserving) left *= gloss.leaves(weight);
}

void Toon::add_transmission(const ShadePoint& at, ClosureSet& out, float eta, Color& left) const {
    const float share = unit(transmission);
    const OrientedFrame frame =
        specular_frame(at, out, transmission_anisotropy, transmission_rotation);
    const Color weight = left * (share * positive(transmission_color));
    const GgxAlpha alpha =
        GgxAlpha::from_roughness(unit(transmission_roughness), transmission_anisotropy);
    out.add(kTransmission, DielectricTransmit(alpha, eta), weight, frame.index, false);
    out.transmit_shadow(weight);
    left *= 1 - share;
}

void Toon::eval(const ShadePoint& at, ClosureSet& out) const {
    out.set_indirect({positive(indirect_diffuse), positive(indirect_specular)});
    Color left = kWhite;
    const BodyIndex index(IOR, 0, at);
    const bool is_clear = transmission > 0;
    add_specular(at, out, is_clear ? index.reflecting() : IOR, left);
    if (is_clear) {
        out.set_interior({Medium{}, index.inside()});
        add_transmission(at, out, index.refracting(), left);
    }
    const OrientedFrame frame =
        oriented(at, out, bump_mode == BumpMode::Specular ? Vec3f{} : normal);
    if (const float weight = unit(sheen); weight > 0) {
        const LayerLobe fibres(SheenReflect(sheen_roughness), frame);
        fibres.add_to(out, kSheen, left * (weight * positive(sheen_color)), true);
        if (energy_conserving) left *= fibres.leaves(Color::grey(weight));
    }
    out.add(kDiffuse, DiffuseReflect(positive(base) * positive(base_color), 0), left, frame.index,
            true);
    if (emission > 0) out.emit(kEmission, emission * positive(emission_color));
}

using T = Toon;

void describe_edges(Describe<T>& d) {
    const auto line = [&](const char* name, auto member, const char* doc) {
        d.param(name, member, doc).ignored();
    };
    line("mask_color", &T::mask_color, "Where its colour changes there is a line.");
    line("edge_color", &T::edge_color, "Colour of lines; they act with contour_filter.");
    line("edge_tonemap", &T::edge_tonemap, "Ramp for the colour of lines.");
    line("edge_opacity", &T::edge_opacity, "Opacity of lines.");
    line("edge_width_scale", &T::edge_width_scale, "Factor on the filter's width of lines.");
    line("silhouette_color", &T::silhouette_color, "Colour of outlines.");
    line("silhouette_tonemap", &T::silhouette_tonemap, "Ramp for the colour of outlines.");
    line("silhouette_opacity", &T::silhouette_opacity, "Opacity of outlines.");
    line("silhouette_width_scale", &T::silhouette_width_scale, "Factor on their width.");
    line("priority", &T::priority, "Whose line is drawn where two surfaces meet.");
    line("enable_silhouette", &T::enable_silhouette, "Outlines have a look of their own.");
    line("ignore_throughput", &T::ignore_throughput, "Lines seen in mirrors keep their colour.");
    line("enable", &T::enable, "Whether there are lines.");
    line("id_difference", &T::id_difference, "Lines where the shape changes.");
    line("shader_difference", &T::shader_difference, "Lines where the shader changes.");
    line("user_id", &T::user_id, "Lines where toon_id changes.");
    line("uv_threshold", &T::uv_threshold, "Lines where uv change by more.");
    line("angle_threshold", &T::angle_threshold, "Lines where the normal turns by more.");
    d.param("normal_type", &T::normal_type, "Which normal that is.")
        .names({"shading normal", "smoothed normal", "geometric normal"})
        .ignored();
}

void describe_style(Describe<T>& d) {
    for (const auto& [name, member] : {std::pair{"base_tonemap", &T::base_tonemap},
                                       std::pair{"specular_tonemap", &T::specular_tonemap}})
        d.param(name, member, "Ramp that replaces shades; they are shown as they are.").pending();
    d.param("lights", &T::lights, "Lights that make stylized highlights; there are none here.")
        .pending();
    d.param("rim_light", &T::rim_light, "Light that makes a rim; there is none here.").pending();
    d.param("highlight_color", &T::highlight_color, "Acts with lights.").ignored();
    d.param("highlight_size", &T::highlight_size, "Acts with lights.").ignored();
    d.param("aov_highlight", &T::aov_highlight, "Acts with lights.").ignored();
    d.param("rim_light_color", &T::rim_light_color, "Acts with rim_light.").ignored();
    d.param("rim_light_width", &T::rim_light_width, "Acts with rim_light.").ignored();
    d.param("rim_light_tint", &T::rim_light_tint, "Acts with rim_light.").ignored();
    d.param("aov_rim_light", &T::aov_rim_light, "Acts with rim_light.").ignored();
    d.param("aov_prefix", &T::aov_prefix, "Of AOVs beside those of light; there are none.")
        .ignored();
}

void describe_light(Describe<T>& d) {
    d.param("base", &T::base, "Weight of the diffuse base.").range(0, 1);
    d.param("base_color", &T::base_color, "Reflectance of the diffuse base.").range(0, 1);
    d.param("specular", &T::specular, "Weight of the specular reflection.").range(0, 1);
    d.param("specular_color", &T::specular_color, "Its tint.").range(0, 1);
    d.param("specular_roughness", &T::specular_roughness, "Width of the highlights.").range(0, 1);
    d.param("specular_anisotropy", &T::specular_anisotropy, "0: even; up to 1: drawn out.")
        .range(0, 1);
    d.param("specular_rotation", &T::specular_rotation, "Turns drawn-out highlights; 1: once.")
        .range(0, 1);
    d.param("transmission", &T::transmission, "Mix from the base (0) to a clear body (1).")
        .range(0, 1);
    d.param("transmission_color", &T::transmission_color, "Its tint.").range(0, 1);
    d.param("transmission_roughness", &T::transmission_roughness, "Blur of what is seen through.")
        .range(0, 1);
    d.param("transmission_anisotropy", &T::transmission_anisotropy, "0: even; up to 1: drawn out.")
        .range(0, 1);
    d.param("transmission_rotation", &T::transmission_rotation, "Turns a drawn-out blur.")
        .range(0, 1);
    d.param("sheen", &T::sheen, "Weight of the glow of cloth.").range(0, 1);
    d.param("sheen_color", &T::sheen_color, "Its tint.").range(0, 1);
    d.param("sheen_roughness", &T::sheen_roughness, "How far it spreads from the edge.")
        .range(0, 1);
    d.param("emission", &T::emission, "Weight of the emission.").range(0, kInfinity);
    d.param("emission_color", &T::emission_color, "Radiance emitted.");
    d.param("IOR", &T::IOR, "Index of refraction.").range(1, 3);
    d.param("normal", &T::normal, "Shading normal, world space; acts when linked.");
    d.param("tangent", &T::tangent, "Direction of anisotropy, world space; acts when linked.");
    d.param("indirect_diffuse", &T::indirect_diffuse, "Factor on indirect diffuse light.")
        .range(0, 1);
    d.param("indirect_specular", &T::indirect_specular, "Factor on indirect reflections.")
        .range(0, 1);
    d.param("bump_mode", &T::bump_mode, "What `normal` acts on.")
        .names({"both", "diffuse", "specular"});
    d.param("energy_conserving", &T::energy_conserving,
            "What is reflected above is missing below.");
}

NodeType Toon::describe() {
    Describe<T> d("toon", NodeKind::Shader,
                  "The surface of drawn pictures, as far as it is light.");
    d.lobe(kDiffuse, EventKind::Reflection, EventLobe::Diffuse, "", "Diffuse reflection.");
    d.lobe(kSpecular, EventKind::Reflection, EventLobe::Specular, "", "Specular reflection.");
    d.lobe(kTransmission, EventKind::Transmission, EventLobe::Specular, "", "Refraction.");
    d.lobe(kSheen, EventKind::Reflection, EventLobe::Specular, "sheen", "Sheen.");
    d.lobe(kEmission, EventKind::Object, EventLobe::None, "", "Emission.");
    describe_light(d);
    describe_style(d);
    describe_edges(d);
    return d.done();
}

}  // namespace

NodeType node_toon() { return Toon::describe(); }

}  // namespace lightsieve
