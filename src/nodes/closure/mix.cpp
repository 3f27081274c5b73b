// mix: two closures side by side.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Mix {
    ShaderRef fg, bg;
    float mix = 0;

    static NodeType describe() {
        Describe<Mix> d("mix", NodeKind::Shader, "Two closures, each with a part of the surface.");
        d.param("fg", &Mix::fg, "Has the part `mix`.");
        d.param("bg", &Mix::bg, "Has the rest.");
        d.param("mix", &Mix::mix, "0: all bg; 1: all fg.").range(0, 1);
        return d.done();
    }

    [[nodiscard]] static bool reads_coordinates() { return false; }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        const float share = unit(mix);
        add_scaled(fg, Color::grey(share), at, out);
        add_scaled(bg, Color::grey(1 - share), at, out);
    }
};

}  // namespace

NodeType node_mix() { return Mix::describe(); }

}  // namespace lightsieve
