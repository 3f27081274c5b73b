// switch_shader: one of twenty shaders, by number.
#include <array>
#include <string>

#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

constexpr std::size_t kInputs = 20;

struct SwitchShader {
    std::int32_t index = 0;
    std::array<ShaderRef, kInputs> input;

    static NodeType describe();
    void eval(const ShadePoint& at, ClosureSet& out) const {
        constexpr auto kLast = static_cast<std::int32_t>(kInputs) - 1;
        input[static_cast<std::size_t>(std::clamp(index, 0, kLast))].closures(at, out);
    }
};

NodeType SwitchShader::describe() {
    Describe<SwitchShader> d("switch_shader", NodeKind::Shader,
                             "One of twenty shaders, by number.");
    d.param("index", &SwitchShader::index, "Number of the input that is used.").range(0, 19);
    for (std::size_t i = 0; i < kInputs; ++i)
        d.part(
            "input" + std::to_string(i), [=](SwitchShader& p) -> ShaderRef& { return p.input[i]; },
            "Shader for index " + std::to_string(i) + ".");
    return d.done();
}

}  // namespace

NodeType node_switch_shader() { return SwitchShader::describe(); }

}  // namespace lightsieve
