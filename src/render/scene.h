// A compiled scene: immutable, shared by all threads, everything decided that can be decided before the first ray.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/arena.h"
#include "core/event.h"
#include "core/sampling.h"
#include "io/texture.h"
#include "lpe/program.h"
#include "render/accel.h"
#include "render/aov_plan.h"
#include "render/checkpoint.h"
#include "render/cutting.h"
#include "render/gi_kind.h"
#include "render/light_sampler.h"
#include "render/path_terms.h"
#include "render/render.h"
#include "render/scene_object.h"
#include "render/shader_program.h"
#include "render/volume.h"
#include "scene/camera.h"
#include "scene/light.h"
#include "scene/pixel_filter.h"
#include "scene/shape.h"

namespace lightsieve {

class SceneServices;  // render/shade_services.h

struct SceneLight {
    std::unique_ptr<Light> light;
    LightCommon common;
    Name name;
    std::string group;                                    ///< `default` if it has none
    lpe::TerminalId as_light = 0;                         ///< L
    lpe::TerminalId as_background = 0;                    ///< B with the group, for skydomes
    std::uint32_t light_event = 0, background_event = 0;  ///< positions in Scene::events
    bool is_skydome = false;
    /// Its shadows are tampered with (cast_shadows off, shadow_density, shadow_color): only light samples find it.
    bool samples_only = false;
    /// Samples where a path splits, on surfaces and in volumes: the squares of `samples` and `volume_samples`.
    int n_samples = 1, n_volume_samples = 1;
};

/// Shaders of objects, by the shader_index of their geometry.
struct ShaderList {
    std::vector<const ShaderProgram*> programs;                 ///< at least one
    bool may_be_transparent = false, may_tint_shadows = false;  ///< one of them may
    bool reads_coordinates = false;                             ///< one of them does
};

/// Who sees the picture as it grows.
struct ViewerSettings {
    std::string address;              ///< HOST:PORT; empty: nobody
    std::vector<std::size_t> layers;  ///< of the plan
};

/// What options and command line say, put together.
struct RenderSettings {
    CheckpointSettings checkpoint;
    ViewerSettings viewer;
    int width = 320, height = 240;
    Region region;  ///< inclusive, in pixels; may reach outside of the frame
    float pixel_aspect_ratio = 1;
    int bucket_size = 64;
    int samples = 1;  ///< camera samples a pixel; with adaptive sampling the least
    /// By which textures behind bounces are filtered: as the scene says, so that more samples of it are the same picture.
    int footprint_samples = 1;
    int samples_max = 1;                ///< the most: `samples` without adaptive sampling
    float adaptive_threshold = 0.015F;  ///< noise at which a block of pixels stops
    std::uint32_t seed = 1;
    int threads = 0;
    DepthLimits depth;
    GiSamples gi_samples;
    int auto_transparency_depth = 10;
    float sample_clamp = kInfinity;      ///< AA_sample_clamp
    float indirect_clamp = 10;           ///< indirect_sample_clamp
    float low_light_threshold = 0.001F;  ///< light samples below it are traced only sometimes
    int roulette_depth = 4;
    bool guiding = false;  ///< broad lobes learn where light comes from
    float shutter_start = 0, shutter_end = 0;
    /// ignore_motion_blur: all samples are taken at this time [0,1) within the shutter.
    std::optional<float> instant;
    bool dielectric_priorities = true;
};

/// What is not traced because no output can show it.
enum class Culling : std::uint8_t {
    None,  ///< the beauty is wanted, or something looks at all light (AA_sample_clamp, adaptive sampling)
    Paths,  ///< paths that no AOV goes on with, and shadow rays to lights whose light no AOV takes
    Lobes,  ///< and lobes that lead to such paths are not sampled: the same means, other noise
};

class Scene {
  public:
    Scene();
    ~Scene();

    RenderSettings settings;
    Culling culling = Culling::None;
    RenderIdentity identity;                          ///< of what is rendered, for checkpoints
    std::shared_ptr<const ColorSpaces> color_spaces;  ///< outlives what was made with it
    std::shared_ptr<TextureCache> textures;
    std::vector<std::unique_ptr<ShapeGeometry>> geometries;
    std::vector<std::unique_ptr<ShaderProgram>> shaders;
    std::vector<const ShaderProgram*> aov_shaders;  ///< run after each shader that the camera sees
    std::vector<std::shared_ptr<const void>> kept;  ///< what blocks of nodes point to
    /// Whether widths of rays decide anything: some shader filters what it looks up.
    bool reads_footprints = true;
    /// Linked colours of lights and other nodes that are no shaders.
    std::vector<std::unique_ptr<LinkedColor>> colors;
    std::unique_ptr<SceneServices> services;  ///< what shaders may ask of the scene
    std::vector<SceneObject> objects;
    Cutters cutters;
    // What objects point to.
    Arena matrices{1U << 20U};
    std::deque<Lineage> lineages;
    std::deque<ShaderList> shader_lists;
    std::deque<std::vector<bool>> shadow_lights;
    std::vector<SceneLight> lights;
    std::vector<std::unique_ptr<Light>> portals;  ///< openings for skies: no lights themselves
    std::vector<std::uint32_t> infinite_lights;   ///< indices of lights that rays to infinity meet
    std::vector<std::unique_ptr<LightSampler>>
        light_samplers;                          ///< 0: all lights; others: light groups of shapes
    std::vector<std::uint32_t> light_of_object;  ///< of light_accel: index into lights
    std::vector<SceneObject> light_objects;      ///< geometry of area lights
    std::vector<SceneVolume> volumes;
    /// Lights of finite distance by power, index as in `lights`; only where media are. Without cells: there are none.
    Distribution1D finite_lights;
    std::unique_ptr<Accel> accel;               ///< shapes
    std::unique_ptr<Accel> light_accel;         ///< area lights; null if there are none
    const ShaderProgram* background = nullptr;  ///< options.background
    const ShaderProgram* atmosphere = nullptr;  ///< options.atmosphere
    /// What the atmosphere needs of the scene.
    struct HazeScene {
        Box3f bounds;     ///< of shapes and lights
        int samples = 1;  ///< points along a camera ray
    };
    HazeScene haze;
    std::uint8_t background_visibility = 255;
    LobeRecord background_record;  ///< B without a group
    std::vector<Event> events;     ///< every event the scene can produce
    lpe::TerminalId probe = 0;     ///< A
    std::uint32_t probe_event = 0;
    DepthRules depth_rules{{}, {}};
    /// Ray types that some shape treats unlike others (visibility, sidedness, matte): bits that must be told apart when tracing.
    std::uint8_t mask_types = 0;
    bool shadows_by_mask =
        false;  ///< some shape hides lights from shadow rays only, or from others only
    bool has_transparency = false;             ///< some shape may be transparent to shadows
    bool rays_may_pass = false;                ///< some shape may be passed by other rays
    bool lights_can_be_met = false;            ///< some ray may meet some light by chance
    bool disperses = false;                    ///< some shader bends light by wavelength
    bool capture = false, write_files = true;  ///< as RenderOptions
    AovPlan plan;
    SceneSummary summary;

    /// Whether rays of a type meet a surface: shapes may have one side only, and parts may be cut away.
    [[nodiscard]] bool is_there(const Surface& surface, RayType type) const;
};

}  // namespace lightsieve
