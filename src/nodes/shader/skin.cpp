// skin: Arnold's surface for skin before standard_surface. Light scatters below it at three depths, under two specular
// reflections, the sheen above the other.
//
// Reflections are weighted by Schlick's curve of the angle of view, as the shader was published. Its profiles of scattering were cubic
// ones; here light walks (bsdf/subsurface.h), each depth with its own colour and mean free path.
#include <array>

#include "nodes/shader/layering.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum Lobes : int { kSubsurface, kSpecular, kSheen };

struct Skin {
    float sss_weight = 1;
    Color shallow_scatter_color{1, 0.909F, 0.769F};
    float shallow_scatter_weight = 0.5F, shallow_scatter_radius = 0.15F;
    Color mid_scatter_color{0.949F, 0.714F, 0.56F};
    float mid_scatter_weight = 0.25F, mid_scatter_radius = 0.25F;
    Color deep_scatter_color{0.7F, 0.1F, 0.1F};
    float deep_scatter_weight = 1, deep_scatter_radius = 0.6F;
    Color specular_color{1, 1, 1};
    float specular_weight = 0.8F, specular_roughness = 0.5F, specular_ior = 1.44F;
    Color sheen_color{1, 1, 1};
    float sheen_weight = 0, sheen_roughness = 0.35F, sheen_ior = 1.44F;
    float global_sss_radius_multiplier = 1;
    bool specular_in_secondary_rays = false, fresnel_affect_sss = true;
    Name aov_specular{"specular"}, aov_sheen{"sheen"}, aov_sss{"sss"},
        aov_direct_sss{"direct_sss"}, aov_indirect_sss{"indirect_sss"};
    float opacity = 1;
    Color opacity_color{1, 1, 1};
    Vec3f normal{0, 0, 0};  ///< world space; acts only when linked

    static NodeType describe();
    void prepare(NodeContext& context) {
        if (!context.is_linked("normal")) normal = {};
    }
    void eval(const ShadePoint& at, ClosureSet& out) const;
};

void Skin::eval(const ShadePoint& at, ClosureSet& out) const {
    const Color visible = unit(unit(opacity) * unit(opacity_color));
    out.transparent(kWhite - visible);
    if (is_black(visible)) return;
    const OrientedFrame frame = oriented(at, out, normal);
    float below = 1;
    const auto reflect = [&](int lobe, float weight, Color tint, float roughness, float ior) {
        if (!(weight > 0)) return;
        const float facing = square((ior - 1) / (ior + 1));
        const LayerLobe gloss(
            SchlickReflect(GgxAlpha::from_roughness(unit(roughness)),
                           Color::grey(std::isfinite(facing) ? facing : 1), kWhite),
            frame);
        gloss.add_to(out, lobe, visible * positive(tint) * (below * weight),
                     specular_in_secondary_rays);
        below *= gloss.leaves(Color::grey(weight)).g;
    };
    reflect(kSheen, sheen_weight, sheen_color, sheen_roughness, sheen_ior);
    reflect(kSpecular, specular_weight, specular_color, specular_roughness, specular_ior);
    const float share = positive(sss_weight) * (fresnel_affect_sss ? below : 1);
    const auto scatter = [&](Color color, float weight, float radius) {
        if (share > 0 && weight > 0)
            add_below_surface(out, kSubsurface, positive(color),
                              Color::grey(positive(radius * global_sss_radius_multiplier)), 0,
                              visible * (share * weight), frame.index);
    };
    scatter(shallow_scatter_color, shallow_scatter_weight, shallow_scatter_radius);
    scatter(mid_scatter_color, mid_scatter_weight, mid_scatter_radius);
    scatter(deep_scatter_color, deep_scatter_weight, deep_scatter_radius);
}

using S = Skin;

void describe_layers(Describe<S>& d) {
    struct Layer {
        const char* name;
        Color S::* color;
        float S::* weight;
        float S::* radius;
    };
    for (const Layer& layer :
         {Layer{"shallow", &S::shallow_scatter_color, &S::shallow_scatter_weight,
                &S::shallow_scatter_radius},
          Layer{"mid", &S::mid_scatter_color, &S::mid_scatter_weight, &S::mid_scatter_radius},
          Layer{"deep", &S::deep_scatter_color, &S::deep_scatter_weight,
                &S::deep_scatter_radius}}) {
        const std::string name = std::string(layer.name) + "_scatter_";
        d.param((name + "color").c_str(), layer.color, "Reflectance of this depth.").range(0, 1);
        d.param((name + "weight").c_str(), layer.weight, "Weight of this depth.").range(0, 1);
        d.param((name + "radius").c_str(), layer.radius, "Mean free path at this depth.")
            .unit("scene units")
            .range(0, kInfinity);
    }
}

void describe_reflections(Describe<S>& d) {
    d.param("specular_color", &S::specular_color, "Tint of the reflection.").range(0, 1);
    d.param("specular_weight", &S::specular_weight, "Weight of the reflection.").range(0, 1);
    d.param("specular_roughness", &S::specular_roughness, "Width of its highlights.").range(0, 1);
    d.param("specular_ior", &S::specular_ior, "Index of refraction, for its strength.")
        .range(1, 3);
    d.param("sheen_color", &S::sheen_color, "Tint of the reflection above it.").range(0, 1);
    d.param("sheen_weight", &S::sheen_weight, "Weight of the reflection above it.").range(0, 1);
    d.param("sheen_roughness", &S::sheen_roughness, "Width of its highlights.").range(0, 1);
    d.param("sheen_ior", &S::sheen_ior, "Index of refraction, for its strength.").range(1, 3);
    d.param("specular_in_secondary_rays", &S::specular_in_secondary_rays,
            "Rays that were scattered diffusely see the reflections, too.");
    d.param("fresnel_affect_sss", &S::fresnel_affect_sss,
            "What is reflected is missing below the surface.");
}

NodeType Skin::describe() {
    Describe<S> d("skin", NodeKind::Shader,
                  "Arnold's skin before standard_surface: three depths of scattering below two "
                  "reflections.");
    d.lobe_below_surface(kSubsurface, "Subsurface scattering.");
    d.lobe(kSpecular, EventKind::Reflection, EventLobe::Specular, "", "Reflection.");
    d.lobe(kSheen, EventKind::Reflection, EventLobe::Specular, "sheen", "The reflection above.");
    d.param("sss_weight", &S::sss_weight, "Weight of all that scatters below.").range(0, 1);
    describe_layers(d);
    d.param("global_sss_radius_multiplier", &S::global_sss_radius_multiplier,
            "Factor on the mean free paths.")
        .range(0, kInfinity);
    describe_reflections(d);
    d.param("opacity", &S::opacity, "Below 1, rays pass straight through for the rest.")
        .range(0, 1);
    d.param("opacity_color", &S::opacity_color, "Factor on the opacity.").range(0, 1);
    d.param("normal", &S::normal, "Shading normal, world space; acts when linked.");
    for (const auto& [name, member] :
         {std::pair{"aov_specular", &S::aov_specular}, std::pair{"aov_sheen", &S::aov_sheen},
          std::pair{"aov_sss", &S::aov_sss}, std::pair{"aov_direct_sss", &S::aov_direct_sss},
          std::pair{"aov_indirect_sss", &S::aov_indirect_sss}})
        d.param(name, member, "AOVs are those of light path expressions.").ignored();
    return d.done();
}

}  // namespace

NodeType node_skin() { return Skin::describe(); }

}  // namespace lightsieve
