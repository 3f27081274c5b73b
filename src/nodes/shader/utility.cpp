// utility: shows what a surface is made of: normals, coordinates, colours.
#include <fmt/format.h>

#include "bsdf/closure.h"
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum class ColorMode : std::int32_t {
    Color,
    Ng,
    Ns,
    N,
    Bary,
    Uv,
    U,
    V,
    Dpdu,
    Dpdv,
    P,
    Prims,
    UniformId,
    Wire,
    Polywire,
    Obj,
    EdgeLength,
    Floatgrid,
    ReflectLine,
    BadUvs,
    Nlights,
    Id,
    BumpDiff,
    PixelError
};
enum class ShadeMode : std::int32_t { NdotEye, Lambert, Flat, AmbOcc, Plastic, Metal };
enum class OverlayMode : std::int32_t { None, Wire, Polywire };

/// Names of ColorMode, in its order.
std::vector<std::string> color_modes() {
    return {"color",       "ng",      "ns",       "n",    "bary",       "uv",
            "u",           "v",       "dpdu",     "dpdv", "p",          "prims",
            "uniformid",   "wire",    "polywire", "obj",  "edgelength", "floatgrid",
            "reflectline", "bad_uvs", "nlights",  "id",   "bumpdiff",   "pixelerror"};
}
/// Names of ShadeMode, in its order.
std::vector<std::string> shade_modes() {
    return {"ndoteye", "lambert", "flat", "ambocc", "plastic", "metal"};
}

struct Utility {
    ColorMode color_mode = ColorMode::Color;
    ShadeMode shade_mode = ShadeMode::NdotEye;
    OverlayMode overlay_mode = OverlayMode::None;
    Color color{1, 1, 1};
    float ao_distance = 100, roughness = 0.2F;
    Vec3f normal{0, 0, 0};  ///< world space; acts only when linked

    static NodeType describe();
    void prepare(NodeContext& context);
    void eval(const ShadePoint& at, ClosureSet& out) const;
    /// The colour before shading.
    [[nodiscard]] Color shown(const ShadePoint& at) const;
    /// As a value: shaded with what the hit alone gives.
    [[nodiscard]] ShaderValue value(const ShadePoint& at) const;
};

NodeType Utility::describe() {
    Describe<Utility> d("utility", NodeKind::Shader,
                        "Shows normals, coordinates and other properties of surfaces.");
    d.param("color_mode", &Utility::color_mode, "What is shown.").names(color_modes());
    d.param("shade_mode", &Utility::shade_mode,
            "How it is lit: by the angle to the viewer, as a diffuse surface, not at all.")
        .names(shade_modes());
    d.param("overlay_mode", &Utility::overlay_mode, "Wires on top.")
        .names({"none", "wire", "polywire"})
        .pending();
    d.param("color", &Utility::color, "Colour for color_mode color.");
    d.param("ao_distance", &Utility::ao_distance,
            "Reach of ambient occlusion; acts with shade_mode ambocc.")
        .ignored();
    d.param("roughness", &Utility::roughness, "Roughness of shade modes plastic and metal.")
        .ignored();
    d.param("normal", &Utility::normal, "Shading normal, world space; acts when linked.");
    d.lobe(0, EventKind::Reflection, EventLobe::Diffuse, "",
           "Diffuse reflection of shade_mode lambert.");
    d.lobe(1, EventKind::Object, EventLobe::None, "", "The colour of the other shade modes.");
    // Linked to a parameter it is a colour, as the surface's shader it may need light: both functions.
    NodeType type = d.done();
    type.output = OutputType::Rgb;
    type.eval_value = [](const void* block, const ShadePoint& at) {
        return static_cast<const Utility*>(block)->value(at);
    };
    return type;
}

void Utility::prepare(NodeContext& context) {
    if (!context.is_linked("normal")) normal = {};
    const auto replace = [&](const char* param, const std::string& was, const char* by) {
        context.diagnostics().warning(
            Code::ParamPending,
            fmt::format("{} \"{}\" is not supported yet: shown as \"{}\"", param, was, by),
            context.where(param));
    };
    if (color_mode > ColorMode::P) {
        replace("color_mode", color_modes().at(static_cast<std::size_t>(color_mode)), "color");
        color_mode = ColorMode::Color;
    }
    if (shade_mode == ShadeMode::AmbOcc) {
        replace("shade_mode", "ambocc", "ndoteye");
        shade_mode = ShadeMode::NdotEye;
    } else if (shade_mode == ShadeMode::Plastic || shade_mode == ShadeMode::Metal) {
        replace("shade_mode", shade_modes().at(static_cast<std::size_t>(shade_mode)), "lambert");
        shade_mode = ShadeMode::Lambert;
    }
}

Color Utility::shown(const ShadePoint& at) const {
    const auto direction = [](Vec3f v) {
        return Color{0.5F + 0.5F * v.x, 0.5F + 0.5F * v.y, 0.5F + 0.5F * v.z};
    };
    switch (color_mode) {
        case ColorMode::Ng:
            return direction(at.entering ? at.geometric_normal : -at.geometric_normal);
        case ColorMode::Ns: return direction(at.normal);
        case ColorMode::N: return direction(shading_normal(at, normal));
        case ColorMode::Bary:
            return {at.barycentric.x, at.barycentric.y, 1 - at.barycentric.x - at.barycentric.y};
        case ColorMode::Uv: return {at.uv.x, at.uv.y, 0};
        case ColorMode::U: return Color::grey(at.uv.x);
        case ColorMode::V: return Color::grey(at.uv.y);
        case ColorMode::Dpdu: return direction(at.tangent);
        case ColorMode::Dpdv: return direction(cross(at.normal, at.tangent));
        case ColorMode::P: return {at.position.x, at.position.y, at.position.z};
        default: return color;
    }
}

ShaderValue Utility::value(const ShadePoint& at) const {
    const float facing =
        shade_mode == ShadeMode::NdotEye ? positive(dot(shading_normal(at, normal), at.wo)) : 1.0F;
    return {shown(at) * facing, 1};
}

void Utility::eval(const ShadePoint& at, ClosureSet& out) const {
    if (shade_mode != ShadeMode::Lambert) return out.emit(1, value(at).rgb);
    const Frame frame = Frame::from_z_x(shading_normal(at, normal), at.tangent);
    out.add(0, DiffuseReflect(positive(shown(at))), kWhite, out.add_frame(frame), true);
}

}  // namespace

NodeType node_utility() { return Utility::describe(); }

}  // namespace lightsieve
