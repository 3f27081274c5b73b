// car_paint: clear coat, tinted specular layer, metallic flakes and a diffuse base.
//
// From the top: coat, specular reflection, a pigment that tints what is below, flakes, diffuse base. Flakes lie in the cells
// of a grid over space or uv: a cell has one or not, each with a normal of its own. Arnold's pattern of flakes is
// not public, so ours has its density and size and is another one.
#include <algorithm>
#include <cmath>

#include "bsdf/closure.h"
#include "nodes/shader/layering.h"
#include "nodes/texture/coord_space.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum Lobes : int { kDiffuse, kSpecular, kFlakes, kCoat };
/// Flakes are added up to this many layers; each needs a frame of its own in the closure set.
constexpr std::int32_t kMaxFlakeLayers = 3;

struct CarPaint {
    float base = 0.8F;
    Color base_color{1, 0, 0};
    float base_roughness = 0.5F;
    float specular = 1;
    Color specular_color{1, 1, 1}, specular_flip_flop{1, 1, 1}, specular_light_facing{1, 1, 1};
    float specular_falloff = 1, specular_roughness = 0.05F, specular_IOR = 1.52F;
    Color transmission_color{1, 1, 1};
    Color flake_color{1, 1, 1}, flake_flip_flop{1, 1, 1}, flake_light_facing{1, 1, 1};
    float flake_falloff = 1, flake_roughness = 0.4F, flake_IOR = 100, flake_scale = 0.001F,
          flake_density = 0;
    std::int32_t flake_layers = 1;
    float flake_normal_randomize = 0.5F;
    CoordSpace flake_coord_space = CoordSpace::Pref;
    Name pref_name{"Pref"};
    float coat = 1;
    Color coat_color{1, 1, 1};
    float coat_roughness = 0, coat_IOR = 1.5F;
    Vec3f coat_normal{0, 0, 0};  ///< world space; acts only when linked

    static NodeType describe();
    void prepare(NodeContext& context);
    void eval(const ShadePoint& at, ClosureSet& out) const;

  private:
    void add_coat(const ShadePoint& at, ClosureSet& out, Color& left) const;
    void add_flakes(const ShadePoint& at, ClosureSet& out, Color& left) const;
};

/// Four random numbers of a cell. Source: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg4d.
struct CellRandom {
    std::array<std::uint32_t, 4> v;
    CellRandom(Vec3f cell, std::uint32_t layer) {
        const auto whole = [](float x) {
            constexpr float kLargest = 1e9F;
            return static_cast<std::uint32_t>(
                static_cast<std::int32_t>(std::clamp(std::floor(x), -kLargest, kLargest)));
        };
        v = {whole(cell.x), whole(cell.y), whole(cell.z), layer};
        for (std::uint32_t& x : v)
            x = x * 1664525U + 1013904223U;
        const auto stir = [this] {
            v[0] += v[1] * v[3], v[1] += v[2] * v[0], v[2] += v[0] * v[1], v[3] += v[1] * v[2];
        };
        stir();
        for (std::uint32_t& x : v)
            x ^= x >> 16U;
        stir();
    }
    [[nodiscard]] float operator[](std::size_t i) const {
        return static_cast<float>(v[i] >> 8U) * 0x1p-24F;
    }
};

void CarPaint::add_coat(const ShadePoint& at, ClosureSet& out, Color& left) const {
    const float weight = unit(coat);
    if (!(weight > 0)) return;
    const LayerLobe varnish(
        dielectric_reflection(GgxAlpha::from_roughness(unit(coat_roughness)), coat_IOR),
        oriented(at, out, coat_normal));
    varnish.add_to(out, kCoat, left * weight, true);
    left *= lerp(kWhite, unit(coat_color) * varnish.leaves(), weight);
}

void CarPaint::add_flakes(const ShadePoint& at, ClosureSet& out, Color& left) const {
    const float density = unit(flake_density);
    if (!(density > 0) || !(flake_scale > 0)) return;
    SolidPlace space;
    space.coord_space = flake_coord_space;
    space.pref_name = pref_name;
    const Vec3f place = space.place(at) * (1 / flake_scale);
    const std::int32_t layers = std::clamp(flake_layers, 0, kMaxFlakeLayers);
    for (std::int32_t layer = 0; layer < layers; ++layer) {
        const CellRandom random(place, static_cast<std::uint32_t>(layer));
        if (random[0] >= density) continue;
        // Leans by up to 45 degrees from the surface, to any side.
        const float angle = 2 * kPi * random[1];
        const float lean = unit(flake_normal_randomize) * std::sqrt(random[2]);
        const Frame around = Frame::from_z(at.normal);
        const Vec3f normal = normalize(
            at.normal + (around.x * std::cos(angle) + around.y * std::sin(angle)) * lean);
        const OrientedFrame frame = oriented(at, out, normal);
        const LayerLobe flake(
            dielectric_reflection(GgxAlpha::from_roughness(unit(flake_roughness)), flake_IOR),
            frame);
        const Color tint = unit(flake_color) * lerp(unit(flake_flip_flop), kWhite, frame.wo.z);
        flake.add_to(out, kFlakes, left * tint, true);
        left *= flake.leaves();
    }
}

