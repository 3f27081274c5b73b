// Renders a scene in memory and prints the figures: the program to give to perf, callgrind and the like.
//
//     render_profile SCENE.ass [SAMPLES_PER_PIXEL [THREADS [builtins] [noise] [guiding]]]
//
// "builtins" asks for every built-in AOV, and for it in every light group, beside the beauty. "noise" renders once more with
// another seed and prints the variance of a pixel's channel, and 1 / (variance * processor time); training of "guiding" is in
// that time. No Russian roulette, no files.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "lpe/builtins.h"
#include "nodes/all_nodes.h"
#include "render/render.h"
#include "scene/ass_read.h"
#include "scene/graph.h"
#include "scene/registry.h"

namespace lightsieve {
namespace {

/// Mean over the pixels of half the squared difference of two beauties; the brightest 0.1 % are left out.
double variance(const RenderResult& a, const RenderResult& b) {
    const FrameLayer& first = a.layers.at(0);
    const FrameLayer& second = b.layers.at(0);
    const auto n = static_cast<std::size_t>(first.info.n_channels);
    std::vector<double> squares(first.pixels.size() / n);
    for (std::size_t i = 0; i < squares.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const double d = double{first.pixels[i * n + c]} - double{second.pixels[i * n + c]};
            squares[i] += d * d / 6;
        }
    std::ranges::sort(squares);
    squares.resize(squares.size() - squares.size() / 1000);
    double sum = 0;
    for (const double square : squares)
        sum += square;
    return sum / static_cast<double>(squares.size());
}

struct Profile {
    RenderResult result;
    double processor = 0;  ///< time of all threads [s]
};

Profile render_once(SceneGraph& graph, const RenderOptions& options, Diagnostics& diagnostics) {
    const ScenePtr scene = compile_scene(graph, options, diagnostics);
    std::fputs(diagnostics.render().c_str(), stderr);
    if (!scene) std::exit(1);
    const std::clock_t start = std::clock();
    Profile out{render_scene(*scene, {}, diagnostics)};
    out.processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return out;
}

int profile(int argc, char** argv) {
    RenderOptions options;
    options.scene_path = argv[1];
    options.spp = argc > 2 ? std::atoi(argv[2]) : 0;
    options.threads = argc > 3 ? std::atoi(argv[3]) : 1;
    options.roulette_depth = -1;
    options.write_files = false;
    const auto said = [&](std::string_view word) {
        return std::find(argv + std::min(argc, 4), argv + argc, word) != argv + argc;
    };
    options.guiding = said("guiding");
    if (said("builtins"))
        for (const lpe::Builtin& row : lpe::builtins()) {
            const std::string name(row.name);
            if (name != "RGBA") options.aovs.push_back(name + " RGB");
            // An albedo ends at no light: it has no groups.
            if (name.find("albedo") == std::string::npos) options.aovs.push_back(name + "_* RGB");
        }

    Diagnostics diagnostics;
    Registry registry;
    add_all_nodes(registry);
    const Document document = read_ass_file(options.scene_path, diagnostics);
    SceneGraph graph = build_graph(document, registry, {}, diagnostics);
    const bool noise = said("noise");
    options.capture = noise;
    const Profile first = render_once(graph, options, diagnostics);
    const RenderResult& result = first.result;
    std::printf(
        "%.3f s, %.3f s of processors, %.0f samples, %.2f rays a sample, %.3f million rays/s\n",
        result.seconds, first.processor, static_cast<double>(result.samples),
        static_cast<double>(result.rays) / static_cast<double>(result.samples),
        static_cast<double>(result.rays) / result.seconds * 1e-6);
    if (!noise) return 0;
    options.seed = 12;
    const Profile second = render_once(graph, options, diagnostics);
    const double v = variance(result, second.result);
    std::printf("variance %.4g, 1 / (variance * time) %.4g\n", v,
                2 / (v * (first.processor + second.processor)));
    return 0;
}

}  // namespace
}  // namespace lightsieve

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fputs(
            "usage: render_profile SCENE.ass [SAMPLES_PER_PIXEL [THREADS [builtins] [noise] "
            "[guiding]]]\n",
            stderr);
        return 2;
    }
    return lightsieve::profile(argc, argv);
}
