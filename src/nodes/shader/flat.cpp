// flat: one colour, unlit. Used as a surface's shader it is opaque and its colour is emission (event O).
#include "scene/describe.h"
#include "scene/shade_point.h"

namespace lightsieve {
namespace {

struct Flat {
    Color color{1, 1, 1};

    static NodeType describe() {
        Describe<Flat> d("flat", NodeKind::Shader, "One colour, unlit.");
        d.param("color", &Flat::color, "The colour.");
        d.lobe(0, EventKind::Object, EventLobe::None, "", "The colour.");
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint&) const { return color; }
};

}  // namespace

NodeType node_flat() { return Flat::describe(); }

}  // namespace lightsieve
