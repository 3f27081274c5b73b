// What is wanted: outputs, their expressions and types, which driver, camera and filter they go through.
//
// Joins two layers that do not know each other: the scene's option strings and the engine's names and expressions.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/name.h"
#include "lpe/builtins.h"
#include "lpe/light_groups.h"
#include "lpe/program.h"
#include "render/render.h"
#include "scene/camera.h"
#include "scene/cryptomatte.h"
#include "scene/driver.h"
#include "scene/pixel_filter.h"

namespace lightsieve {

class NodeInstance;
class SceneGraph;

/// Where a layer's values come from.
enum class LayerSource : std::uint8_t {
    Beauty,            ///< the accumulator of the beauty; with A if the type is RGBA
    Expression,        ///< a light path expression
    Depth,             ///< Z: distance along the viewing axis; 0 where nothing was hit
    Normal,            ///< N: shading normal, world space
    Position,          ///< P: world space
    Alpha,             ///< A
    Opacity,           ///< opacity of the first hit
    VolumeOpacity,     ///< 1 - transmittance of media before surfaces
    Shadow,            ///< of shadow_matte: how much light is missing, a channel each
    ShadowDifference,  ///< of shadow_matte: the light that is missing
    ShadowMask,        ///< of shadow_matte: how much light is missing in all
    Id,                ///< ID: the shape's id or a hash of its name
    Uv,                ///< uv
    Pref,              ///< Pref: the point before it was deformed
    Motion,            ///< motionvector: way over the picture while the shutter is open [pixels]
    RayCount,          ///< raycount: rays that the pixel took
    CpuTime,           ///< cputime: what it took [microseconds]
    InverseDensity,    ///< AA_inv_density: one over the number of camera samples
    ClampLoss,         ///< clamp_loss: what clamps took away
    Unclamped,         ///< unclamped: the beauty with it
    Written,           ///< what shaders write (aov_write_rgb)
    Matte,             ///< two ids of a matte and what they cover
    MattePreview,      ///< a matte in colours
    Black,             ///< an expression with an error, under abort_on_error off
};

/// Whether the layer's values are sums of light.
[[nodiscard]] constexpr bool is_light(LayerSource source) {
    return source == LayerSource::Beauty || source == LayerSource::Expression ||
           source == LayerSource::ClampLoss || source == LayerSource::Unclamped ||
           source == LayerSource::Black;
}

/// Names of the AOVs that are no light path expressions.
[[nodiscard]] std::vector<std::string> data_aov_names();

/// Channels of a layer of an AOV type.
[[nodiscard]] std::size_t n_channels_of(std::string_view aov_type);

/// One layer of one file.
struct PlannedLayer {
    ImageLayer info;
    LayerSource source = LayerSource::Beauty;
    std::uint32_t aov =
        0;  ///< for Expression: index of the request; for Written and mattes: its number
    std::uint32_t rank = 0;  ///< for Matte: of the first of the two ids
    std::uint32_t view = 0;  ///< filter view
    std::uint32_t pass = 0;
    std::uint32_t driver = 0;
    lpe::Expr expr;  ///< for Expression and Beauty: to prove partitions
    lpe::GroupSelect select = lpe::GroupSelect::All;
    bool imaged = false;  ///< imagers change what is written: it adds up to nothing
};

/// A pixel filter that layers use.
struct FilterView {
    const NodeInstance* node = nullptr;  ///< null: the default gaussian
    std::unique_ptr<PixelFilter> filter;
    float integral = 1;      ///< of eval over its support, to compare densities
    bool is_signed = false;  ///< has negative lobes
};

/// Layers that are rendered with the same camera rays.
struct Pass {
    const NodeInstance* camera_node = nullptr;
    std::unique_ptr<Camera> camera;
    std::uint32_t sampling_view = 0;   ///< its filter places the samples
    std::vector<std::uint32_t> views;  ///< all filters of its layers; the sampling one first
};

struct PlannedDriver {
    const NodeInstance* node = nullptr;  ///< null: made for a scene without outputs
    std::unique_ptr<Driver> driver;
    std::vector<std::uint32_t> layers;  ///< indices into AovPlan::layers, in file order
};

struct AovPlan {
    std::vector<PlannedLayer> layers;
    std::vector<lpe::AovRequest> requests;
    std::vector<FilterView> views;
    std::vector<Pass> passes;
    std::vector<PlannedDriver> drivers;
    std::optional<lpe::Program> program;
    bool wants_probes = false;  ///< some expression can take an albedo probe
    bool wants_beauty = false;
    std::optional<std::size_t> adaptive_layer;  ///< whose noise asks for samples; else the beauty
    bool wants_mattes = false;                  ///< some layer shows one
    bool wants_clamps = false;                  ///< some layer shows what clamps took away
    bool wants_cost = false;                    ///< some layer shows rays or time
    bool wants_pref = false;                    ///< some layer shows Pref
    bool wants_motion = false;                  ///< some layer shows motionvector
    bool wants_deep = false;                    ///< some driver writes deep pixels
    lpe::BuiltinTable table = lpe::BuiltinTable::Reference;  ///< which built-ins the scene uses
    std::vector<std::string> light_groups;  ///< named groups of the scene's lights
    std::vector<lpe::NamedExpr> custom;     ///< expressions that the scene and the caller define
    std::vector<Name> written;              ///< AOVs that shaders write, by number
    std::vector<Matte> mattes;  ///< that shaders write, by number; known before layers are planned
};

/// An output string cut into its parts.
struct OutputString {
    std::string camera, aov, type, filter, driver, layer;
    bool half = false;
    SourceSpan where;
};

/// Reads `[camera] aov TYPE filter driver [layer] [HALF]`; nothing with an error reported if it is none.
[[nodiscard]] std::optional<OutputString> parse_output(std::string_view text,
                                                       const SourceSpan& where,
                                                       Diagnostics& diagnostics);

/// What the plan needs to know of the rest of the scene.
struct PlanInput {
    const SceneGraph& graph;
    const RenderOptions& options;
    std::span<const std::string> light_groups;  ///< named groups of the scene's lights
    std::span<const Event> events;              ///< every event the scene can produce
    std::span<const Name> written;              ///< AOVs that shaders write, by number
    bool has_caustics = false;                  ///< some shader has `caustics` on
};

/// Layers, requests and the compiled program. Cameras, filters and drivers are made by the caller (compile.cpp).
void plan_layers(const PlanInput& input, AovPlan& plan, Diagnostics& diagnostics);

/// `RGBA = direct + indirect + ...` for sums among the layers of driver `driver` that the engine proves, custom
/// expressions and light groups included.
///
/// events  of the scene: what takes none of its paths (volume, without volumes) may be missing from a sum
[[nodiscard]] std::vector<std::string> proved_partitions(const AovPlan& plan, std::size_t driver,
                                                         std::span<const Event> events);

}  // namespace lightsieve
