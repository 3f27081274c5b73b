// ambient_occlusion: how much of the surroundings is near.
#include "nodes/bump/bump_common.h"
#include "nodes/state/occlusion.h"

namespace lightsieve {
namespace {

struct AmbientOcclusion {
    std::int32_t samples = 3;
    float spread = 1, near_clip = 0, far_clip = 100, falloff = 0;
    Color black{0, 0, 0}, white{1, 1, 1};
    Vec3f normal;
    bool invert_normals = false;
    Name trace_set;
    bool inclusive = true, self_only = false;

    static NodeType describe();
    void prepare(NodeContext& context) {
        if (!context.is_linked("normal")) normal = {};
    }
    [[nodiscard]] Color eval(const ShadePoint& at) const;
};

NodeType AmbientOcclusion::describe() {
    using Node = AmbientOcclusion;
    Describe<Node> d("ambient_occlusion", NodeKind::Shader,
                     "White where a point sees far, black where something is near.");
    d.param("samples", &Node::samples, "Square root of the number of rays.").range(0, 32);
    d.param("spread", &Node::spread, "Angle around the normal; 1 is a half space.").range(0, 1);
    d.param("near_clip", &Node::near_clip, "What is nearer does not count.").unit("scene units");
    d.param("far_clip", &Node::far_clip, "What is farther does not count; 0: no end.")
        .unit("scene units");
    d.param("falloff", &Node::falloff,
            "How fast the effect falls with the distance: exp(-falloff * distance).");
    d.param("black", &Node::black, "Colour where everything is near.");
    d.param("white", &Node::white, "Colour where nothing is.");
    d.param("normal", &Node::normal, "Normal, world space; acts when linked.");
    d.param("invert_normals", &Node::invert_normals, "Looks into the surface, not out of it.");
    d.param("trace_set", &Node::trace_set, "Set of shapes that are met, or not met.");
    d.param("inclusive", &Node::inclusive, "Shapes of trace_set are met, else all but those.");
    d.param("self_only", &Node::self_only, "Only the shape itself is met.");
    return d.done();
}

Color AmbientOcclusion::eval(const ShadePoint& at) const {
    return lerp(
        white, black,
        occlusion(at, {samples, spread, near_clip, far_clip, falloff, shading_normal(at, normal),
                       invert_normals, trace_set, inclusive, self_only}));
}

}  // namespace

NodeType node_ambient_occlusion() { return AmbientOcclusion::describe(); }

}  // namespace lightsieve
