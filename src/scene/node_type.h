// What a node is: parameters with defaults and documentation, lobes, and the functions that make it work.
//
// A `NodeType` is filled by `Describe<T>` (scene/describe.h) from a plain struct T whose member initialisers are the
// defaults. Parsing, type checks, "did you mean", `lightsieve nodes NAME` and per-node tests all read it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/event.h"
#include "core/name.h"
#include "scene/value.h"

namespace lightsieve {

class Camera;           // scene/camera.h
class ColorSpaces;      // core/color.h
class ClosureSet;       // bsdf/closure.h
class Driver;           // scene/driver.h
class Imager;           // scene/imager.h
class Light;            // scene/light.h
class LightFilter;      // scene/light_filter.h
class PixelFilter;      // scene/pixel_filter.h
class NodeContext;      // scene/node_context.h
class OperatorContext;  // scene/operator_context.h
struct LightCommon;     // scene/light.h
struct LightPlace;      // scene/light_filter.h
struct ShadePoint;      // scene/shade_point.h
struct ShapeCommon;     // scene/shape.h
struct ShapeGeometry;

enum class NodeKind : std::uint8_t {
    Options,
    Camera,
    Shape,
    Light,
    Shader,
    Filter,
    Driver,
    LightFilter,
    Operator,
    ColorManager,
    Imager
};
[[nodiscard]] std::string_view kind_text(NodeKind kind);

/// What a shader gives when another parameter links to it.
enum class OutputType : std::uint8_t { None, Float, Vector, Rgb, Rgba, Closure, String, Matrix };

/// One parameter of a node type.
struct ParamInfo {
    Name name;
    ParamType type{};
    bool is_array = false;
    std::size_t offset = 0;       ///< bytes from the start of the block
    std::size_t lazy_offset = 0;  ///< of a Lazy parameter's LazyLink; 0: the parameter is plain
    std::string doc;              ///< one line
    std::string unit;             ///< e.g. "deg", "scene units"; empty if none
    std::optional<float> low,
        high;  ///< sensible range; values outside are clamped with a warning where `hard`
    bool hard_range = false;               ///< values outside make no sense (negative roughness)
    std::vector<std::string> enumerators;  ///< for Enum, in the order of their values
    bool ignored =
        false;  ///< accepted without effect, because it only steers Arnold's own sampling
    bool pending =
        false;  ///< accepted; a value other than the default gets a warning: not supported yet
};

/// One lobe that a shader can produce, with the event that it makes.
struct LobeInfo {
    int index = 0;  ///< position in NodeType::lobes; what `ClosureSet::add` is given
    EventKind kind = EventKind::Reflection;
    EventLobe lobe = EventLobe::Diffuse;
    std::string label;  ///< e.g. "coat"; empty if none
    std::string doc;    ///< one line
    /// Its light walks below the surface, unless the shader's thin_walled is on.
    bool below_surface = false;
};

/// Up to four floats: the result of a value shader, whatever its type. Float: r = g = b; vectors: r, g, b = x, y, z.
using ShaderValue = Rgba;

struct NodeType {
    Name name;
    NodeKind kind{};
    std::string doc;
    std::vector<ParamInfo> params;
    std::vector<LobeInfo> lobes;
    OutputType output = OutputType::None;
    /// The shader asks for the type of the ray: shares of a path that came by other types cannot go on as one ray.
    bool reads_ray_type = false;
    /// The shader says what fills a volume.
    bool fills_volumes = false;
    /// Whether a shader with these parameters looks at uv, their derivatives or the tangent; null: it may.
    bool (*reads_coordinates)(const void* block) = nullptr;

    std::size_t block_size = 0, block_align = 1;
    std::vector<std::byte> default_block;  ///< the bytes of a default constructed parameter struct

    // The functions that a node kind has; null where it does not apply. `block` always points to the parameter struct.
    void (*eval_closure)(const void* block, const ShadePoint& at, ClosureSet& out) = nullptr;
    ShaderValue (*eval_value)(const void* block, const ShadePoint& at) = nullptr;
    Name (*eval_text)(const void* block, const ShadePoint& at) = nullptr;     ///< output String
    Mat4f (*eval_matrix)(const void* block, const ShadePoint& at) = nullptr;  ///< output Matrix
    /// Output String: every text that eval_text may ever give in this scene, so that files can be opened before rendering.
    std::vector<Name> (*possible_texts)(const void* block, NodeContext& context) = nullptr;
    /// Called once before rendering: loads what the node needs, reports what is wrong. May change the block.
    void (*prepare)(void* block, NodeContext& context) = nullptr;
    std::unique_ptr<Light> (*make_light)(const void* block, NodeContext& context) = nullptr;
    std::unique_ptr<LightFilter> (*make_light_filter)(const void* block, NodeContext& context,
                                                      const LightPlace& place) = nullptr;
    std::unique_ptr<ShapeGeometry> (*make_geometry)(const void* block,
                                                    NodeContext& context) = nullptr;
    std::unique_ptr<Camera> (*make_camera)(const void* block, NodeContext& context) = nullptr;
    std::unique_ptr<PixelFilter> (*make_filter)(const void* block, NodeContext& context) = nullptr;
    std::unique_ptr<Driver> (*make_driver)(const void* block, NodeContext& context) = nullptr;
    /// Null: it is switched off, or was reported.
    std::unique_ptr<Imager> (*make_imager)(const void* block, NodeContext& context) = nullptr;
    std::shared_ptr<const ColorSpaces> (*make_color_spaces)(const void* block,
                                                            NodeContext& context) = nullptr;
    void (*edit_scene)(const void* block, OperatorContext& context) = nullptr;
    const ShapeCommon* (*shape_common)(const void* block) = nullptr;
    const LightCommon* (*light_common)(const void* block) = nullptr;

    /// The parameter of that name, or null.
    [[nodiscard]] const ParamInfo* find(Name param) const;
};

}  // namespace lightsieve