void CarPaint::eval(const ShadePoint& at, ClosureSet& out) const {
    Color left = kWhite;
    add_coat(at, out, left);
    if (const Color weight = unit(specular) * unit(specular_color); !is_black(weight)) {
        const OrientedFrame frame{0, out.local_wo(0)};
        const LayerLobe gloss(
            dielectric_reflection(GgxAlpha::from_roughness(unit(specular_roughness)),
                                  specular_IOR),
            frame);
        const Color tinted = weight * lerp(unit(specular_flip_flop), kWhite, frame.wo.z);
        gloss.add_to(out, kSpecular, left * tinted, true);
        left *= gloss.leaves(weight);
    }
    left *= unit(transmission_color);
    add_flakes(at, out, left);
    out.add(kDiffuse, rough_diffuse(unit(base) * unit(base_color), base_roughness), left);
}

void CarPaint::prepare(NodeContext& context) {
    if (!context.is_linked("coat_normal")) coat_normal = {};
}

using C = CarPaint;

void describe_paint(Describe<C>& d) {
    d.param("base", &C::base, "Weight of the diffuse base.").range(0, 1);
    d.param("base_color", &C::base_color, "Reflectance of the diffuse base.").range(0, 1);
    d.param("base_roughness", &C::base_roughness, "0: Lambert; up to 1: rougher.").range(0, 1);
    d.param("specular", &C::specular, "Weight of the specular layer.").range(0, 1);
    d.param("specular_color", &C::specular_color, "Tint of the specular layer.").range(0, 1);
    d.param("specular_flip_flop", &C::specular_flip_flop,
            "Another tint of it toward the edge, as the eye sees it.")
        .range(0, 1);
    d.param("specular_light_facing", &C::specular_light_facing,
            "Another tint of it where the surface faces the light.")
        .pending();
    d.param("specular_falloff", &C::specular_falloff,
            "How fast that tint fades; acts with specular_light_facing.")
        .ignored();
    d.param("specular_roughness", &C::specular_roughness, "Roughness of the specular layer.")
        .range(0, 1);
    d.param("specular_IOR", &C::specular_IOR, "Index of refraction of the specular layer.")
        .range(1, 3);
    d.param("transmission_color", &C::transmission_color,
            "Pigment of the specular layer: tints what is below.")
        .range(0, 1);
    d.param("coat", &C::coat, "Weight of the clear coat.").range(0, 1);
    d.param("coat_color", &C::coat_color, "Tint of what is seen through the coat.").range(0, 1);
    d.param("coat_roughness", &C::coat_roughness, "Roughness of the coat.").range(0, 1);
    d.param("coat_IOR", &C::coat_IOR, "Index of refraction of the coat.").range(1, 3);
    d.param("coat_normal", &C::coat_normal, "Normal of the coat, world space; acts when linked.");
}

void describe_flakes(Describe<C>& d) {
    d.param("flake_color", &C::flake_color, "Tint of the flakes.").range(0, 1);
    d.param("flake_flip_flop", &C::flake_flip_flop, "Another tint of them toward the edge.")
        .range(0, 1);
    d.param("flake_light_facing", &C::flake_light_facing,
            "Another tint of them where the surface faces the light.")
        .pending();
    d.param("flake_falloff", &C::flake_falloff,
            "How fast that tint fades; acts with flake_light_facing.")
        .ignored();
    d.param("flake_roughness", &C::flake_roughness, "Roughness of the flakes.").range(0, 1);
    d.param("flake_IOR", &C::flake_IOR, "Index of refraction of the flakes; metal: 100.")
        .range(1, 100);
    d.param("flake_scale", &C::flake_scale, "Size of a flake.").unit("scene or uv units");
    d.param("flake_density", &C::flake_density,
            "Part of the surface that a layer of flakes covers.")
        .range(0, 1);
    d.param("flake_layers", &C::flake_layers, "Layers of flakes, at most three.").range(0, 3);
    d.param("flake_normal_randomize", &C::flake_normal_randomize, "How far flakes lean.")
        .range(0, 1);
    d.param("flake_coord_space", &C::flake_coord_space, "In which space the flakes lie.")
        .names({"world", "object", "Pref", "uv"});
    d.param("pref_name", &C::pref_name, "User data with the points at rest, for Pref.");
}

NodeType CarPaint::describe() {
    Describe<C> d("car_paint", NodeKind::Shader,
                  "Car paint: clear coat, specular layer, flakes, diffuse base.");
    d.lobe(kDiffuse, EventKind::Reflection, EventLobe::Diffuse, "",
           "Diffuse reflection of the base.");
    d.lobe(kSpecular, EventKind::Reflection, EventLobe::Specular, "",
           "Reflection of the specular layer.");
    d.lobe(kFlakes, EventKind::Reflection, EventLobe::Specular, "", "Reflection of the flakes.");
    d.lobe(kCoat, EventKind::Reflection, EventLobe::Specular, "coat", "Reflection of the coat.");
    describe_paint(d);
    describe_flakes(d);
    return d.done();
}

}  // namespace

NodeType node_car_paint() { return CarPaint::describe(); }

}  // namespace lightsieve
