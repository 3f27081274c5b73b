// layer_shader: up to eight shaders, one blended over the other.
#include <array>
#include <string>

#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

constexpr std::size_t kLayers = 8;

struct LayerShader {
    std::array<bool, kLayers> enable{true};
    std::array<Name, kLayers> names;
    std::array<ShaderRef, kLayers> input;
    std::array<float, kLayers> mix{1, 1, 1, 1, 1, 1, 1, 1};

    static NodeType describe();
    void eval(const ShadePoint& at, ClosureSet& out) const {
        // From the top down: each layer has its part of what those above leave.
        float left = 1;
        for (std::size_t i = kLayers; i-- > 0 && left > 0;) {
            if (!enable[i]) continue;
            const float share = unit(mix[i]);
            add_scaled(input[i], Color::grey(left * share), at, out);
            left *= 1 - share;
        }
    }
};

NodeType LayerShader::describe() {
    Describe<LayerShader> d("layer_shader", NodeKind::Shader,
                            "Up to eight shaders, one blended over the other.");
    for (std::size_t i = 0; i < kLayers; ++i) {
        const std::string n = std::to_string(i + 1);
        d.part(
            "enable" + n, [=](LayerShader& p) -> bool& { return p.enable[i]; },
            "Whether layer " + n + " takes part.");
        d.part(
             "name" + n, [=](LayerShader& p) -> Name& { return p.names[i]; },
             "What people call layer " + n + ".")
            .ignored();
        d.part(
            "input" + n, [=](LayerShader& p) -> ShaderRef& { return p.input[i]; },
            "Shader of layer " + n + ".");
        d.part(
             "mix" + n, [=](LayerShader& p) -> float& { return p.mix[i]; },
             "Part of layer " + n + ".")
            .range(0, 1);
    }
    return d.done();
}

}  // namespace

NodeType node_layer_shader() { return LayerShader::describe(); }

}  // namespace lightsieve
