#include "render/render.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

#include "core/memory.h"
#include "lpe/path.h"
#include "nodes/all_nodes.h"
#include "python/errors.h"
#include "python/interruptible.h"
#include "python/layers.h"
#include "python/text.h"
#include "render/scene.h"
#include "scene/ass_read.h"
#include "scene/graph.h"
#include "scene/registry.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace lightsieve::python {
namespace {

const Registry& registry() {
    static const Registry all = [] {
        Registry r;
        add_all_nodes(r);
        return r;
    }();
    return all;
}

/// A scene from file to compiled form, with everything that was found wrong on the way.
class CompiledScene {
  public:
    CompiledScene(const std::string& path, RenderOptions options, bool strict,
                  const std::vector<std::string>& assignments)
        : options_(std::move(options)) {
        options_.scene_path = path;
        std::atomic<bool> stop =
            false;  // reading and compiling cannot be ended early: Ctrl-C is raised when they are done
        run_interruptible([&] { compile(path, strict, assignments); }, stop, {});
    }
    ~CompiledScene() {
        scene_.reset();
        graph_.reset();
        release_freed_memory();
    }
    CompiledScene(const CompiledScene&) = delete;
    CompiledScene& operator=(const CompiledScene&) = delete;

    [[nodiscard]] bool usable() const { return scene_ != nullptr; }
    [[nodiscard]] nb::tuple diagnostics() const { return to_python(diagnostics_.items()); }
    [[nodiscard]] std::size_t n_errors() const { return diagnostics_.n_errors(); }
    [[nodiscard]] std::size_t n_warnings() const { return diagnostics_.n_warnings(); }
    [[nodiscard]] std::size_t n_lints() const { return diagnostics_.n_lints(); }
    [[nodiscard]] SceneSummary summary() const { return summarize(scene()); }
    /// Seconds by stage, before the first ray.
    [[nodiscard]] nb::dict times() const {
        const StageTimes times = summary().times;
        nb::dict out;
        out["read"] = read_seconds_;
        out["compile"] = times.compile;
        out["textures"] = times.textures;
        out["volumes"] = times.volumes;
        out["accel"] = times.accel;
        return out;
    }

    /// What the engine needs to prove things about this scene, as texts: the module of the engine
    /// shares no types with this one.
    [[nodiscard]] std::vector<std::string> events() const {
        std::vector<std::string> out;
        for (const Event& event : scene().events)
            if (event.kind != EventKind::Camera) out.push_back(lpe::print_event(event));
        return out;
    }
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> definitions() const {
        std::vector<std::pair<std::string, std::string>> out;
        for (const lpe::NamedExpr& custom : scene().plan.custom)
            if (custom.expr) out.emplace_back(custom.name, custom.text);
        return out;
    }
    [[nodiscard]] std::string_view lpe_table() const {
        return scene().plan.table == lpe::BuiltinTable::Arnold7 ? "arnold7" : "reference";
    }
    /// Per layer, in the summary's order: camera rays and filter that it shares with layers of the
    /// same pair.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> layer_samples() const {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
        for (const PlannedDriver& driver : scene().plan.drivers)
            for (const std::uint32_t layer : driver.layers)
                out.emplace_back(scene().plan.layers[layer].pass, scene().plan.layers[layer].view);
        return out;
    }

    /// Renders; `progress` is called with a RenderProgress. A Ctrl-C ends it early and is told by `interrupted`.
    nb::object render(const nb::object& progress);

  private:
    void compile(const std::string& path, bool strict,
                 const std::vector<std::string>& assignments) {
        using Clock = std::chrono::steady_clock;
        const Clock::time_point start = Clock::now();
        const Document document = read_ass_file(path, diagnostics_);
        if (document.nodes().empty() && diagnostics_.has_errors()) return;
        BuildOptions build;
        if (strict) build.unknown = UnknownPolicy::Error;
        graph_ =
            std::make_unique<SceneGraph>(build_graph(document, registry(), build, diagnostics_));
        for (const std::string& assignment : assignments)
            graph_->assign(assignment, diagnostics_);
        read_seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
        scene_ = compile_scene(*graph_, options_, diagnostics_);
    }
    [[nodiscard]] const Scene& scene() const {
        if (!scene_) throw nb::value_error("the scene has errors: see its diagnostics");
        return *scene_;
    }

