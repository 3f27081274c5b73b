// surface: a whole material: scattering, light of its own and holes.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct SurfaceNode {
    ShaderRef bsdf, edf;
    float opacity = 1;

    static NodeType describe() {
        Describe<SurfaceNode> d("surface", NodeKind::Shader,
                                "A material: how it scatters, what it emits, where it has holes.");
        d.param("bsdf", &SurfaceNode::bsdf, "How light is scattered.");
        d.param("edf", &SurfaceNode::edf, "Light of its own.");
        d.param("opacity", &SurfaceNode::opacity,
                "Below 1, rays pass straight through for the rest.")
            .range(0, 1);
        return d.done();
    }

    [[nodiscard]] static bool reads_coordinates() { return false; }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        const Color visible = Color::grey(unit(opacity));
        out.transparent(kWhite - visible);
        add_scaled(bsdf, visible, at, out);
        add_scaled(edf, visible, at, out);
    }
};

}  // namespace

NodeType node_surface() { return SurfaceNode::describe(); }

}  // namespace lightsieve
