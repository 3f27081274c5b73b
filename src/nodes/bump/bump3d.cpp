// bump3d: a normal that makes the surface look as if a map had raised it, by the map's slope in space.
#include "nodes/bump/bump_common.h"

namespace lightsieve {
namespace {

struct Bump3d {
    Lazy<float> bump_map;
    float bump_height = 0.01F, epsilon = 0.001F;
    Vec3f normal;

    static NodeType describe() {
        Describe<Bump3d> d("bump3d", NodeKind::Shader,
                           "The normal of a surface that a map raises, by the map's slope in "
                           "space.");
        d.param("bump_map", &Bump3d::bump_map, "Height; the mean of a colour's channels.");
        d.param("bump_height", &Bump3d::bump_height, "Factor on the height.").unit("scene units");
        d.param("epsilon", &Bump3d::epsilon, "Distance over which the slope is measured.")
            .unit("scene units");
        d.param("normal", &Bump3d::normal, "Normal to start from, world space; acts when linked.");
        return d.done();
    }
    void prepare(NodeContext& context) {
        if (!context.is_linked("normal")) normal = {};
    }
    [[nodiscard]] Vec3f eval(const ShadePoint& at) const;
};

Vec3f Bump3d::eval(const ShadePoint& at) const {
    const Vec3f n = outward_normal(at, normal);
    if (bump_height == 0 || !bump_map.linked()) return n;
    // Far from the origin coordinates are too coarse for small steps, and steps below the footprint only alias.
    constexpr float kRounding = 1e-4F;
    const Vec3f p = at.position;
    const float far = std::fmax(std::abs(p.x), std::fmax(std::abs(p.y), std::abs(p.z)));
    const float step = std::fmax(std::fmax(epsilon, 0.5F * at.width), far * kRounding);
    if (!(step > 0)) return n;
    const float here = bump_map.at(at);
    const auto slope = [&](Vec3f axis) {
        ShadePoint beside = at;
        beside.position = p + axis * step;
        return (bump_map.at(beside) - here) / step;
    };
    const Vec3f gradient{slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})};
    return normalize(n - (gradient - n * dot(gradient, n)) * bump_height, n);
}

}  // namespace

NodeType node_bump3d() { return Bump3d::describe(); }

}  // namespace lightsieve
