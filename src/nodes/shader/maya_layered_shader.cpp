// maya_layered_shader: Maya's stack of up to sixteen shaders, the first on top.
//
// As shaders a layer is added to what its transparency lets through of those below; as textures it is also weakened by its own
// opacity. Layers without a transparency go by the opacity of their own shader; its closures bring that with them.
#include <array>
#include <string>

#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

constexpr std::size_t kLayers = 16;
enum class Compositing : std::int32_t { Shader, Texture };

template <class T>
constexpr std::array<T, kLayers> all(T value) {
    std::array<T, kLayers> out{};
    out.fill(value);
    return out;
}

struct MayaLayeredShader {
    Compositing compositingFlag = Compositing::Shader;
    std::uint32_t numInputs = 0;
    std::array<ShaderRef, kLayers> color;
    std::array<Color, kLayers> transparency = all(kWhite);
    std::array<bool, kLayers> useTransparency = all(true);

    static NodeType describe();
    void eval(const ShadePoint& at, ClosureSet& out) const;

  private:
    /// Adds the closures of layer `i`, but for what rays pass straight through, which is returned: below are other layers.
    [[nodiscard]] Color add_opaque_part(std::size_t i, Color factor, const ShadePoint& at,
                                        ClosureSet& out) const;
};

Color MayaLayeredShader::add_opaque_part(std::size_t i, Color factor, const ShadePoint& at,
                                         ClosureSet& out) const {
    const Color before = out.transparency(), scale = out.scale() * factor;
    add_scaled(color[i], factor, at, out);
    const Color passed = out.transparency() - before;
    Color clear;
    for (int c = 0; c < 3; ++c)
        clear[c] = scale[c] > 0 ? std::clamp(passed[c] / scale[c], 0.0F, 1.0F) : 0;
    out.transparent(clear * factor * -1);
    return clear;
}

void MayaLayeredShader::eval(const ShadePoint& at, ClosureSet& out) const {
    Color left = kWhite;
    const bool as_textures = compositingFlag == Compositing::Texture;
    for (std::size_t i = 0; i < std::min<std::size_t>(numInputs, kLayers) && !is_black(left);
         ++i) {
        if (!useTransparency[i]) {
            left *= add_opaque_part(i, left, at, out);
            continue;
        }
        const Color clear = unit(transparency[i]);
        add_scaled(color[i], as_textures ? left * (kWhite - clear) : left, at, out);
        left *= clear;
    }
    out.transparent(left);
}

NodeType MayaLayeredShader::describe() {
    using M = MayaLayeredShader;
    Describe<M> d("maya_layered_shader", NodeKind::Shader,
                  "Maya's stack of up to sixteen shaders, the first on top.");
    d.param("compositingFlag", &M::compositingFlag,
            "shader: layers are added to what is seen through them; texture: their own opacity "
            "also weakens them.")
        .names({"shader", "texture"});
    d.param("numInputs", &M::numInputs, "How many layers take part.");
    for (std::size_t i = 0; i < kLayers; ++i) {
        const std::string n = std::to_string(i);
        d.part(
            "color" + n, [=](M& p) -> ShaderRef& { return p.color[i]; },
            "Shader of layer " + n + ".");
        d.part(
             "transparency" + n, [=](M& p) -> Color& { return p.transparency[i]; },
             "What is seen through layer " + n + ".")
            .range(0, 1);
        d.part(
            "useTransparency" + n, [=](M& p) -> bool& { return p.useTransparency[i]; },
            "Off: the opacity of its shader counts.");
    }
    return d.done();
}

}  // namespace

NodeType node_maya_layered_shader() { return MayaLayeredShader::describe(); }

}  // namespace lightsieve
