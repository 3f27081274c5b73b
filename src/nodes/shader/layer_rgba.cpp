// layer_rgba: up to eight colours, one over the other.
//
// Colours are not premultiplied. The operations are those of picture editors; with alpha a of the layer, F above, B below:
// Porter and Duff 1984, "Compositing Digital Images", and the W3C's "Compositing and Blending Level 1" for the blend modes.
#include <cmath>

#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

enum class LayerOperation : std::int32_t {
    Overwrite,
    Over,
    Plus,
    Minus,
    Multiply,
    Divide,
    Average,
    Difference,
    Screen,
    Overlay,
    SoftLight,
    HardLight,
    Min,
    Max
};
std::vector<std::string> operation_names() {
    return {"overwrite",  "over",   "plus",    "minus",      "multiply",   "divide", "average",
            "difference", "screen", "overlay", "soft_light", "hard_light", "min",    "max"};
}
enum class AlphaOperation : std::int32_t { Result, Background, Foreground, Overwrite };

float overlay(float b, float f) { return b < 0.5F ? 2 * b * f : 1 - 2 * (1 - b) * (1 - f); }

float blend(LayerOperation operation, float b, float f) {
    switch (operation) {
        case LayerOperation::Overwrite:
        case LayerOperation::Over: return f;
        case LayerOperation::Plus: return b + f;
        case LayerOperation::Minus: return b - f;
        case LayerOperation::Multiply: return b * f;
        case LayerOperation::Divide: return f != 0 ? b / f : 0;
        case LayerOperation::Average: return 0.5F * (b + f);
        case LayerOperation::Difference: return std::abs(b - f);
        case LayerOperation::Screen: return 1 - (1 - b) * (1 - f);
        case LayerOperation::Overlay: return overlay(b, f);
        case LayerOperation::HardLight: return overlay(f, b);
        case LayerOperation::SoftLight: return (1 - 2 * f) * b * b + 2 * f * b;
        case LayerOperation::Min: return std::min(b, f);
        case LayerOperation::Max: return std::max(b, f);
    }
    return f;
}

/// One layer on what is below it.
Rgba put(const Rgba& layer, float mix, LayerOperation operation, AlphaOperation alpha,
         const Rgba& below) {
    // Overwrite takes the layer whole, alpha and all; the others cover as far as its alpha goes.
    const bool whole = operation == LayerOperation::Overwrite;
    const float share = unit(mix) * (whole ? 1.0F : unit(layer.a));
    Rgba out;
    for (int c = 0; c < 3; ++c)
        out.rgb[c] = lerp(below.rgb[c], blend(operation, below.rgb[c], layer.rgb[c]), share);
    switch (alpha) {
        case AlphaOperation::Result:
            out.a = whole ? lerp(below.a, layer.a, share) : share + below.a * (1 - share);
            break;
        case AlphaOperation::Background: out.a = below.a; break;
        case AlphaOperation::Foreground:
        case AlphaOperation::Overwrite: out.a = layer.a; break;
    }
    return out;
}

struct LayerRgba {
    bool enable1 = true;
    Rgba input1{{0, 0, 0}, 1};
    float mix1 = 1;
    LayerOperation operation1 = LayerOperation::Over;
    AlphaOperation alpha_operation1 = AlphaOperation::Result;
    bool enable2 = false;
    Rgba input2{{0, 0, 0}, 1};
    float mix2 = 1;
    LayerOperation operation2 = LayerOperation::Over;
    AlphaOperation alpha_operation2 = AlphaOperation::Result;
    bool enable3 = false;
    Rgba input3{{0, 0, 0}, 1};
    float mix3 = 1;
    LayerOperation operation3 = LayerOperation::Over;
    AlphaOperation alpha_operation3 = AlphaOperation::Result;
    bool enable4 = false;
    Rgba input4{{0, 0, 0}, 1};
    float mix4 = 1;
    LayerOperation operation4 = LayerOperation::Over;
    AlphaOperation alpha_operation4 = AlphaOperation::Result;
    bool enable5 = false;
    Rgba input5{{0, 0, 0}, 1};
    float mix5 = 1;
    LayerOperation operation5 = LayerOperation::Over;
    AlphaOperation alpha_operation5 = AlphaOperation::Result;
    bool enable6 = false;
    Rgba input6{{0, 0, 0}, 1};
    float mix6 = 1;
    LayerOperation operation6 = LayerOperation::Over;
    AlphaOperation alpha_operation6 = AlphaOperation::Result;
    bool enable7 = false;
    Rgba input7{{0, 0, 0}, 1};
    float mix7 = 1;
    LayerOperation operation7 = LayerOperation::Over;
    AlphaOperation alpha_operation7 = AlphaOperation::Result;
    bool enable8 = false;
    Rgba input8{{0, 0, 0}, 1};
    float mix8 = 1;
    LayerOperation operation8 = LayerOperation::Over;
    AlphaOperation alpha_operation8 = AlphaOperation::Result;
    bool clamp = false;

