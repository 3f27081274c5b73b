// The order of compilation, settings and cameras. See compiler.h.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>

#include "render/adaptive.h"
#include "render/compiler.h"
#include "render/memory_use.h"
#include "render/shade_services.h"
#include "scene/assemble.h"
#include "scene/switches.h"

namespace lightsieve {
namespace {

/// Largest frame side and number of pixels: 4 times 16K, so that a slip of the keyboard does not eat the memory.
constexpr int kMaxSide = 1 << 16;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 30;
constexpr int kMaxSamples = 1 << 24;
/// Bounds on texture_max_memory_MB: less is too little for the tiles of one look-up in all threads.
constexpr float kLeastTextureMb = 16, kMostTextureMb = 1 << 24;

std::uint8_t depth_limit(std::int32_t n) {
    return static_cast<std::uint8_t>(std::clamp(n, 0, 250));
}

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

template <class T>
T option_of(const SceneGraph& graph, Name param, T fallback) {
    const T* value = graph.options() == nullptr ? nullptr : graph.options()->find<T>(param);
    return value == nullptr ? fallback : *value;
}

/// Lets operators act and procedurals be read, with the scene's search paths.
void assemble_scene(SceneGraph& graph, const RenderOptions& options, Diagnostics& diagnostics) {
    const auto folder = [](const std::string& file) {
        return std::filesystem::path(file).parent_path().string();
    };
    AssetFinder finder;
    for (const char* param : {"procedural_searchpath", "asset_searchpath"})
        finder.add_search_path(option_of<Name>(graph, param, {}).view());
    if (!options.scene_path.empty()) finder.add_folder(folder(options.scene_path));
    AssembleOptions assembly;
    assembly.scene_path = options.scene_path;
    assembly.ignore_operators = option_of(graph, "ignore_operators", false);
    assembly.share_procedurals = option_of(graph, "procedural_auto_instancing", true);
    assembly.find_file = [&](std::string_view name, const std::string& from) {
        std::optional<std::string> found = finder.find(name);
        if (found || from.empty()) return found;
        AssetFinder beside;
        beside.add_folder(folder(from));
        return beside.find(name);
    };
    assemble(graph, assembly, diagnostics);
    apply_switches(graph, diagnostics);
}

}  // namespace

Scene::Scene() : services(std::make_unique<SceneServices>(*this)) {}
Scene::~Scene() = default;

void SceneDelete::operator()(Scene* scene) const { delete scene; }

SceneSummary summarize(const Scene& scene) { return scene.summary; }

ScenePtr compile_scene(SceneGraph& graph, const RenderOptions& options, Diagnostics& diagnostics) {
    const Clock::time_point start = Clock::now();
    assemble_scene(graph, options, diagnostics);
    const double assembling = seconds_between(start, Clock::now());
    ScenePtr scene = Compiler(graph, options, diagnostics).run();
    if (scene) scene->summary.times.compile += assembling;
    return scene;
}

Compiler::Compiler(const SceneGraph& graph, const RenderOptions& options, Diagnostics& diagnostics)
    : graph_(graph), options_(options), diagnostics_(diagnostics), scene_(new Scene) {}

ScenePtr Compiler::run() {
    const Clock::time_point start = Clock::now();
    read_settings();
    read_shutter();
    make_lights();
    make_shapes();
    shapes_are_known_ = true;
    make_background();
    make_atmosphere();
    make_aov_shaders();
    gather_events();
    // Mistakes in expressions are forgiven if the scene says so: their AOVs are black (spec: abort_on_error).
    const std::size_t before = diagnostics_.n_errors();
    plan_layers({graph_, options_, scene_->summary.light_groups, scene_->events, written_aovs_,
                 has_caustics()},
                scene_->plan, diagnostics_);
    const std::size_t forgiven = abort_on_error_ ? 0 : diagnostics_.n_errors() - before;
    make_cameras();
    make_views();
    find_adaptive_layer();
    check_motion();
    find_culling();
    part_passes();
    make_drivers();
    check_files();
    if (before > 0 || diagnostics_.n_errors() > before + forgiven) return nullptr;
    fill_records();
    find_mask_types();
    finish_depth_rules();
    find_coordinate_readers();
    const Clock::time_point accels = Clock::now();
    try {
        make_accels();
        finish_volumes();
    } catch (const InputError& e) {
        diagnostics_.add(e);
        return nullptr;
    }
    scene_->summary.times.accel = seconds_between(accels, Clock::now());
    summarize_scene();
    identify();
    find_viewer_layers();
    scene_->summary.forecast = forecast_memory(*scene_);
    for (const std::size_t file : scene_->summary.forecast.file_bytes)
        scene_->settings.checkpoint.keep_free += file;
    check_memory(scene_->summary.forecast, options_.max_memory, diagnostics_);
    if (diagnostics_.n_errors() > before + forgiven) return nullptr;
    note_times(seconds_between(start, Clock::now()));
    return std::move(scene_);
}

/// seconds  that everything took
void Compiler::note_times(double seconds) {
    StageTimes& times = scene_->summary.times;
    times.textures = scene_->textures->open_seconds();
    std::set<const VolumeGrids*> seen;
    for (const SceneVolume& volume : scene_->volumes)
        if (volume.grids() != nullptr && seen.insert(volume.grids()).second)
            times.volumes += volume.grids()->load_seconds();
    times.compile = std::max(0.0, seconds - times.textures - times.volumes - times.accel);
}

void Compiler::read_log_settings() {
    LogSettings& log = scene_->summary.log;
    log.verbosity = option<std::int32_t>("log_verbosity", 1);
    log.max_warnings = option<std::int32_t>("log_max_warnings", 100);
    log.file = option<Name>("log_file", {}).str();
    log.stats_file = option<Name>("stats_file", {}).str();
    log.stats_append = option<std::int32_t>("stats_mode", 0) == 1;
}

bool Compiler::has_caustics() const {
    const auto has = [](const auto& node) {
        const bool* caustics = node->template find<bool>("caustics");
        return caustics != nullptr && (*caustics || node->is_linked("caustics"));
    };
    return std::any_of(graph_.scopes().begin(), graph_.scopes().end(), [&](const auto& scope) {
        return std::any_of(scope->nodes.begin(), scope->nodes.end(), has);
    });
}

SourceSpan Compiler::option_place(Name param) const {
    return graph_.options() == nullptr ? SourceSpan{} : graph_.options()->where(param);
}

/// Adaptive sampling: as Arnold, only with at least four samples a pixel.
void Compiler::read_adaptive() {
    RenderSettings& s = scene_->settings;
    s.samples_max = s.samples;
    const int most = option<std::int32_t>("AA_samples_max", 20);
    // Who asks for a number of samples gets it.
    if (!option("enable_adaptive_sampling", false) || s.samples < 4 || options_.spp > 0) return;
    s.samples_max = std::max(s.samples, std::max(most, 1) * std::max(most, 1));
    s.adaptive_threshold = std::max(0.0F, option("AA_adaptive_threshold", 0.015F));
    // Buckets are whole blocks, so that decisions do not depend on their size.
    s.bucket_size = (s.bucket_size + kAdaptiveBlock - 1) / kAdaptiveBlock * kAdaptiveBlock;
}

void Compiler::read_settings() {
    RenderSettings& s = scene_->settings;
    for (const char* param : {"texture_searchpath", "asset_searchpath"})
        assets_.add_search_path(option<Name>(param, {}).view());
    if (!options_.scene_path.empty())
        assets_.add_folder(std::filesystem::path(options_.scene_path).parent_path().string());
    make_color_spaces();
    // What is no number is too little.
    const float texture_mb = option("texture_max_memory_MB", 4096.0F);
    scene_->textures = std::make_shared<TextureCache>(
        static_cast<std::size_t>(texture_mb >= kLeastTextureMb
                                     ? std::min(texture_mb, kMostTextureMb)
                                     : kLeastTextureMb),
        scene_->color_spaces);
    read_log_settings();
    ignore_missing_textures_ = option("ignore_missing_textures", false);
    abort_on_error_ = option("abort_on_error", true);

    s.width = options_.width > 0 ? options_.width : option<std::int32_t>("xres", 320);
    s.height = options_.height > 0 ? options_.height : option<std::int32_t>("yres", 240);
    s.pixel_aspect_ratio = option("pixel_aspect_ratio", 1.0F);
    s.bucket_size = option<std::int32_t>("bucket_size", 64);
    if (s.width > kMaxSide || s.height > kMaxSide ||
        std::int64_t{s.width} * s.height > kMaxPixels) {
        diagnostics_.error(Code::LimitImageSize,
                           "a picture of " + std::to_string(s.width) + " x " +
                               std::to_string(s.height) + " pixels is too large",
                           option_place("xres"),
                           "at most " + std::to_string(kMaxSide) + " on a side and " +
                               std::to_string(kMaxPixels) + " in all");
        s.width = s.height = 1;
    }
    read_region();

    const int aa =
        options_.aa_samples != 0 ? options_.aa_samples : option<std::int32_t>("AA_samples", 1);
    const std::int64_t squared = std::int64_t{std::max(aa, 1)} * std::max(aa, 1);
    s.samples = options_.spp > 0 ? options_.spp
                                 : static_cast<int>(std::min<std::int64_t>(squared, kMaxSamples));
    const int aa_of_scene = std::clamp(option<std::int32_t>("AA_samples", 1), 1, 100);
    s.footprint_samples = aa_of_scene * aa_of_scene;
    read_adaptive();
    s.seed = options_.seed ? *options_.seed
                           : static_cast<std::uint32_t>(option<std::int32_t>("AA_seed", 1));
    s.threads = options_.threads;
    s.depth = {depth_limit(option<std::int32_t>("GI_diffuse_depth", 0)),
               depth_limit(option<std::int32_t>("GI_specular_depth", 0)),
               depth_limit(option<std::int32_t>("GI_transmission_depth", 2)),
               depth_limit(option<std::int32_t>("GI_volume_depth", 0)),
               depth_limit(option<std::int32_t>("GI_total_depth", 10))};
    const auto rays = [&](std::string_view name) {
        return squared_samples(option<std::int32_t>(name, 2));
    };
    s.gi_samples = {rays("GI_diffuse_samples"), rays("GI_specular_samples"),
                    rays("GI_transmission_samples"), rays("GI_sss_samples"),
                    rays("GI_volume_samples")};
    s.auto_transparency_depth = option<std::int32_t>("auto_transparency_depth", 10);
    s.sample_clamp = option("AA_sample_clamp", kInfinity);
    s.indirect_clamp = option("indirect_sample_clamp", 10.0F);
    s.low_light_threshold = option("low_light_threshold", 0.001F);
    s.roulette_depth = options_.roulette_depth;
    s.guiding = options_.guiding;
    s.dielectric_priorities = option("dielectric_priorities", true);
    constexpr std::array<std::string_view, 4> kInstructionSets{"", "sse2", "avx2", "avx512"};
    if (std::find(kInstructionSets.begin(), kInstructionSets.end(), options_.isa) ==
        kInstructionSets.end())
        diagnostics_.error(Code::UnknownChoice,
                           "no instruction set is called \"" + options_.isa + '"', {},
                           "one of sse2 avx2 avx512, or none: the best that the processor has");
    scene_->capture = options_.capture;
    scene_->write_files = options_.write_files;
    scene_->background_visibility = option<std::uint8_t>("background_visibility", 255);
}

void Compiler::read_region() {
    RenderSettings& s = scene_->settings;
    constexpr std::int32_t kUnset = std::numeric_limits<std::int32_t>::min();
    s.region = {0, 0, s.width - 1, s.height - 1};
    // A frame size from the command line makes the scene's region meaningless.
    const bool resized = options_.width > 0 || options_.height > 0;
    if (!resized) {
        const auto read = [&](const char* param, int& bound) {
            const auto value = option<std::int32_t>(param, kUnset);
            if (value != kUnset) bound = value;
        };
        read("region_min_x", s.region.x0);
        read("region_min_y", s.region.y0);
        read("region_max_x", s.region.x1);
        read("region_max_y", s.region.y1);
    }
    if (options_.region) s.region = *options_.region;
    const Region& r = s.region;
    const bool sane = r.x0 <= r.x1 && r.y0 <= r.y1 && r.x0 >= -kMaxSide && r.y0 >= -kMaxSide &&
                      r.x1 <= kMaxSide && r.y1 <= kMaxSide;
    if (sane) return;
    diagnostics_.error(
        Code::LimitImageSize,
        "the region " + std::to_string(r.x0) + "," + std::to_string(r.y0) + " to " +
            std::to_string(r.x1) + "," + std::to_string(r.y1) + " holds no pixels",
        option_place("region_min_x"),
        "a region is its first and last column and row, from the upper left corner");
    s.region = {0, 0, 0, 0};
}

const NodeInstance* Compiler::default_camera() {
    if (!options_.camera.empty()) {
        const NodeInstance* node = graph_.find(options_.camera);
        if (node != nullptr && node->kind() == NodeKind::Camera) return node;
        std::vector<std::string> known;
        for (const auto& n : graph_.nodes())
            if (n->kind() == NodeKind::Camera) known.push_back(n->name().str());
        diagnostics_.error(Code::CameraMissing, "no camera is called \"" + options_.camera + '"',
                           {}, did_you_mean(options_.camera, known));
        return nullptr;
    }
    if (const NodeRef camera = option<NodeRef>("camera", {}); camera.node != nullptr) {
        if (camera.node->kind() == NodeKind::Camera) return camera.node;
        diagnostics_.error(
            Code::CameraMissing,
            "options.camera names a " + camera.node->type().name.str() + ", not a camera",
            option_place("camera"));
        return nullptr;
    }
    for (const auto& node : graph_.nodes())
        if (node->kind() == NodeKind::Camera) return node.get();
    if (graph_.options() == nullptr) {
        // An archive for other scenes: everything in it can be checked. render_scene refuses it.
        diagnostics_.lint(Code::CameraMissing,
                          "the file has neither options nor a camera: only a scene that includes "
                          "it can be rendered",
                          {});
        return nullptr;
    }
    diagnostics_.error(Code::CameraMissing, "the scene has no camera", option_place("camera"),
                       "add a persp_camera and name it in options.camera");
    return nullptr;
}

void Compiler::make_cameras() {
    const NodeInstance* main_camera = default_camera();
    for (Pass& pass : scene_->plan.passes) {
        if (pass.camera_node == nullptr) pass.camera_node = main_camera;
        if (pass.camera_node == nullptr) continue;
        CompileContext context(*this, pass.camera_node, pass.camera_node->name());
        pass.camera = pass.camera_node->type().make_camera(pass.camera_node->block(), context);
    }
}

void Compiler::finish_depth_rules() {
    // A ray type matters where something tells it from specular reflection, which stands for all that do not.
    std::array<bool, 8> matters{};
    const auto set = [&](RayType type, bool value) {
        matters[static_cast<std::size_t>(type)] |= value;
    };
    for (const RayType type :
         {RayType::DiffuseReflect, RayType::DiffuseTransmit, RayType::Subsurface})
        set(type, true);  // the caustics switch
    for (const SceneLight& light : scene_->lights) {
        const LightCommon& l = light.common;
        set(RayType::SpecularTransmit, l.transmission != l.specular);
        set(RayType::Volume, l.volume != l.specular);
    }
    const bool background_differs =
        scene_->background != nullptr && scene_->background_visibility != 255;
    if (scene_->mask_types != 0 || background_differs) matters.fill(true);
    scene_->depth_rules = DepthRules(scene_->settings.depth, matters);
}

void Compiler::summarize_scene() {
    SceneSummary& s = scene_->summary;
    std::set<const ShapeGeometry*> seen;
    for (const SceneObject& object : scene_->objects) {
        ++s.n_instances;
        if (!seen.insert(object.geometry).second) continue;
        ++s.n_shapes;
        if (const auto* mesh = std::get_if<TriangleMesh>(&object.geometry->data))
            s.n_triangles += mesh->indices.size() / 3;
        if (const auto* spheres = std::get_if<SphereList>(&object.geometry->data))
            s.n_spheres += spheres->radii.size();
        if (const auto* points = std::get_if<PointList>(&object.geometry->data))
            s.n_spheres += points->mode == PointList::Mode::Sphere ? points->index.size() : 0;
    }
    s.n_lights = scene_->lights.size();
    s.n_shaders = scene_->shaders.size();
    const AovPlan& plan = scene_->plan;
    s.n_aovs = plan.layers.size();
    s.n_atoms = plan.program->n_atoms();
    for (std::size_t i = 0; i < plan.program->n_automata(); ++i)
        s.n_states += plan.program->automaton(i).n_inner_states();
    s.width = scene_->settings.width;
    s.height = scene_->settings.height;
    s.samples_per_pixel = scene_->settings.samples;
    for (std::size_t d = 0; d < plan.drivers.size(); ++d) {
        s.files.push_back(plan.drivers[d].driver ? plan.drivers[d].driver->path() : "");
        for (std::uint32_t layer : plan.drivers[d].layers) {
            s.layers.push_back(plan.layers[layer].info);
            s.layer_file.push_back(static_cast<int>(d));
        }
        for (std::string& proved : proved_partitions(plan, d, scene_->events))
            if (std::find(s.partitions.begin(), s.partitions.end(), proved) == s.partitions.end())
                s.partitions.push_back(std::move(proved));
    }
}

}  // namespace lightsieve