    RenderOptions options_;
    mutable Diagnostics diagnostics_;
    double read_seconds_ = 0;
    std::unique_ptr<SceneGraph> graph_;
    ScenePtr scene_;
};

/// Names with numbers, in their order.
nb::dict to_dict(const std::vector<std::pair<std::string_view, std::size_t>>& values) {
    nb::dict out;
    for (const auto& [name, value] : values)
        out[nb::str(name.data(), name.size())] = nb::int_(value);
    return out;
}

/// A layer's pixels as an array that owns them: float32, or uint32 for UINT layers.
nb::object pixels(FrameLayer&& layer, int width, int height) {
    auto* owned = new std::vector<float>(std::move(layer.pixels));
    const nb::capsule owner(owned,
                            [](void* p) noexcept { delete static_cast<std::vector<float>*>(p); });
    const std::size_t shape[3] = {static_cast<std::size_t>(height),
                                  static_cast<std::size_t>(width), layer.info.n_channels};
    nb::object array = nb::cast(nb::ndarray<nb::numpy, float>(owned->data(), 3, shape, owner));
    const bool is_uint = layer.info.aov_type == "UINT" || layer.info.aov_type == "INT";
    return is_uint ? array.attr("view")("uint32") : array;
}

/// What a render gave; `layers` pairs each layer with its pixels.
struct Outcome {
    RenderResult result;
    nb::list layers;
    bool interrupted = false;  ///< by Ctrl-C
};

nb::object CompiledScene::render(const nb::object& progress) {
    std::mutex mutex;
    RenderProgress latest;
    std::atomic<bool> stop = false;
    RenderControl control;
    control.stop = &stop;
    control.progress = [&](const RenderProgress& now) {
        const std::lock_guard lock(mutex);
        latest = now;
    };
    const auto poll = [&] {
        if (progress.is_none()) return;
        RenderProgress now;
        {
            const std::lock_guard lock(mutex);
            now = latest;
        }
        progress(now);
    };
    Outcome outcome;
    try {
        run_interruptible([&] { outcome.result = render_scene(scene(), control, diagnostics_); },
                          stop, poll);
    } catch (nb::python_error& error) {
        if (!error.matches(PyExc_KeyboardInterrupt)) throw;
        outcome.interrupted = true;
    }
    for (FrameLayer& layer : outcome.result.layers) {
        nb::object info = nb::cast(layer.info);
        outcome.layers.append(nb::make_tuple(
            info, pixels(std::move(layer), outcome.result.width, outcome.result.height)));
    }
    outcome.result.layers.clear();
    return nb::cast(std::move(outcome));
}

