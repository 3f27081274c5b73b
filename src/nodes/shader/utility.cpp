// utility: shows what a surface is made of: normals, coordinates, colours.
#include "bsdf/closure.h"
#include "nodes/math/math_node.h"
#include "nodes/state/occlusion.h"
#include "nodes/state/wires.h"
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
/// Lobes, in the order of their description.
enum UtilityLobe : int { kDiffuse, kUnlit, kSpecular };
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
    [[nodiscard]] Color shown_of_mesh(const ShadePoint& at) const;
    [[nodiscard]] Color overlaid(const ShadePoint& at) const;
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
        .names({"none", "wire", "polywire"});
    d.param("color", &Utility::color, "Colour for color_mode color.");
    d.param("ao_distance", &Utility::ao_distance,
            "Reach of ambient occlusion for shade_mode ambocc.")
        .unit("scene units");
    d.param("roughness", &Utility::roughness, "Roughness of shade modes plastic and metal.")
        .range(0, 1);
    d.param("normal", &Utility::normal, "Shading normal, world space; acts when linked.");
    d.lobe(kDiffuse, EventKind::Reflection, EventLobe::Diffuse, "",
           "Diffuse reflection of shade modes lambert and plastic.");
    d.lobe(kUnlit, EventKind::Object, EventLobe::None, "",
           "The colour of shade modes without light.");
    d.lobe(kSpecular, EventKind::Reflection, EventLobe::Specular, "",
           "Highlights of shade modes plastic and metal.");
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
}

/// A colour that looks random; Arnold's own hash is private.
Color random_color(std::uint32_t id) {
    return {unit_from_bits(mixed_bits(id, 1)), unit_from_bits(mixed_bits(id, 2)),
            unit_from_bits(mixed_bits(id, 3))};
}

/// Mean length of the triangle's edges; 0 for shapes without.
float edge_length(const ShadePoint& at) {
    ShadeServices::Triangle t;
    if (at.services == nullptr || !at.services->triangle(at, t)) return 0;
    return (length(t.corners[1] - t.corners[0]) + length(t.corners[2] - t.corners[1]) +
            length(t.corners[0] - t.corners[2])) /
           3;
}

/// Colours for the modes about meshes, objects and the ray.
Color Utility::shown_of_mesh(const ShadePoint& at) const {
    const auto stripes = [](float x) { return 0.5F + 0.5F * std::sin(x); };
    switch (color_mode) {
        case ColorMode::Prims: return random_color(at.primitive);
        case ColorMode::UniformId: return random_color(at.face);
        case ColorMode::Obj:
        case ColorMode::Id: return random_color(at.shape_id);
        case ColorMode::Wire: return lerp(color, kBlack, line_cover(at, at.width, false));
        case ColorMode::Polywire: return lerp(color, kBlack, line_cover(at, at.width, true));
        case ColorMode::EdgeLength: return Color::grey(edge_length(at));
        case ColorMode::PixelError:
            return Color::grey(at.width > 0 ? edge_length(at) / at.width : 0);
        case ColorMode::Floatgrid: {
            const Vec3f p = at.position;
            const float cells = std::floor(p.x) + std::floor(p.y) + std::floor(p.z);
            return Color::grey(std::fmod(std::abs(cells), 2.0F) == 0 ? 1.0F : 0.0F);
        }
        case ColorMode::ReflectLine: {
            constexpr float kStripes = 30;  // as the lamps of a workshop lie on a car
            const Vec3f n = shading_normal(at, normal);
            return Color::grey(stripes(kStripes * (2 * dot(n, at.wo) * n.y - at.wo.y)));
        }
        case ColorMode::BadUvs: {
            const bool bad = !(length_squared(cross(at.dp_du, at.dp_dv)) > 0);
            return bad ? Color{1, 0, 1} : color;
        }
        case ColorMode::Nlights:
            return Color::grey(at.services != nullptr ? static_cast<float>(at.services->n_lights())
                                                      : 0);
        case ColorMode::BumpDiff:
            return Color::grey(
                std::acos(std::clamp(dot(shading_normal(at, normal), at.normal), -1.0F, 1.0F)) *
                (2 * kInvPi));
        default: return color;
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
        default: return shown_of_mesh(at);
    }
}

/// With the wires of overlay_mode on top.
Color Utility::overlaid(const ShadePoint& at) const {
    const Color c = shown(at);
    if (overlay_mode == OverlayMode::None) return c;
    return lerp(c, kBlack, line_cover(at, at.width, overlay_mode == OverlayMode::Polywire));
}

ShaderValue Utility::value(const ShadePoint& at) const {
    const Vec3f n = shading_normal(at, normal);
    float light = 1;
    if (shade_mode == ShadeMode::NdotEye) light = positive(dot(n, at.wo));
    if (shade_mode == ShadeMode::AmbOcc) {
        OcclusionSettings settings;
        settings.far_clip = ao_distance;
        settings.normal = n;
        light = 1 - occlusion(at, settings);
    }
    return {overlaid(at) * light, 1};
}

void Utility::eval(const ShadePoint& at, ClosureSet& out) const {
    const bool lit = shade_mode == ShadeMode::Lambert || shade_mode == ShadeMode::Plastic ||
                     shade_mode == ShadeMode::Metal;
    if (!lit) return out.emit(kUnlit, value(at).rgb);
    const std::uint8_t frame =
        out.add_frame(Frame::from_z_x(shading_normal(at, normal), at.tangent));
    const Color c = positive(overlaid(at));
    const GgxAlpha alpha{square(unit(roughness)), square(unit(roughness))};
    if (shade_mode == ShadeMode::Metal) {
        // Reflectance c at normal incidence without a colour of its own at the edge.
        return out.add(kSpecular, SchlickReflect(alpha, unit(c), kWhite), kWhite, frame, true);
    }
    Color below = kWhite;
    if (shade_mode == ShadeMode::Plastic) {
        const DielectricReflect shine(alpha, 1.5F);
        out.add(kSpecular, shine, kWhite, frame, true);
        below = kWhite - shine.albedo(out.local_wo(frame));
    }
    out.add(kDiffuse, DiffuseReflect(c), positive(below), frame, true);
}

}  // namespace

NodeType node_utility() { return Utility::describe(); }

}  // namespace lightsieve
