// Renders a scene in memory and prints the figures: the program to give to perf, callgrind and the like.
//
//     render_profile SCENE.ass [SAMPLES_PER_PIXEL [THREADS [builtins]]]
//
// "builtins" asks for every built-in AOV, and for it in every light group, beside the beauty. No Russian roulette, no files.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>

#include "lpe/builtins.h"
#include "nodes/all_nodes.h"
#include "render/render.h"
#include "scene/ass_read.h"
#include "scene/graph.h"
#include "scene/registry.h"

namespace lightsieve {
namespace {

int profile(int argc, char** argv) {
    RenderOptions options;
    options.scene_path = argv[1];
    options.spp = argc > 2 ? std::atoi(argv[2]) : 0;
    options.threads = argc > 3 ? std::atoi(argv[3]) : 1;
    options.roulette_depth = -1;
    options.write_files = false;
    if (argc > 4 && std::string_view(argv[4]) == "builtins")
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
    const ScenePtr scene = compile_scene(graph, options, diagnostics);
    std::fputs(diagnostics.render().c_str(), stderr);
    if (!scene) return 1;
    const std::clock_t start = std::clock();
    const RenderResult result = render_scene(*scene, {}, diagnostics);
    const double processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf(
        "%.3f s, %.3f s of processors, %.0f samples, %.2f rays a sample, %.3f million rays/s\n",
        result.seconds, processor, static_cast<double>(result.samples),
        static_cast<double>(result.rays) / static_cast<double>(result.samples),
        static_cast<double>(result.rays) / result.seconds * 1e-6);
    return 0;
}

}  // namespace
}  // namespace lightsieve

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("usage: render_profile SCENE.ass [SAMPLES_PER_PIXEL [THREADS [builtins]]]\n",
                   stderr);
        return 2;
    }
    return lightsieve::profile(argc, argv);
}