void add_options(nb::module_& module) {
    nb::class_<RenderOptions>(
        module, "RenderOptions",
        "What a caller may say beyond the scene; empty or 0: as the scene says.")
        .def(nb::init<>())
        .def_rw("output", &RenderOptions::output,
                "A folder for the drivers' relative names, or the first driver's file.")
        .def_rw("aa_samples", &RenderOptions::aa_samples, "AA_samples: n * n samples a pixel.")
        .def_rw("spp", &RenderOptions::spp, "Samples a pixel, wins over aa_samples.")
        .def_rw("width", &RenderOptions::width, "Of the frame [pixels].")
        .def_rw("height", &RenderOptions::height, "Of the frame [pixels].")
        .def_rw("threads", &RenderOptions::threads, "0: as many as the machine has.")
        .def_rw("seed", &RenderOptions::seed, "Of the samples; None: as the scene says.")
        .def_rw("camera", &RenderOptions::camera, "Name of a camera node.")
        .def_rw("aovs", &RenderOptions::aovs, "`NAME TYPE`: outputs added to the first driver.")
        .def_rw("lpes", &RenderOptions::lpes,
                "`NAME EXPRESSION`: expressions defined and output as RGB.")
        .def_rw("lpe_standard", &RenderOptions::lpe_standard,
                "Extensions of the language are errors.")
        .def_rw("lpe_table", &RenderOptions::lpe_table, "Empty, `reference` or `arnold7`.")
        .def_rw("rendering_space", &RenderOptions::rendering_space,
                "Colour space that light is computed in; empty: as the scene says.")
        .def_rw("isa", &RenderOptions::isa,
                "Empty, `sse2`, `avx2` or `avx512`: pins the ray kernels.")
        .def_rw("roulette_depth", &RenderOptions::roulette_depth,
                "Scatterings before Russian roulette may end a path; negative: never.")
        .def_rw("checkpoints", &RenderOptions::checkpoints,
                "Keep what is done beside the first file when the render ends before time.")
        .def_rw("checkpoint_minutes", &RenderOptions::checkpoint_minutes,
                "Between two writes of what is done; 0: only when the render ends before time.")
        .def_rw("resume", &RenderOptions::resume, "Go on from there.")
        .def_rw("guiding", &RenderOptions::guiding,
                "Learn where light comes from, before the first sample.")
        .def_rw("keep_checkpoint", &RenderOptions::keep_checkpoint,
                "Keep it also when the render is done.")
        .def_rw("max_memory", &RenderOptions::max_memory,
                "A forecast above it is an error [bytes]; 0: no limit.")
        .def_rw("viewer", &RenderOptions::viewer,
                "HOST:PORT of a tev that shows the picture as it grows; empty: none.")
        .def_rw("viewer_layers", &RenderOptions::viewer_layers,
                "Names of the layers that it shows, `*` for all; empty: the first.")
        .def_rw("capture", &RenderOptions::capture, "Keep the layers in memory.")
        .def_rw("write_files", &RenderOptions::write_files, "Hand the pixels to the drivers.")
        .def(
            "set_region",
            [](RenderOptions& o, int x0, int y0, int x1, int y1) {
                o.region = Region{x0, y0, x1, y1};
            },
            "x0"_a, "y0"_a, "x1"_a, "y1"_a,
            "Pixels x0..x1, y0..y1, both ends included, from the upper left corner.");
}

