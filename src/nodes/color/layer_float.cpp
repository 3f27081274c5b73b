// layer_float: up to eight numbers, one blended over the other.
#include <array>
#include <string>

#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

constexpr std::size_t kLayers = 8;

struct LayerFloat {
    std::array<bool, kLayers> enable{true};
    std::array<Name, kLayers> names;
    std::array<float, kLayers> input{}, mix{1, 1, 1, 1, 1, 1, 1, 1};

    static NodeType describe();
    [[nodiscard]] float eval(const ShadePoint&) const {
        float out = 0;
        for (std::size_t i = 0; i < kLayers; ++i)
            if (enable[i]) out = lerp(out, input[i], unit(mix[i]));
        return out;
    }
};

NodeType LayerFloat::describe() {
    Describe<LayerFloat> d("layer_float", NodeKind::Shader,
                           "Up to eight numbers, one blended over the other.");
    for (std::size_t i = 0; i < kLayers; ++i) {
        const std::string n = std::to_string(i + 1);
        d.part(
            "enable" + n, [=](LayerFloat& p) -> bool& { return p.enable[i]; },
            "Whether layer " + n + " takes part.");
        d.part(
             "name" + n, [=](LayerFloat& p) -> Name& { return p.names[i]; },
             "What people call layer " + n + ".")
            .ignored();
        d.part(
            "input" + n, [=](LayerFloat& p) -> float& { return p.input[i]; },
            "Number of layer " + n + ".");
        d.part(
             "mix" + n, [=](LayerFloat& p) -> float& { return p.mix[i]; },
             "Part of layer " + n + ".")
            .range(0, 1);
    }
    return d.done();
}

}  // namespace

NodeType node_layer_float() { return LayerFloat::describe(); }

}  // namespace lightsieve
