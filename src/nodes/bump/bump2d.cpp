// bump2d: a normal that makes the surface look as if a map had raised it, by the map's slope along the texture coordinates.
#include "nodes/bump/bump_common.h"

namespace lightsieve {
namespace {

/// Least step along the texture coordinates [uv units].
constexpr float kLeastStep = 1e-4F;

struct Bump2d {
    Lazy<float> bump_map;
    float bump_height = 1;
    Vec3f normal;

    static NodeType describe() {
        Describe<Bump2d> d("bump2d", NodeKind::Shader,
                           "The normal of a surface that a map raises along its texture "
                           "coordinates.");
        d.param("bump_map", &Bump2d::bump_map, "Height; the mean of a colour's channels.");
        d.param("bump_height", &Bump2d::bump_height, "Factor on the height.").unit("scene units");
        d.param("normal", &Bump2d::normal, "Normal to start from, world space; acts when linked.");
        return d.done();
    }
    void prepare(NodeContext& context) {
        if (!context.is_linked("normal")) normal = {};
    }
    [[nodiscard]] Vec3f eval(const ShadePoint& at) const;
};

/// Source: Blinn 1978, "Simulation of Wrinkled Surfaces", with differences over half the ray's footprint.
Vec3f Bump2d::eval(const ShadePoint& at) const {
    const Vec3f n = outward_normal(at, normal);
    if (bump_height == 0 || !bump_map.linked()) return n;
    const Tangents t = tangents_across(at, n);
    const float step = std::fmax(0.5F * (t.by_uv ? at.uv_width : at.width), kLeastStep);
    const float here = bump_map.at(at);
    const auto slope = [&](Vec3f tangent, Vec2f uv) {
        ShadePoint beside = at;
        beside.position = at.position + tangent * step;
        if (t.by_uv) beside.uv = at.uv + uv * step;
        return (bump_map.at(beside) - here) * bump_height / step;
    };
    const Vec3f u = t.u + n * slope(t.u, {1, 0}), v = t.v + n * slope(t.v, {0, 1});
    const Vec3f raised = normalize(cross(u, v), n);
    return dot(raised, n) < 0 ? -raised : raised;
}

}  // namespace

NodeType node_bump2d() { return Bump2d::describe(); }

}  // namespace lightsieve
