// What a node may ask of its surroundings while a scene is compiled.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/color.h"
#include "core/diagnostics.h"
#include "scene/node_type.h"
#include "scene/shade_point.h"
#include "scene/value.h"

namespace lightsieve {

class TextureCache;  // io/texture.h
struct Matte;        // scene/cryptomatte.h
struct PlacedShape;  // scene/cryptomatte.h

/// A colour parameter that a shader may drive; constant unless it is linked.
class ColorInput {
  public:
    ColorInput() = default;
    explicit ColorInput(Color constant) : constant_(constant) {}
    ColorInput(const void* program, ShaderValue (*eval)(const void* program, const ShadePoint& at))
        : program_(program), eval_(eval) {}
    [[nodiscard]] bool is_constant() const { return eval_ == nullptr; }
    /// The constant; black if the input is linked.
    [[nodiscard]] Color constant() const { return constant_; }
    [[nodiscard]] Color at(const ShadePoint& point) const {
        return eval_ == nullptr ? constant_ : eval_(program_, point).rgb;
    }

  private:
    Color constant_;
    const void* program_ = nullptr;
    ShaderValue (*eval_)(const void*, const ShadePoint&) = nullptr;
};

/// Given to prepare() and the make_ functions of a node.
class NodeContext {
  public:
    virtual ~NodeContext() = default;
    /// Where problems go. Errors stop the render before the first ray.
    [[nodiscard]] virtual Diagnostics& diagnostics() = 0;
    /// The place of a parameter's value in the scene file, or of the node if the parameter was not written.
    [[nodiscard]] virtual SourceSpan where(Name param) const = 0;
    /// The node's own name.
    [[nodiscard]] virtual Name node_name() const = 0;
    /// The RGB, RGBA or FLOAT parameter `param` of this node, following its link; of a NODE parameter, which must not be
    /// null, the colour of the shader that it names.
    [[nodiscard]] virtual ColorInput color_input(Name param) = 0;
    /// Whether a shader drives the parameter or one of its components.
    [[nodiscard]] virtual bool is_linked(Name param) const = 0;
    /// Every text that shapes of the scene carry as user data of that name.
    [[nodiscard]] virtual std::vector<Name> user_texts(Name /*attribute*/) { return {}; }
    /// Every text that the STRING parameter `param` may take: what it says, or what is linked to it may give.
    [[nodiscard]] virtual std::vector<Name> possible_texts(Name /*param*/) { return {}; }
    /// Keeps what prepare() makes for a block, which can only point to it, as long as the scene lives.
    virtual void keep(std::shared_ptr<const void> data) { kept_.push_back(std::move(data)); }
    /// options.frame.
    [[nodiscard]] virtual float frame_number() const { return 1; }
    /// The number under which shaders write values of an AOV of their own (RayState::written).
    [[nodiscard]] virtual std::uint32_t written_aov(Name /*aov*/) { return 0; }
    /// Announces a matte; the number under which its shader writes ids (RayState::mattes).
    [[nodiscard]] virtual std::uint32_t add_matte(const Matte& /*matte*/) { return 0; }
    /// Calls `body` for every shape of the scene that an aov_shader may meet. Instances that share names and user data
    /// count once.
    virtual void for_each_shape(const std::function<void(const PlacedShape&)>& /*body*/) {}
    /// The camera that the frame is about; null if the scene has none.
    [[nodiscard]] virtual const NodeInstance* camera() { return nullptr; }
    /// RenderOptions::rendering_space: what the command says; empty: as the scene says.
    [[nodiscard]] virtual std::string wanted_rendering_space() const { return {}; }
    /// What names of colour spaces mean, and which one light is computed in.
    [[nodiscard]] virtual const ColorSpaces& color_spaces() const {
        return ColorSpaces::built_in();
    }
    /// Textures of the render; the cache outlives the scene.
    [[nodiscard]] virtual TextureCache& textures() = 0;
    /// Full path of an asset after environment variables and search paths, or nothing if no such file exists.
    [[nodiscard]] virtual std::optional<std::string> find_asset(
        std::string_view filename) const = 0;
    /// options.ignore_missing_textures.
    [[nodiscard]] virtual bool ignore_missing_textures() const = 0;
    /// Frame size in pixels and pixel aspect ratio, for cameras.
    struct Frame {
        int width = 320, height = 240;
        float pixel_aspect_ratio = 1;
    };
    [[nodiscard]] virtual Frame frame() const = 0;
    /// Geometry of another shape node (mesh_light.mesh), in that shape's object space with its first matrix key; null with an error reported.
    [[nodiscard]] virtual std::unique_ptr<ShapeGeometry> geometry_of(NodeRef shape,
                                                                     Mat4f& world_from_object) = 0;

  private:
    std::vector<std::shared_ptr<const void>> kept_;
};

}  // namespace lightsieve
