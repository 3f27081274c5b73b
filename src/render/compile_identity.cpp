// What makes this render this render: a checkpoint must agree with it.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/fingerprint.h"
#include "core/version.h"
#include "render/compiler.h"
#include "render/guide_training.h"

namespace lightsieve {
namespace {

/// Of an asset, so much is looked at from either end [bytes]: enough to see that a file was replaced by another.
constexpr std::streamoff kLookedAt = 1 << 16;

void add_file(Fingerprint& sum, const std::string& path) {
    std::error_code ignored;
    const std::uintmax_t size = std::filesystem::file_size(path, ignored);
    sum.add(path);
    sum.add(std::uint64_t{size});
    std::ifstream file(path, std::ios::binary);
    std::string part(kLookedAt, '\0');
    const auto add_part = [&] {
        file.read(part.data(), kLookedAt);
        sum.add(std::string_view(part.data(), static_cast<std::size_t>(file.gcount())));
    };
    add_part();
    if (size > static_cast<std::uintmax_t>(2 * kLookedAt)) {
        file.clear();
        file.seekg(-kLookedAt, std::ios::end);
        add_part();
    }
}

/// Names of the layers for people, and everything about them for sure.
std::pair<std::string, std::string> layers_of(const AovPlan& plan) {
    std::string names;
    Fingerprint sum;
    for (const PlannedLayer& layer : plan.layers) {
        const ImageLayer& info = layer.info;
        names += (names.empty() ? "" : ", ") + info.name;
        for (const std::string& text :
             {info.name, info.aov, info.aov_type, info.expression, info.light_group, info.filter,
              std::to_string(info.filter_width), std::to_string(layer.pass),
              std::to_string(layer.view)})
            sum.add(text);
        sum.add(static_cast<std::uint64_t>(layer.source));
    }
    return {names, sum.text()};
}

}  // namespace

void Compiler::identify() {
    const RenderSettings& s = scene_->settings;
    const AovPlan& plan = scene_->plan;
    Fingerprint assets;
    for (const std::string& path : assets_.found())
        add_file(assets, path);
    const auto [names, layers] = layers_of(plan);
    std::ostringstream adaptive;
    if (s.samples_max > s.samples)
        adaptive << s.samples << " to " << s.samples_max << " samples, threshold "
                 << s.adaptive_threshold << ", by layer "
                 << (plan.adaptive_layer ? plan.layers[*plan.adaptive_layer].info.name : "RGBA");
    else
        adaptive << "off";
    const auto number = [](auto value) { return std::to_string(value); };
    // Frame and region decide where buckets lie.
    scene_->identity = {
        {"version", std::string(kVersion)},
        {"scene", graph_.fingerprint().text()},
        {"textures and other files", assets.text()},
        {"layers", names},
        {"expressions, types and filters", layers},
        {"frame", number(s.width) + " x " + number(s.height)},
        {"region", number(s.region.x0) + "," + number(s.region.y0) + "," + number(s.region.x1) +
                       "," + number(s.region.y1)},
        {"bucket size", number(s.bucket_size)},
        {"seed", number(s.seed)},
        {"adaptive sampling", adaptive.str()},
        {"camera", options_.camera},
        {"Russian roulette", number(s.roulette_depth)},
        // A guide is learned anew, from as many samples as before.
        {"guiding", s.guiding ? "from " + number(training_samples(*scene_)) + " samples" : "off"},
        {"rendering space", options_.rendering_space},
        {"instruction set", options_.isa},
    };
    if (!options_.checkpoints || !options_.write_files || plan.drivers.empty()) return;
    scene_->settings.checkpoint = {plan.drivers.front().driver->path() + ".checkpoint",
                                   options_.checkpoint_minutes, options_.resume,
                                   options_.keep_checkpoint};
}

}  // namespace lightsieve
