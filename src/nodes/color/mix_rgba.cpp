// mix_rgba: one colour blended into another.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct MixRgba {
    Lazy<Rgba> input1{{{1, 1, 1}, 1}, {}}, input2{{{0, 0, 0}, 1}, {}};
    float mix = 0.5F;

    static NodeType describe() {
        Describe<MixRgba> d("mix_rgba", NodeKind::Shader, "Two colours blended.");
        d.param("input1", &MixRgba::input1, "The colour for mix 0.");
        d.param("input2", &MixRgba::input2, "The colour for mix 1.");
        d.param("mix", &MixRgba::mix, "Part of input2.").range(0, 1);
        return d.done();
    }
    [[nodiscard]] Rgba eval(const ShadePoint& at) const {
        if (mix == 0) return input1.at(at);
        if (mix == 1) return input2.at(at);
        const Rgba a = input1.at(at), b = input2.at(at);
        return {lerp(a.rgb, b.rgb, mix), lerp(a.a, b.a, mix)};
    }
};

}  // namespace

NodeType node_mix_rgba() { return MixRgba::describe(); }

}  // namespace lightsieve
