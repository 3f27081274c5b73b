// layer_rgba: up to eight colours, one over the other.
//
// Colours are not premultiplied: an operation without alpha covers what is below as far as the layer's alpha and mix go;
// those with alpha (in, out, atop, ...) find the whole colour, of which `mix` is taken.
#include <array>
#include <cmath>
#include <string>

#include "nodes/color/composite_ops.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

constexpr std::size_t kLayers = 8;

/// The operations of composite_ops(), without A and B, and "overwrite" after "overlay".
enum class LayerOperation : std::int32_t {};
std::vector<std::string> operation_names() {
    std::vector<std::string> out = composite_op_names();
    out.erase(out.begin(), out.begin() + 2);
    out.insert(std::find(out.begin(), out.end(), "phoenix"), "overwrite");
    return out;
}
/// Their numbers that are looked at.
constexpr std::int32_t kOver = 25, kOverwrite = 27;
enum class AlphaOperation : std::int32_t { Result, Preserve, Overwrite, Mask };

struct Layer {
    bool enable = false;
    Rgba input{{0, 0, 0}, 1};
    float mix = 1;
    LayerOperation operation{kOver};
    AlphaOperation alpha_operation = AlphaOperation::Result;
};

/// Whether an operation reads alphas, so that covering by alpha would count them twice.
bool reads_alpha(std::string_view name) {
    for (const char* with : {"atop", "cojoint_over", "disjoint_over", "in", "mask", "matte", "out",
                             "stencil", "under", "xor"})
        if (name == with) return true;
    return false;
}

/// One layer on what is below it.
Rgba put(const Layer& layer, const Rgba& below) {
    const auto number = static_cast<std::int32_t>(layer.operation);
    const bool whole = number == kOverwrite, over = number == kOver;
    const auto index = static_cast<std::size_t>(number + (number > kOverwrite ? 1 : 2));
    const CompositeOp& op = composite_ops()[std::min(index, composite_ops().size() - 1)];
    const bool alpha_inside = !whole && reads_alpha(op.name);
    const Rgba& f = layer.input;
    const float share = unit(layer.mix) * (whole || alpha_inside ? 1.0F : unit(f.a));
    Rgba out;
    for (int c = 0; c < 3; ++c) {
        const float blended =
            whole || over ? f.rgb[c] : op.channel(f.rgb[c], below.rgb[c], f.a, below.a);
        out.rgb[c] = lerp(below.rgb[c], blended, share);
    }
    switch (layer.alpha_operation) {
        case AlphaOperation::Result:
            if (alpha_inside)
                out.a = lerp(below.a, op.channel(f.a, below.a, f.a, below.a), share);
            else
                out.a = whole ? lerp(below.a, f.a, share) : share + below.a * (1 - share);
            break;
        case AlphaOperation::Preserve: out.a = below.a; break;
        case AlphaOperation::Overwrite: out.a = f.a; break;
        case AlphaOperation::Mask: out.a = below.a * f.a; break;
    }
    return out;
}

struct LayerRgba {
    std::array<Layer, kLayers> layers;
    std::array<Name, kLayers> names;
    bool clamp = false;

    LayerRgba() { layers[0].enable = true; }
    static NodeType describe();
    [[nodiscard]] Rgba eval(const ShadePoint&) const {
        Rgba below{kBlack, 0};
        for (const Layer& layer : layers)
            if (layer.enable) below = put(layer, below);
        if (clamp) below = {lightsieve::clamp(below.rgb, 0, 1), unit(below.a)};
        return below;
    }
};

NodeType LayerRgba::describe() {
    Describe<LayerRgba> d("layer_rgba", NodeKind::Shader,
                          "Up to eight colours, one over the other.");
    for (std::size_t i = 0; i < kLayers; ++i) {
        const std::string n = std::to_string(i + 1);
        const auto layer = [i](LayerRgba& node) -> Layer& { return node.layers[i]; };
        d.part(
            "enable" + n, [=](LayerRgba& p) -> bool& { return layer(p).enable; },
            "Whether layer " + n + " takes part.");
        d.part(
             "name" + n, [=](LayerRgba& p) -> Name& { return p.names[i]; },
             "What people call layer " + n + ".")
            .ignored();
        d.part(
            "input" + n, [=](LayerRgba& p) -> Rgba& { return layer(p).input; },
            "Colour and alpha of layer " + n + ".");
        d.part(
             "mix" + n, [=](LayerRgba& p) -> float& { return layer(p).mix; },
             "Opacity of layer " + n + ".")
            .range(0, 1);
        d.part(
             "operation" + n, [=](LayerRgba& p) -> LayerOperation& { return layer(p).operation; },
             "How layer " + n + " is put on those below.")
            .names(operation_names());
        d.part(
             "alpha_operation" + n,
             [=](LayerRgba& p) -> AlphaOperation& { return layer(p).alpha_operation; },
             "Alpha after layer " + n + ".")
            .names({"result", "preserve", "overwrite", "mask"});
    }
    d.param("clamp", &LayerRgba::clamp, "Keeps the result within 0 and 1.");
    return d.done();
}

}  // namespace

NodeType node_layer_rgba() { return LayerRgba::describe(); }

}  // namespace lightsieve
