// lightsieve_tool: checks or renders a scene from C++ alone, where Python would be in the way of a sanitizer or a
// debugger. It takes the few options that change what is executed; the command line for people is in python/.
//
//     lightsieve_tool check SCENE.ass
//     lightsieve_tool render SCENE.ass [-o PATH] [--aa N] [--spp N] [--size WxH] [--threads N]

#include <charconv>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/all_nodes.h"
#include "render/render.h"
#include "scene/ass_read.h"
#include "scene/graph.h"
#include "scene/registry.h"

namespace lightsieve {
namespace {

constexpr int kOk = 0, kInputError = 1, kUsageError = 2;
constexpr std::string_view kUsage =
    "usage: lightsieve_tool check SCENE.ass\n"
    "       lightsieve_tool render SCENE.ass [-o PATH] [--aa N] [--spp N] [--size WxH] [--threads "
    "N]\n";

struct Command {
    bool render = false;
    RenderOptions options;
};

/// A whole number of 1 or more, or nothing.
std::optional<int> number(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < 1) return std::nullopt;
    return value;
}

bool set_option(RenderOptions& options, std::string_view name, std::string_view value) {
    if (name == "-o") {
        options.output = value;
        return true;
    }
    if (name == "--size") {
        const std::size_t cross = std::min(value.find('x'), value.size());
        const auto width = number(value.substr(0, cross));
        const auto height = number(value.substr(std::min(cross + 1, value.size())));
        options.width = width.value_or(0);
        options.height = height.value_or(0);
        return width && height;
    }
    const std::optional<int> n = number(value);
    if (name == "--spp")
        options.spp = n.value_or(0);
    else if (name == "--aa")
        options.aa_samples = n.value_or(0);
    else if (name == "--threads")
        options.threads = n.value_or(0);
    else
        return false;
    return n.has_value();
}

std::optional<Command> parse_arguments(const std::vector<std::string_view>& arguments) {
    if (arguments.size() < 2 || (arguments[0] != "check" && arguments[0] != "render"))
        return std::nullopt;
    Command command;
    command.render = arguments[0] == "render";
    command.options.scene_path = arguments[1];
    if (arguments.size() % 2 != 0 || (!command.render && arguments.size() > 2))
        return std::nullopt;
    for (std::size_t i = 2; i < arguments.size(); i += 2)
        if (!set_option(command.options, arguments[i], arguments[i + 1])) return std::nullopt;
    return command;
}

int run(const Command& command, Diagnostics& diagnostics) {
    Registry registry;
    add_all_nodes(registry);
    const Document document = read_ass_file(command.options.scene_path, diagnostics);
    SceneGraph graph = build_graph(document, registry, {}, diagnostics);
    const ScenePtr scene = compile_scene(graph, command.options, diagnostics);
    if (!scene) return kInputError;
    const SceneSummary summary = summarize(*scene);
    std::printf("%zu shapes, %zu lights, %zu layers\n", summary.n_shapes, summary.n_lights,
                summary.layers.size());
    // Whoever ends this run for taking too long wants to know whether it had begun.
    std::fflush(stdout);
    if (command.render) {
        const RenderResult result = render_scene(*scene, {}, diagnostics);
        std::printf("%llu samples in %.2f s\n", static_cast<unsigned long long>(result.samples),
                    result.seconds);
        for (const std::string& file : result.files)
            std::printf("wrote %s\n", file.c_str());
    }
    return diagnostics.has_errors() ? kInputError : kOk;
}

int tool_main(const std::vector<std::string_view>& arguments) {
    const std::optional<Command> command = parse_arguments(arguments);
    if (!command) {
        std::fputs(kUsage.data(), stderr);
        return kUsageError;
    }
    Diagnostics diagnostics;
    int code = kInputError;
    try {
        code = run(*command, diagnostics);
    } catch (const InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "error[limit-memory]: not enough memory\n");
    }
    std::fputs(diagnostics.render().c_str(), stderr);
    return code;
}

}  // namespace
}  // namespace lightsieve

int main(int argc, char** argv) { return lightsieve::tool_main({argv + 1, argv + argc}); }
