// Filters, passes, drivers and file names. See compiler.h.
#include <algorithm>
#include <cstring>
#include <filesystem>

#include "render/compiler.h"

namespace lightsieve {
namespace {

namespace fs = std::filesystem;

/// Driver node types by file extension, for `-o picture.png`.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kDriverOfExtension{
    {{".exr", "driver_exr"},
     {".jpg", "driver_jpeg"},
     {".jpeg", "driver_jpeg"},
     {".png", "driver_png"},
     {".tif", "driver_tiff"},
     {".tiff", "driver_tiff"}}};

std::string_view driver_for(const fs::path& path) {
    for (const auto& [extension, driver] : kDriverOfExtension)
        if (path.extension() == extension) return driver;
    return {};
}

/// A copy of a parameter block with another file name.
class DriverBlock {
  public:
    DriverBlock(const NodeType& type, const void* block)
        : type_(type), bytes_((type.block_size + 15) / 16) {
        std::memcpy(bytes_.data(), block, type.block_size);
    }
    [[nodiscard]] const void* data() const { return bytes_.data(); }
    [[nodiscard]] std::string filename() const {
        Name name;
        if (const ParamInfo* info = type_.find("filename"))
            std::memcpy(static_cast<void*>(&name), at(info->offset), sizeof(name));
        return name.str();
    }
    void set_filename(const std::string& filename) {
        const Name name(filename);
        if (const ParamInfo* info = type_.find("filename"))
            std::memcpy(at(info->offset), static_cast<const void*>(&name), sizeof(name));
    }

  private:
    struct alignas(16) Line {
        std::byte bytes[16];
    };
    [[nodiscard]] std::byte* at(std::size_t offset) const {
        return const_cast<std::byte*>(reinterpret_cast<const std::byte*>(bytes_.data())) + offset;
    }
    const NodeType& type_;
    std::vector<Line> bytes_;
};

bool names_a_folder(const std::string& output) {
    std::error_code ignored;
    return output.back() == '/' || fs::is_directory(output, ignored) ||
           fs::path(output).extension().empty();
}

/// Mean of `eval` over the filter's square times its area.
float integrate(const PixelFilter& filter) {
    constexpr int kSteps = 512;
    const float r = filter.radius(), step = 2 * r / kSteps;
    double sum = 0;
    for (int y = 0; y < kSteps; ++y)
        for (int x = 0; x < kSteps; ++x)
            sum += double{filter.eval({(static_cast<float>(x) + 0.5F) * step - r,
                                       (static_cast<float>(y) + 0.5F) * step - r})};
    return static_cast<float>(sum * double{step} * double{step});
}

bool has_negative_lobes(const PixelFilter& filter) {
    constexpr int kSteps = 64;
    for (int x = 0; x < kSteps; ++x)
        if (filter.eval({filter.radius() * (static_cast<float>(x) + 0.5F) / kSteps, 0}) < 0)
            return true;
    return false;
}

bool is_deep(const PlannedDriver& driver) {
    return driver.node != nullptr && driver.node->type().name == Name("driver_deepexr");
}

/// Depth and alpha are in every deep file, whoever asks for them.
bool is_always_deep(const PlannedLayer& layer) {
    return layer.source == LayerSource::Depth || layer.source == LayerSource::Alpha;
}

}  // namespace

/// What need not be traced. Clamps and adaptive sampling look at all light, be it asked for or not: with them AOVs would be
/// others than those of a full render.
void Compiler::find_culling() {
    const RenderSettings& s = scene_->settings;
    const AovPlan& plan = scene_->plan;
    if (plan.wants_beauty) return;
    constexpr float kNoClamp = 1e30F;
    const bool adaptive = s.samples_max > s.samples && !plan.adaptive_layer;
    if (!adaptive && s.sample_clamp >= kNoClamp) {
        scene_->culling = s.indirect_clamp < kNoClamp ? Culling::Paths : Culling::Lobes;
        return;
    }
    const char* param = adaptive ? "enable_adaptive_sampling" : "AA_sample_clamp";
    if (std::ranges::any_of(plan.layers,
                            [](const PlannedLayer& layer) { return is_light(layer.source); }))
        diagnostics_.lint(
            Code::OutputCulling,
            "all light is traced, though no output is the beauty: " + std::string(param) +
                " looks at it",
            option_place(param), "without it only what the outputs can show is traced");
}

