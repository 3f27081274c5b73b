// layer: one closure on top of another.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Layer {
    ShaderRef top, base;

    static NodeType describe() {
        Describe<Layer> d("layer", NodeKind::Shader,
                          "A closure on top of another, which gets what the top lets through.");
        d.param("top", &Layer::top, "The upper closure.");
        d.param("base", &Layer::base, "Gets what `top` neither reflects nor transmits.");
        return d.done();
    }

    [[nodiscard]] static bool reads_coordinates() { return false; }
    /// top + base * (1 - E), E the directional albedo of the top.
    void eval(const ShadePoint& at, ClosureSet& out) const {
        const Color scale = out.scale();
        const std::size_t first = out.closures().size();
        top.closures(at, out);
        Color left = scale;
        for (std::size_t i = first; i < out.closures().size(); ++i)
            left = left - out.albedo(i);
        out.set_scale(positive(left));
        base.closures(at, out);
        out.set_scale(scale);
    }
};

}  // namespace

NodeType node_layer() { return Layer::describe(); }

}  // namespace lightsieve
