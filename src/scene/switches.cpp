#include "scene/switches.h"

#include <algorithm>
#include <array>

#include "scene/graph_editor.h"

namespace lightsieve {
namespace {

/// `option` on: every node with `param` gets `value`, and no shader drives it any more.
struct Reset {
    std::string_view option, param, value;
};
constexpr std::array kResets{
    Reset{"ignore_dof", "aperture_size", "0"},
    Reset{"ignore_smoothing", "smoothing", "off"},
    Reset{"ignore_subdivision", "subdiv_type", "none"},
    Reset{"ignore_displacement", "disp_map", "NULL"},
    Reset{"ignore_shadows", "cast_shadows", "off"},
    Reset{"ignore_sss", "subsurface", "0"},
    Reset{"ignore_sss", "subsurface_weight", "0"},
    Reset{"ignore_sss", "Ksss", "0"},
    Reset{"ignore_shaders", "shader", "NULL"},
    Reset{"ignore_shaders", "instance_shader", "NULL"},
};

bool is_motion_list(const ParamInfo& info) {
    return info.is_array && info.name.view() == "matrix";
}

}  // namespace

/// Edits all scopes of a graph.
class SwitchBoard {
  public:
    SwitchBoard(SceneGraph& graph, Diagnostics& diagnostics)
        : graph_(graph), diagnostics_(diagnostics) {}

    void run() {
        leave_out_nodes();
        for (const Reset& row : kResets)
            if (on(row.option)) reset(row.param, row.value);
        if (on("ignore_textures"))
            unlink([](const Link& link) { return link.source->type().name.view() == "image"; });
        if (on("ignore_bump"))
            unlink([](const Link& link) {
                return link.param->type == ParamType::Vector &&
                       link.param->name.view().ends_with("normal");
            });
        if (on("ignore_motion")) each([](NodeInstance& node) { keep_first_keys(node); });
        if (on("ignore_motion_blur")) close_shutters();
    }

  private:
    [[nodiscard]] bool on(Name option) const {
        const bool* value = graph_.options()->find<bool>(option);
        return value != nullptr && *value;
    }
    [[nodiscard]] static std::vector<NodeScope*> scopes_of(SceneGraph& graph) {
        std::vector<NodeScope*> out;
        for (const auto& scope : graph.scopes_)
            out.push_back(scope.get());
        return out;
    }
    template <class Act>
    void each(const Act& act) {
        for (NodeScope* scope : scopes_of(graph_))
            for (const auto& node : scope->nodes)
                act(*node);
    }

    /// ignore_lights, and ignore_list: types of nodes.
    void leave_out_nodes() {
        const auto* listed = graph_.options()->find<Array<Name>>("ignore_list");
        const bool no_lights = on("ignore_lights");
        const bool some = listed != nullptr && !listed->empty();
        if (!some && !no_lights) return;
        for (NodeScope* scope : scopes_of(graph_)) {
            std::vector<NodeInstance*> out;
            for (const auto& node : scope->nodes) {
                const bool ignored =
                    some && std::find(listed->data, listed->data + listed->n, node->type().name) !=
                                listed->data + listed->n;
                if (ignored || (no_lights && node->kind() == NodeKind::Light))
                    out.push_back(node.get());
            }
            GraphEditor(graph_, *scope, graph_.unknown_, diagnostics_).disable(out);
        }
    }

    void reset(Name param, std::string_view value) {
        for (NodeScope* scope : scopes_of(graph_)) {
            GraphEditor editor(graph_, *scope, graph_.unknown_, diagnostics_);
            for (const auto& node : scope->nodes)
                if (node->type().find(param) != nullptr) editor.set(*node, param.view(), value);
        }
    }

    /// Shutters stay as they are if all of them are open at reference_time: samples are taken at that time alone, and motion
    /// vectors know what moves meanwhile. Else all of them close.
    void close_shutters() {
        const auto* reference = graph_.options()->find<float>("reference_time");
        const float time = reference == nullptr ? 0 : *reference;
        bool open = true;
        each([&](const NodeInstance& node) {
            const auto* start = node.find<float>("shutter_start");
            const auto* end = node.find<float>("shutter_end");
            if (start != nullptr && end != nullptr) open &= *start <= time && time <= *end;
        });
        if (open) return;
        const std::string at = std::to_string(time);
        reset("shutter_start", at);
        reset("shutter_end", at);
    }

    template <class Which>
    void unlink(const Which& which) {
        each([&](NodeInstance& node) { std::erase_if(node.links_, which); });
    }

    /// As if nothing had motion keys. Arrays lie in blocks, key after key.
    static void keep_first_keys(NodeInstance& node) {
        for (const ParamInfo& info : node.type().params) {
            if (!info.is_array) continue;
            auto& array = *reinterpret_cast<Array<std::byte>*>(node.block_ + info.offset);
            // A matrix array of n elements and one key means n keys, too.
            if (is_motion_list(info) && array.n_keys == 1) array.n = std::min(array.n, 1U);
            array.n_keys = 1;
        }
    }

    SceneGraph& graph_;
    Diagnostics& diagnostics_;
};

void apply_switches(SceneGraph& graph, Diagnostics& diagnostics) {
    if (graph.options() != nullptr) SwitchBoard(graph, diagnostics).run();
}

}  // namespace lightsieve