void add_results(nb::module_& module) {
    nb::class_<ImageLayer>(module, "ImageLayer", "One layer of a picture file.")
        .def_ro("name", &ImageLayer::name, "As asked for, e.g. `diffuse_key`.")
        .def_ro("aov", &ImageLayer::aov, "The AOV, before renaming.")
        .def_ro("aov_type", &ImageLayer::aov_type, "`RGBA`, `RGB`, `FLOAT`, `VECTOR`, ...")
        .def_ro("expression", &ImageLayer::expression, "Empty if it is no light path expression.")
        .def_ro("light_group", &ImageLayer::light_group, "Empty if it is not restricted to one.")
        .def_ro("filter", &ImageLayer::filter, "Node type of the filter.")
        .def_ro("filter_width", &ImageLayer::filter_width, "[pixels]")
        .def_ro("half", &ImageLayer::half, "HALF was asked for this output.")
        .def_ro("n_channels", &ImageLayer::n_channels, "1 to 4.");

    nb::class_<SceneSummary>(module, "SceneSummary",
                             "What a compiled scene holds and what a render of it would write.")
        .def_ro("n_shapes", &SceneSummary::n_shapes, "Shapes.")
        .def_ro("n_instances", &SceneSummary::n_instances,
                "Shapes as placed, copies by instancers included.")
        .def_ro("n_triangles", &SceneSummary::n_triangles,
                "Triangles of all meshes, each mesh once.")
        .def_ro("n_spheres", &SceneSummary::n_spheres, "Spheres.")
        .def_ro("n_lights", &SceneSummary::n_lights, "Lights.")
        .def_ro("n_shaders", &SceneSummary::n_shaders, "Shaders.")
        .def_ro("light_groups", &SceneSummary::light_groups, "Named ones, sorted.")
        .def_ro("n_aovs", &SceneSummary::n_aovs, "Expressions with their groups.")
        .def_ro("n_states", &SceneSummary::n_states, "States of the automata.")
        .def_ro("n_atoms", &SceneSummary::n_atoms, "Sets of paths that the AOVs tell apart.")
        .def_ro("width", &SceneSummary::width, "Of the frame [pixels].")
        .def_ro("height", &SceneSummary::height, "Of the frame [pixels].")
        .def_ro("samples_per_pixel", &SceneSummary::samples_per_pixel, "Camera samples.")
        .def_ro("files", &SceneSummary::files, "What a render would write.")
        .def_ro("layers", &SceneSummary::layers, "All layers of all files.")
        .def_ro("layer_file", &SceneSummary::layer_file, "Index into `files` of each layer.")
        .def_ro("partitions", &SceneSummary::partitions,
                "Sums that were proved for the layers of one file.")
        .def_prop_ro(
            "forecast", [](const SceneSummary& s) { return to_dict(s.forecast.use.by_name()); },
            nb::sig("def forecast(self) -> dict[str, int]"),
            "Memory that a render may take at most, by what it holds [bytes].")
        .def_prop_ro(
            "file_bytes", [](const SceneSummary& s) { return s.forecast.file_bytes; },
            "Of each file, before compression.")
        .def_prop_ro(
            "checkpoint_bytes",
            [](const SceneSummary& s) { return s.forecast.checkpoint_file_bytes; },
            "Of the file that a stopped render leaves, at most; 0: there will be none.")
        .def_prop_ro(
            "log", [](const SceneSummary& s) { return s.log; }, "What the scene asks of the log.");

    nb::class_<LogSettings>(module, "LogSettings", "What a scene asks of the log.")
        .def_ro("verbosity", &LogSettings::verbosity,
                "0: errors; 1: warnings, progress and a summary; 2 and more: everything.")
        .def_ro("max_warnings", &LogSettings::max_warnings, "Warnings that are printed.")
        .def_ro("file", &LogSettings::file, "Gets what is printed; empty: none.")
        .def_ro("stats_file", &LogSettings::stats_file, "For statistics; empty: none.")
        .def_ro("stats_append", &LogSettings::stats_append, "After what that file holds.");

    nb::class_<RenderProgress>(module, "RenderProgress", "How far a render is.")
        .def_ro("samples_done", &RenderProgress::samples_done, "Camera samples taken.")
        .def_ro("samples_total", &RenderProgress::samples_total,
                "Camera samples in all; 0 before the first bucket.")
        .def_ro("seconds", &RenderProgress::seconds, "Since the first ray.")
        .def_ro("noise", &RenderProgress::noise,
                "Of the buckets that are done: a pixel's standard error over how bright pixels "
                "are; below 0: not known yet.");

    nb::class_<Outcome>(module, "Outcome", "What a render gave.")
        .def_prop_ro(
            "stopped", [](const Outcome& o) { return o.result.stopped; },
            "Ended early: what was done is in the files.")
        .def_ro("interrupted", &Outcome::interrupted, "By Ctrl-C.")
        .def_prop_ro(
            "seconds", [](const Outcome& o) { return o.result.seconds; },
            "Sampling, without compile and files.")
        .def_prop_ro(
            "output_seconds", [](const Outcome& o) { return o.result.output_seconds; },
            "Spent in drivers.")
        .def_prop_ro(
            "samples", [](const Outcome& o) { return o.result.samples; }, "Camera samples taken.")
        .def_prop_ro(
            "training_samples", [](const Outcome& o) { return o.result.training_samples; },
            "Camera samples that guiding learned from, not in `samples`.")
        .def_prop_ro(
            "resumed_samples", [](const Outcome& o) { return o.result.resumed_samples; },
            "Camera samples that a checkpoint had, not in `samples`.")
        .def_prop_ro(
            "checkpoint", [](const Outcome& o) { return o.result.checkpoint; },
            "File from which a later render can go on; empty if there is none.")
        .def_prop_ro(
            "rays", [](const Outcome& o) { return o.result.rays; }, "Closest-hit and shadow rays.")
        .def_prop_ro(
            "rays_by_kind",
            [](const Outcome& o) {
                nb::dict out;
                for (std::size_t i = 0; i < kRayKindNames.size(); ++i)
                    out[nb::str(kRayKindNames[i].data(), kRayKindNames[i].size())] =
                        nb::int_(o.result.rays_by_kind[i]);
                return out;
            },
            nb::sig("def rays_by_kind(self) -> dict[str, int]"),
            "The same, by what they were traced for.")
        .def_prop_ro(
            "memory", [](const Outcome& o) { return to_dict(o.result.memory.by_name()); },
            nb::sig("def memory(self) -> dict[str, int]"),
            "Memory by what it holds [bytes], at the end; `other` is the rest of `peak_memory`.")
        .def_prop_ro(
            "peak_memory", [](const Outcome& o) { return o.result.peak_memory; },
            "The most that the process ever held [bytes]; 0: not known.")
        .def_prop_ro(
            "noise",
            [](const Outcome& o) {
                std::vector<std::tuple<std::string, double, double, double>> out;
                for (const LayerNoise& layer : o.result.noise)
                    out.emplace_back(layer.name, layer.mean, layer.level, layer.error);
                return out;
            },
            "Of each layer of light its name, mean luminance, root mean square luminance, and the "
            "standard error of a pixel's luminance (root mean square), as halves of the samples "
            "tell.")
        .def_prop_ro(
            "dropped_samples", [](const Outcome& o) { return o.result.dropped_samples; },
            "Contributions that were not finite.")
        .def_prop_ro(
            "files", [](const Outcome& o) { return o.result.files; }, "Written.")
        .def_prop_ro(
            "width", [](const Outcome& o) { return o.result.width; },
            "Of the rendered region [pixels].")
        .def_prop_ro(
            "height", [](const Outcome& o) { return o.result.height; },
            "Of the rendered region [pixels].")
        .def_prop_ro(
            "layers", [](const Outcome& o) { return o.layers; },
            nb::sig("def layers(self) -> list[tuple[ImageLayer, numpy.ndarray]]"),
            "If they were captured: each layer with its pixels, shape (height, width, channels), "
            "row 0 at the top.");
}

}  // namespace

