// shadow_matte: shows the shadows that fall on it, over a background, to be put over a photograph.
#include "bsdf/closure.h"
#include "nodes/shader/layering.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum Lobes : int { kBackground, kShadow, kDiffuse, kSpecular };
enum class Background : std::int32_t { Scene, Color };

struct ShadowMatteNode {
    Background background = Background::Scene;
    Color background_color{0, 0, 0};
    Color shadow_color{0, 0, 0};
    float shadow_opacity = 1, backlighting = 0;
    bool alpha_mask = true;
    Color diffuse_color{1, 1, 1};
    float diffuse_intensity = 0.7F;
    bool diffuse_use_background = true;
    bool indirect_diffuse_enable = false, indirect_specular_enable = false;
    Color specular_color{1, 1, 1};
    float specular_intensity = 1, specular_roughness = 0.1F, specular_IOR = 1.52F;
    Name aov_group, aov_shadow{"shadow"}, aov_shadow_diff{"shadow_diff"},
        aov_shadow_mask{"shadow_mask"};

    static NodeType describe();
    void prepare(NodeContext& context);
    void eval(const ShadePoint& at, ClosureSet& out) const;
};

void ShadowMatteNode::eval(const ShadePoint&, ClosureSet& out) const {
    const Color reflectance = positive(diffuse_color) * positive(diffuse_intensity);
    ShadowMatte matte;
    matte.sees_background = background == Background::Scene;
    matte.background = positive(background_color);
    matte.shadow_color = positive(shadow_color);
    matte.opacity = unit(shadow_opacity);
    matte.backlighting = unit(backlighting);
    matte.diffuse = reflectance;
    matte.alpha_is_mask = alpha_mask;
    out.show_shadows(kBackground, kShadow, matte);
    // The photograph has the light of the lamps already: only what is new in the scene is reflected.
    out.set_indirect({1, 1, false});
    if (indirect_specular_enable)
        out.add(kSpecular,
                dielectric_reflection(GgxAlpha::from_roughness(unit(specular_roughness)),
                                      specular_IOR),
                positive(specular_color) * positive(specular_intensity), 0, true);
    if (indirect_diffuse_enable) {
        const bool tinted = diffuse_use_background && background == Background::Color;
        out.add(kDiffuse, DiffuseReflect(tinted ? reflectance * matte.background : reflectance),
                kWhite, 0, true);
    }
}

void ShadowMatteNode::prepare(NodeContext& context) {
    if (indirect_diffuse_enable && diffuse_use_background && background == Background::Scene)
        context.diagnostics().warning(
            Code::ParamPending,
            "diffuse_use_background with the scene's background is not supported yet",
            context.where("indirect_diffuse_enable"),
            "set diffuse_color to the ground's colour and diffuse_use_background off");
}

using S = ShadowMatteNode;

void describe_shadow(Describe<S>& d) {
    d.param("background", &S::background, "What is seen where no shadow falls.")
        .names({"scene_background", "background_color"});
    d.param("background_color", &S::background_color, "Seen with background background_color.");
    d.param("shadow_color", &S::shadow_color, "Colour of the shadow.");
    d.param("shadow_opacity", &S::shadow_opacity,
            "How much of the background a full shadow hides.")
        .range(0, 1);
    d.param("backlighting", &S::backlighting, "Weight of light that falls on the far side.")
        .range(0, 1);
    d.param("alpha_mask", &S::alpha_mask, "Alpha is the shadow; off: the surface is opaque.");
    d.param("aov_group", &S::aov_group, "Group of lights for the AOVs.").pending();
    d.param("aov_shadow", &S::aov_shadow,
            "AOV of the missing part of the light, a channel each; another name than shadow is "
            "not read.")
        .pending();
    d.param("aov_shadow_diff", &S::aov_shadow_diff,
            "AOV of the missing diffuse light; another name than shadow_diff is not read.")
        .pending();
    d.param("aov_shadow_mask", &S::aov_shadow_mask,
            "AOV of the missing part of all light; another name than shadow_mask is not read.")
        .pending();
}

void describe_reflection(Describe<S>& d) {
    d.param("diffuse_color", &S::diffuse_color, "Diffuse reflectance for indirect light.")
        .range(0, 1);
    d.param("diffuse_intensity", &S::diffuse_intensity, "Factor on diffuse_color.").range(0, 1);
    d.param("diffuse_use_background", &S::diffuse_use_background,
            "The background tints the diffuse reflection.");
    d.param("indirect_diffuse_enable", &S::indirect_diffuse_enable,
            "Indirect light is reflected diffusely.");
    d.param("indirect_specular_enable", &S::indirect_specular_enable,
            "Things around are mirrored, lights are not.");
    d.param("specular_color", &S::specular_color, "Tint of the mirror image.").range(0, 1);
    d.param("specular_intensity", &S::specular_intensity, "Factor on specular_color.").range(0, 1);
    d.param("specular_roughness", &S::specular_roughness, "Blur of the mirror image.").range(0, 1);
    d.param("specular_IOR", &S::specular_IOR, "Index of refraction.").range(1, 3);
}

NodeType ShadowMatteNode::describe() {
    Describe<S> d("shadow_matte", NodeKind::Shader,
                  "A stand-in for the ground of a photograph: shows the shadows that fall on it.");
    d.lobe(kBackground, EventKind::Background, EventLobe::None, "", "What is seen behind.");
    d.lobe(kShadow, EventKind::Object, EventLobe::None, "", "The shadow's own colour.");
    d.lobe(kDiffuse, EventKind::Reflection, EventLobe::Diffuse, "",
           "Diffuse reflection of indirect light.");
    d.lobe(kSpecular, EventKind::Reflection, EventLobe::Specular, "",
           "Specular reflection of indirect light.");
    describe_shadow(d);
    describe_reflection(d);
    return d.done();
}

}  // namespace

NodeType node_shadow_matte() { return ShadowMatteNode::describe(); }

}  // namespace lightsieve
