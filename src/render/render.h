// The way in: a scene graph becomes an immutable scene, a scene becomes pixels in files or in memory.
//
//     Diagnostics diagnostics;
//     Document document = ...; SceneGraph graph = ...;               (scene/)
//     auto scene = compile_scene(graph, options, diagnostics);        every error is known here, before the first ray
//     RenderResult result = render_scene(*scene, control, diagnostics);
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "render/statistics.h"
#include "scene/driver.h"

namespace lightsieve {

class SceneGraph;  // scene/graph.h
class Registry;    // scene/registry.h
class Scene;       // render/scene.h

/// Pixels x0 <= x <= x1, y0 <= y <= y1, counted from the upper left corner.
struct Region {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// What the command line or Python may say beyond the scene; empty or 0 means: as the scene says.
struct RenderOptions {
    std::string
        output;  ///< -o: a folder for the drivers' relative names, or the first driver's file
    std::string
        scene_path;  ///< of the .ass file: relative assets are searched beside it; named in headers
    int aa_samples = 0;         ///< AA_samples: n * n samples a pixel
    int spp = 0;                ///< samples a pixel, wins over aa_samples
    int width = 0, height = 0;  ///< frame [pixels]
    std::optional<Region> region;
    int threads = 0;
    std::optional<std::uint32_t> seed;
    std::string camera;             ///< name of a camera node
    std::vector<std::string> aovs;  ///< "NAME TYPE": outputs added to the first driver
    std::vector<std::string> lpes;  ///< "NAME EXPRESSION": expressions defined and output as RGB
    bool lpe_standard = false;      ///< extensions of the language are errors
    std::string lpe_table;          ///< "", "reference" or "arnold7"
    std::string rendering_space;    ///< name of the colour space that light is computed in
    std::string isa;                ///< "", "sse2", "avx2", "avx512": pins the ray kernels
    int roulette_depth =
        4;  ///< scattering events before Russian roulette may end a path; negative: never
    bool guiding = false;  ///< broad lobes learn where light comes from, before the first sample
    bool capture = false;  ///< keep the layers in memory (RenderResult::layers)
    bool write_files = true;  ///< hand buckets to the drivers
    double checkpoint_minutes =
        0;  ///< between two writes of what is done; 0: none but at an end before time
    bool checkpoints = false;  ///< keep what is done beside the first file when ended before time
    bool resume = false;       ///< go on from there
    bool keep_checkpoint = false;  ///< also when the render is done
    std::size_t max_memory = 0;    ///< a forecast above it is an error [bytes]; 0: no limit
    std::string viewer;            ///< HOST:PORT of a tev that shows the picture as it grows
    std::vector<std::string> viewer_layers;  ///< names; empty: the first layer; "*": all
};

/// What `lightsieve check` tells of a scene.
struct SceneSummary {
    std::size_t n_shapes = 0, n_instances = 0, n_triangles = 0, n_spheres = 0, n_lights = 0,
                n_shaders = 0;
    std::vector<std::string> light_groups;  ///< named ones, sorted
    std::size_t n_aovs = 0, n_states = 0, n_atoms = 0;
    int width = 0, height = 0, samples_per_pixel = 0;
    std::vector<std::string> files;  ///< what a render would write
    std::vector<ImageLayer> layers;  ///< all layers of all files
    std::vector<int> layer_file;     ///< index into `files` of each layer
    std::vector<std::string>
        partitions;  ///< "RGBA = direct + indirect + ..." proved for layers of one file
    StageTimes times;
    MemoryForecast forecast;
    LogSettings log;
};

/// A Scene is opaque to callers and destroyed by this.
struct SceneDelete {
    void operator()(Scene* scene) const;
};
using ScenePtr = std::unique_ptr<Scene, SceneDelete>;

/// Compiles everything; null if there is an error (all of them are in `diagnostics`).
///
/// Operators edit the graph and procedurals are read into it first, once (scene/assemble.h). The graph must outlive the
/// scene. Cost: geometry is copied and its acceleration structure built.
[[nodiscard]] ScenePtr compile_scene(SceneGraph& graph, const RenderOptions& options,
                                     Diagnostics& diagnostics);

[[nodiscard]] SceneSummary summarize(const Scene& scene);

struct RenderProgress {
    /// Of the camera, those that guiding learns from among them.
    std::uint64_t samples_done = 0, samples_total = 0;
    double seconds = 0;  ///< since the first ray
    /// Of the buckets that are done: a pixel's standard error over how bright pixels are, both root mean square, of the layer that
    /// adaptive sampling goes by or the first one of light. Below 0: not known yet.
    double noise = -1;
};

/// How a caller watches and stops a render.
struct RenderControl {
    std::function<void(const RenderProgress&)>
        progress;  ///< called from one thread at a time, every thousand samples of each thread
    const std::atomic<bool>* stop =
        nullptr;  ///< set it to end early: within a fraction of a second
};

/// A layer in memory, row 0 at the top.
struct FrameLayer {
    ImageLayer info;
    std::vector<float>
        pixels;  ///< height * width * n_channels of the rendered region; UINT as bits of a float
};

/// How much noise is left in a layer of light.
struct LayerNoise {
    std::string name;
    double mean = 0;   ///< luminance
    double level = 0;  ///< luminance, root mean square over the picture
    double error =
        0;  ///< standard error of a pixel's luminance, root mean square over the picture
};

struct RenderResult {
    bool stopped = false;       ///< ended early: the files have the samples taken so far
    double seconds = 0;         ///< sampling time, without compile and file output
    double output_seconds = 0;  ///< spent in drivers
    std::uint64_t samples = 0;  ///< camera samples taken
    std::uint64_t training_samples =
        0;  ///< camera samples that guiding learned from, not in `samples`
    std::uint64_t resumed_samples = 0;  ///< that a checkpoint had, not in `samples`
    std::string checkpoint;             ///< file from which a later render can go on; empty: none
    std::uint64_t rays = 0;             ///< closest-hit and shadow rays, those of training too
    RaysByKind rays_by_kind{};          ///< the same
    MemoryUse memory;                   ///< at the end; `other` is the rest of `peak_memory`
    std::size_t peak_memory = 0;        ///< of the process [bytes]; 0: not known
    std::uint64_t dropped_samples = 0;  ///< contributions that were not finite
    std::vector<std::string> files;     ///< written
    std::vector<LayerNoise> noise;      ///< layers of light, in order
    std::vector<FrameLayer> layers;     ///< if RenderOptions::capture
    int width = 0, height = 0;          ///< of the rendered region
};

/// Renders. Opens every driver first; an unwritable one is an InputError before the first ray.
[[nodiscard]] RenderResult render_scene(const Scene& scene, const RenderControl& control,
                                        Diagnostics& diagnostics);

}  // namespace lightsieve