void add_render(nb::module_& module) {
    add_options(module);
    add_results(module);
    nb::class_<CompiledScene>(module, "CompiledScene",
                              "A scene, read and compiled, ready to render.")
        .def(nb::init<const std::string&, RenderOptions, bool, const std::vector<std::string>&>(),
             "path"_a, "options"_a, "strict"_a = false,
             "assignments"_a = std::vector<std::string>{},
             "Reads and compiles; never raises for bad input: `diagnostics` has it, `usable` "
             "tells.")
        .def_prop_ro("usable", &CompiledScene::usable,
                     "False if there were errors that forbid rendering.")
        .def_prop_ro("diagnostics", &CompiledScene::diagnostics,
                     nb::sig("def diagnostics(self) -> tuple[lightsieve.errors.Diagnostic, ...]"),
                     "Everything kept so far, also of rendering.")
        .def_prop_ro("n_errors", &CompiledScene::n_errors, "Errors, also those not kept.")
        .def_prop_ro("n_warnings", &CompiledScene::n_warnings, "Warnings, also those not kept.")
        .def_prop_ro("n_lints", &CompiledScene::n_lints, "Lints, also those not kept.")
        .def_prop_ro("times", &CompiledScene::times,
                     nb::sig("def times(self) -> dict[str, float]"),
                     "Where the time went so far, by stage [s]; only if it is usable.")
        .def("summary", &CompiledScene::summary, "What the scene holds; only if it is usable.")
        .def_prop_ro("events", &CompiledScene::events,
                     "Every event that its paths can be made of, as text; only if it is usable.")
        .def_prop_ro("definitions", &CompiledScene::definitions,
                     "Name and text of the expressions that it defines; only if it is usable.")
        .def_prop_ro("lpe_table", &CompiledScene::lpe_table,
                     "`reference` or `arnold7`; only if it is usable.")
        .def_prop_ro(
            "layer_samples", &CompiledScene::layer_samples,
            "Two numbers a layer of the summary: layers with the same two are sums of the "
            "same samples and can be added up.")
        .def("render", &CompiledScene::render, "progress"_a = nb::none(),
             nb::sig("def render(self, progress: collections.abc.Callable[[RenderProgress], "
                     "object] | None = None) -> Outcome"),
             "Renders; Ctrl-C ends it early. `progress` is called about ten times a second.");
}

}  // namespace lightsieve::python