    static NodeType describe();
    [[nodiscard]] Rgba eval(const ShadePoint&) const {
        Rgba below{kBlack, 0};
        if (enable1) below = put(input1, mix1, operation1, alpha_operation1, below);
        if (enable2) below = put(input2, mix2, operation2, alpha_operation2, below);
        if (enable3) below = put(input3, mix3, operation3, alpha_operation3, below);
        if (enable4) below = put(input4, mix4, operation4, alpha_operation4, below);
        if (enable5) below = put(input5, mix5, operation5, alpha_operation5, below);
        if (enable6) below = put(input6, mix6, operation6, alpha_operation6, below);
        if (enable7) below = put(input7, mix7, operation7, alpha_operation7, below);
        if (enable8) below = put(input8, mix8, operation8, alpha_operation8, below);
        if (clamp) below = {lightsieve::clamp(below.rgb, 0, 1), unit(below.a)};
        return below;
    }
};

using S = LayerRgba;

NodeType LayerRgba::describe() {
    Describe<S> d("layer_rgba", NodeKind::Shader, "Up to eight colours, one over the other.");
    d.param("enable1", &S::enable1, "Whether layer 1 takes part.");
    d.param("input1", &S::input1, "Colour and alpha of layer 1.");
    d.param("mix1", &S::mix1, "Opacity of layer 1.").range(0, 1);
    d.param("operation1", &S::operation1, "How layer 1 is put on those below.")
        .names(operation_names());
    d.param("alpha_operation1", &S::alpha_operation1, "Alpha after layer 1.")
        .names({"result", "background", "foreground", "overwrite"});
    d.param("enable2", &S::enable2, "Whether layer 2 takes part.");
    d.param("input2", &S::input2, "Colour and alpha of layer 2.");
    d.param("mix2", &S::mix2, "Opacity of layer 2.").range(0, 1);
    d.param("operation2", &S::operation2, "How layer 2 is put on those below.")
        .names(operation_names());
    d.param("alpha_operation2", &S::alpha_operation2, "Alpha after layer 2.")
        .names({"result", "background", "foreground", "overwrite"});
    d.param("enable3", &S::enable3, "Whether layer 3 takes part.");
    d.param("input3", &S::input3, "Colour and alpha of layer 3.");
    d.param("mix3", &S::mix3, "Opacity of layer 3.").range(0, 1);
    d.param("operation3", &S::operation3, "How layer 3 is put on those below.")
        .names(operation_names());
    d.param("alpha_operation3", &S::alpha_operation3, "Alpha after layer 3.")
        .names({"result", "background", "foreground", "overwrite"});
    d.param("enable4", &S::enable4, "Whether layer 4 takes part.");
    d.param("input4", &S::input4, "Colour and alpha of layer 4.");
    d.param("mix4", &S::mix4, "Opacity of layer 4.").range(0, 1);
    d.param("operation4", &S::operation4, "How layer 4 is put on those below.")
        .names(operation_names());
    d.param("alpha_operation4", &S::alpha_operation4, "Alpha after layer 4.")
        .names({"result", "background", "foreground", "overwrite"});
    d.param("enable5", &S::enable5, "Whether layer 5 takes part.");
    d.param("input5", &S::input5, "Colour and alpha of layer 5.");
    d.param("mix5", &S::mix5, "Opacity of layer 5.").range(0, 1);
    d.param("operation5", &S::operation5, "How layer 5 is put on those below.")
        .names(operation_names());
    d.param("alpha_operation5", &S::alpha_operation5, "Alpha after layer 5.")
        .names({"result", "background", "foreground", "overwrite"});
    d.param("enable6", &S::enable6, "Whether layer 6 takes part.");
    d.param("input6", &S::input6, "Colour and alpha of layer 6.");
    d.param("mix6", &S::mix6, "Opacity of layer 6.").range(0, 1);
    d.param("operation6", &S::operation6, "How layer 6 is put on those below.")
        .names(operation_names());
    d.param("alpha_operation6", &S::alpha_operation6, "Alpha after layer 6.")
        .names({"result", "background", "foreground", "overwrite"});
    d.param("enable7", &S::enable7, "Whether layer 7 takes part.");
    d.param("input7", &S::input7, "Colour and alpha of layer 7.");
    d.param("mix7", &S::mix7, "Opacity of layer 7.").range(0, 1);
    d.param("operation7", &S::operation7, "How layer 7 is put on those below.")
        .names(operation_names());
    d.param("alpha_operation7", &S::alpha_operation7, "Alpha after layer 7.")
        .names({"result", "background", "foreground", "overwrite"});
    d.param("enable8", &S::enable8, "Whether layer 8 takes part.");
    d.param("input8", &S::input8, "Colour and alpha of layer 8.");
    d.param("mix8", &S::mix8, "Opacity of layer 8.").range(0, 1);
    d.param("operation8", &S::operation8, "How layer 8 is put on those below.")
        .names(operation_names());
    d.param("alpha_operation8", &S::alpha_operation8, "Alpha after layer 8.")
        .names({"result", "background", "foreground", "overwrite"});
    d.param("clamp", &S::clamp, "Keeps the result within 0 and 1.");
    return d.done();
}

}  // namespace

NodeType node_layer_rgba() { return LayerRgba::describe(); }

}  // namespace lightsieve