void Compiler::find_adaptive_layer() {
    const Name wanted = option<Name>("adaptive_aov", {});
    if (wanted.empty() || scene_->settings.samples_max <= scene_->settings.samples) return;
    AovPlan& plan = scene_->plan;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < plan.layers.size(); ++i) {
        const PlannedLayer& layer = plan.layers[i];
        const PixelFilter* filter = plan.views[layer.view].filter.get();
        // Noise is known of means of light.
        if (!is_light(layer.source) || filter == nullptr || filter->reduction() != Reduction::Mean)
            continue;
        if (!plan.adaptive_layer && layer.info.aov == wanted.view()) plan.adaptive_layer = i;
        names.push_back(layer.info.aov);
    }
    if (plan.adaptive_layer) return;
    const std::string nearest = did_you_mean(wanted.view(), names);
    diagnostics_.warning(Code::InvalidValue,
                         "adaptive_aov \"" + wanted.str() + "\" is no filtered output of light",
                         option_place("adaptive_aov"),
                         nearest.empty() ? "the noise of the beauty decides" : nearest);
}

/// Motion is that while the shutter is open.
void Compiler::check_motion() {
    const RenderSettings& s = scene_->settings;
    if (!scene_->plan.wants_motion || s.shutter_end > s.shutter_start) return;
    const NodeInstance* camera = default_camera();
    const std::string_view hint =
        s.instant ? "with ignore_motion_blur, reference_time must lie within the shutter of every "
                    "camera, from shutter_start to shutter_end"
                  : "give the camera a shutter_end after its shutter_start, for example 0 and 1; "
                    "options.ignore_motion_blur on keeps the picture sharp";
    diagnostics_.warning(
        Code::OutputStill, "motionvector is zero everywhere: the shutter opens for no time",
        camera != nullptr ? camera->where("shutter_end") : SourceSpan{}, std::string(hint));
}

/// Deep files hold light, of one camera.
void Compiler::check_deep(PlannedDriver& planned) {
    const AovPlan& plan = scene_->plan;
    std::erase_if(planned.layers,
                  [&](std::uint32_t layer) { return is_always_deep(plan.layers[layer]); });
    const SourceSpan where = planned.node->where();
    const auto refuse = [&](const std::string& what, const std::string& hint) {
        diagnostics_.error(
            Code::OutputLayers,
            "the deep file of \"" + planned.node->name().str() + "\" cannot hold " + what, where,
            hint);
    };
    if (planned.layers.empty())
        return refuse("depth and alpha alone", "add an output of light, RGBA for example");
    for (const std::uint32_t index : planned.layers) {
        const PlannedLayer& layer = plan.layers[index];
        const bool has_depth = layer.source == LayerSource::Beauty ||
                               layer.source == LayerSource::Expression ||
                               layer.source == LayerSource::Black;
        if (!has_depth)
            return refuse("\"" + layer.info.aov + '"',
                          "light path expressions, Z and A are possible");
        if (layer.pass != plan.layers[planned.layers[0]].pass)
            return refuse("what two cameras see", "give each camera a driver of its own");
    }
}

void Compiler::make_views() {
    for (FilterView& view : scene_->plan.views) {
        const NodeType* type =
            view.node != nullptr ? &view.node->type() : graph_.registry().find("gaussian_filter");
        LIGHTSIEVE_ASSERT(type != nullptr && type->make_filter != nullptr, "no filter");
        CompileContext context(*this, view.node,
                               view.node != nullptr ? view.node->name() : Name("gaussian_filter"));
        view.filter = type->make_filter(
            view.node != nullptr ? view.node->block() : type->default_block.data(), context);
        if (!view.filter) continue;
        view.integral = integrate(*view.filter);
        view.is_signed = has_negative_lobes(*view.filter);
    }
    for (PlannedLayer& layer : scene_->plan.layers) {
        const FilterView& view = scene_->plan.views[layer.view];
        layer.info.filter =
            view.node != nullptr ? view.node->type().name.str() : "gaussian_filter";
        if (!view.filter) continue;
        layer.info.filter_width = 2 * view.filter->radius();
        if (!view.filter->shows_heat()) continue;
        layer.info.n_channels = std::max<std::size_t>(layer.info.n_channels, 3);
        layer.info.is_color = false;
    }
}

