// mix_shader: two shaders blended or added.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

enum class MixMode : std::int32_t { Blend, Add };

struct MixShader {
    float mix = 0.5F;
    MixMode mode = MixMode::Blend;
    bool add_transparency = false;
    ShaderRef shader1, shader2;

    static NodeType describe() {
        Describe<MixShader> d("mix_shader", NodeKind::Shader,
                              "Two shaders blended, or one added to the other.");
        d.param("mix", &MixShader::mix, "0: all shader1; 1: all shader2.").range(0, 1);
        d.param("mode", &MixShader::mode,
                "blend: each has its part; add: shader1 whole and the part `mix` of shader2.")
            .names({"blend", "add"});
        d.param("add_transparency", &MixShader::add_transparency,
                "With mode add: whether transparency is added too.")
            .pending();
        d.param("shader1", &MixShader::shader1, "The first shader.");
        d.param("shader2", &MixShader::shader2, "The second shader.");
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        const float share = unit(mix);
        add_scaled(shader1, Color::grey(mode == MixMode::Blend ? 1 - share : 1), at, out);
        add_scaled(shader2, Color::grey(share), at, out);
    }
};

}  // namespace

NodeType node_mix_shader() { return MixShader::describe(); }

}  // namespace lightsieve