/// One pass a camera, its samples placed by the filter of its beauty. Layers whose filter reaches farther than that get a pass
/// of their own, so that the beauty's samples never depend on what else is asked for.
void Compiler::part_passes() {
    AovPlan& plan = scene_->plan;
    if (std::any_of(plan.views.begin(), plan.views.end(),
                    [](const FilterView& v) { return !v.filter; }))
        return;
    const std::size_t n_cameras = plan.passes.size();
    const auto add_view = [](Pass& pass, std::uint32_t view) {
        if (std::find(pass.views.begin(), pass.views.end(), view) == pass.views.end())
            pass.views.push_back(view);
    };
    for (std::uint32_t p = 0; p < n_cameras; ++p) {
        // The filter that places the samples: the beauty's, else the first that is a mean, else the first.
        const PlannedLayer* main = nullptr;
        const auto rank = [&](const PlannedLayer& l) {
            if (plan.views[l.view].filter->reduction() != Reduction::Mean) return 0;
            return l.source == LayerSource::Beauty ? 2 : 1;
        };
        for (const PlannedLayer& layer : plan.layers)
            if (layer.pass == p && (main == nullptr || rank(layer) > rank(*main))) main = &layer;
        if (main == nullptr) continue;
        const std::uint32_t sampling = main->view;
        // The layers of a deep file share their samples, and so their weights.
        for (PlannedLayer& layer : plan.layers)
            if (layer.pass == p && is_deep(plan.drivers[layer.driver])) {
                layer.view = plan.layers[plan.drivers[layer.driver].layers[0]].view;
                if (plan.views[layer.view].filter->reduction() != Reduction::Mean)
                    layer.view = sampling;
            }
        plan.passes[p].sampling_view = sampling;
        add_view(plan.passes[p], sampling);
        for (PlannedLayer& layer : plan.layers) {
            if (layer.pass != p) continue;
            // One sample makes no mask, nor do differences.
            const bool is_matte =
                layer.source == LayerSource::Matte || layer.source == LayerSource::MattePreview;
            if (is_matte && plan.views[layer.view].filter->reduction() != Reduction::Mean)
                layer.view = sampling;
            const PixelFilter& filter = *plan.views[layer.view].filter;
            if (filter.reduction() != Reduction::Mean || layer.view == sampling ||
                filter.radius() <= plan.views[sampling].filter->radius()) {
                add_view(plan.passes[p], layer.view);
                continue;
            }
            std::uint32_t other = static_cast<std::uint32_t>(n_cameras);
            while (other < plan.passes.size() &&
                   !(plan.passes[other].camera_node == plan.passes[p].camera_node &&
                     plan.passes[other].sampling_view == layer.view))
                ++other;
            if (other == plan.passes.size()) {
                Pass pass{plan.passes[p].camera_node, nullptr, layer.view, {layer.view}};
                if (pass.camera_node != nullptr) {
                    CompileContext context(*this, pass.camera_node, pass.camera_node->name());
                    pass.camera =
                        pass.camera_node->type().make_camera(pass.camera_node->block(), context);
                }
                plan.passes.push_back(std::move(pass));
            }
            layer.pass = other;
        }
    }
}

void Compiler::make_drivers() {
    for (std::size_t i = 0; i < scene_->plan.drivers.size(); ++i)
        make_driver(scene_->plan.drivers[i], i);
}

void Compiler::make_driver(PlannedDriver& planned, std::size_t index) {
    const bool to_picture =
        !options_.output.empty() && !names_a_folder(options_.output) && index == 0;
    const NodeType* type =
        planned.node != nullptr ? &planned.node->type() : graph_.registry().find("driver_exr");
    const void* block =
        planned.node != nullptr ? planned.node->block() : type->default_block.data();
    if (to_picture) {
        const std::string_view wanted = driver_for(options_.output);
        if (wanted.empty()) {
            return diagnostics_.error(Code::OutputBad,
                                      "no driver writes \"" + options_.output + '"', {},
                                      ".exr, .png, .jpg, .tif and .tiff are known; a name without "
                                      "extension is a folder");
        }
        if (type->name != Name(wanted)) {
            type = graph_.registry().find(wanted);
            block = type->default_block.data();
        }
    }
    DriverBlock copy(*type, block);
    std::string filename = expand_variables(copy.filename());
    if (filename.empty()) {
        const std::string stem = options_.scene_path.empty()
                                     ? "render"
                                     : fs::path(options_.scene_path).filename().string();
        filename = fs::path(stem.substr(0, stem.find(".ass"))).string() + ".exr";
        if (planned.node != nullptr)
            diagnostics_.warning(Code::OutputBad,
                                 "the driver \"" + planned.node->name().str() +
                                     "\" has no filename; it writes \"" + filename + '"',
                                 planned.node->where());
    }
    if (to_picture) {
        filename = options_.output;
    } else if (!options_.output.empty() && names_a_folder(options_.output) &&
               fs::path(filename).is_relative()) {
        filename = (fs::path(options_.output) / filename).string();
    }
    copy.set_filename(filename);
    CompileContext context(
        *this, planned.node,
        planned.node != nullptr ? planned.node->name() : Name("<default driver>"));
    planned.driver = type->make_driver(copy.data(), context);
    if (planned.driver && planned.driver->deep()) {
        scene_->plan.wants_deep = true;
        check_deep(planned);
    }
    attach_imagers(planned);
    const bool one_layer_only = type->name == Name("driver_png") ||
                                type->name == Name("driver_jpeg") ||
                                type->name == Name("driver_tiff");
    if (one_layer_only && planned.layers.size() > 1) {
        const SourceSpan where = planned.node != nullptr ? planned.node->where() : SourceSpan{};
        diagnostics_.error(Code::DriverConflict,
                           "a " + type->name.str() + " holds one layer, but " +
                               std::to_string(planned.layers.size()) + " outputs go to it",
                           where, "use driver_exr, or one driver for each output");
    }
}

void Compiler::find_viewer_layers() {
    ViewerSettings& viewer = scene_->settings.viewer;
    if (options_.viewer.empty()) return;
    viewer.address = options_.viewer;
    const std::vector<PlannedLayer>& layers = scene_->plan.layers;
    // Ids are no picture: what can be looked at is numbers that are filtered.
    const auto shown = [](const PlannedLayer& layer) {
        return layer.source != LayerSource::Matte && layer.source != LayerSource::Id;
    };
    std::vector<std::string> names;
    for (const PlannedLayer& layer : layers)
        names.push_back(layer.info.name);
    for (const std::string& wanted : options_.viewer_layers) {
        const std::size_t before = viewer.layers.size();
        for (std::size_t i = 0; i < layers.size(); ++i)
            if (wanted == "*" ? shown(layers[i]) : names[i] == wanted) viewer.layers.push_back(i);
        if (viewer.layers.size() == before)
            diagnostics_.error(Code::UnknownLayer,
                               "no output is called \"" + wanted + "\", so no viewer can show it",
                               {}, did_you_mean(wanted, names));
    }
    if (options_.viewer_layers.empty() && !layers.empty()) viewer.layers.push_back(0);
}

void Compiler::check_files() {
    std::map<std::string, std::size_t> writer;
    for (std::size_t i = 0; i < scene_->plan.drivers.size(); ++i) {
        const PlannedDriver& planned = scene_->plan.drivers[i];
        if (!planned.driver) continue;
        std::error_code ignored;
        const std::string path = fs::weakly_canonical(planned.driver->path(), ignored).string();
        if (const auto [at, is_new] = writer.try_emplace(path, i); !is_new)
            diagnostics_.error(
                Code::DriverConflict, "two drivers write \"" + planned.driver->path() + '"',
                planned.node != nullptr ? planned.node->where("filename") : SourceSpan{},
                "give each driver a file of its own");
    }
}

}  // namespace lightsieve
