// Shapes that hold volumes. See compiler.h.
#include <algorithm>

#include "render/compiler.h"

namespace lightsieve {
namespace {

/// Whether the network says what fills a volume.
bool fills_volumes(const ShaderProgram& program) {
    return program.type().fills_volumes ||
           std::any_of(program.parts.begin(), program.parts.end(),
                       [](const ShaderProgram* part) { return fills_volumes(*part); });
}

bool ends_with(std::string_view text, std::string_view end) {
    return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// Whether a shape parts what is inside of it from what is outside. Of meshes nobody knows.
bool is_closed(const decltype(ShapeGeometry::data)& data) {
    const auto* points = std::get_if<PointList>(&data);
    return std::holds_alternative<TriangleMesh>(data) ||
           std::holds_alternative<SphereList>(data) ||
           (points != nullptr && points->mode == PointList::Mode::Sphere);
}

}  // namespace

bool Compiler::add_volume(const ShapeLeaf& leaf, const SceneObject& object) {
    const NodeInstance& node = *leaf.outermost;
    const float step_size = leaf.step_size;
    const bool is_volume = object.geometry->is_volume;
    if (!is_volume && !(step_size > 0)) return false;
    const ShaderProgram& shader = *object.shaders[0];
    if (!fills_volumes(shader)) {
        diagnostics_.warning(
            Code::ShapeBad,
            "\"" + node.name().str() + "\" holds a volume, but " + shader.type().name.str() +
                " says nothing of what is inside; " +
                (is_volume ? "the volume is left out" : "it is rendered as a surface"),
            node.where(is_volume ? "shader" : "step_size"),
            "assign a standard_volume" + std::string(is_volume ? "" : ", or set step_size to 0"));
        return is_volume;
    }
    if (!is_closed(object.geometry->data)) {
        diagnostics_.warning(Code::ShapeBad,
                             "shapes of type " + leaf.shape->type().name.str() +
                                 " have no inside: the volume of \"" + node.name().str() +
                                 "\" is left out",
                             node.where("step_size"));
        return true;
    }
    if (object.matte)
        diagnostics_.warning(Code::ParamPending, "matte has no effect on volumes yet",
                             node.where("matte"), "the volume is seen as any other");
    if (leaf.use_shadow_group)
        diagnostics_.warning(Code::ParamPending, "shadow_group has no effect on volumes yet",
                             node.where("use_shadow_group"),
                             "the volume casts shadows in the light of every light");
    if (!object.self_shadows)
        diagnostics_.warning(Code::ParamPending, "self_shadows off has no effect on volumes yet",
                             node.where("self_shadows"), "the volume casts shadows on itself");
    SceneVolume volume;
    volume.object = object;
    check_channels(*leaf.shape, volume);
    scene_->volumes.push_back(std::move(volume));
    return true;
}

void Compiler::make_atmosphere() {
    const auto* ref =
        graph_.options() == nullptr ? nullptr : graph_.options()->find<NodeRef>("atmosphere");
    if (ref == nullptr || ref->node == nullptr || option("ignore_atmosphere", false)) return;
    const ShaderProgram* program = program_for(*ref->node);
    if (program == nullptr) return;
    if (!fills_volumes(*program)) {
        diagnostics_.warning(
            Code::ParamPending,
            "a " + program->type().name.str() + " as atmosphere is not supported; there is none",
            graph_.options()->where("atmosphere"), "use an atmosphere_volume or a fog");
        return;
    }
    scene_->atmosphere = program;
    add_surface_shader(program);
    if (const auto* samples = ref->node->find<std::int32_t>("samples"))
        scene_->haze.samples = std::clamp(*samples, 1, 100);
}

/// Grids that shaders ask for and the file has not. Only where a scene names them: defaults ask for what most files have.
void Compiler::check_channels(const NodeInstance& node, const SceneVolume& volume) {
    const VolumeGrids* grids = volume.grids();
    if (grids == nullptr) return;
    std::string known;
    for (const VolumeGrids::Info& info : grids->grids())
        known += (known.empty() ? "" : ", ") + info.name.str();
    std::vector<const ShaderProgram*> open{&volume.shader()};
    while (!open.empty()) {
        const ShaderProgram& program = *open.back();
        open.pop_back();
        open.insert(open.end(), program.parts.begin(), program.parts.end());
        if (!program.type().fills_volumes) continue;
        for (const ParamInfo& param : program.type().params) {
            if (param.type != ParamType::String || !ends_with(param.name.view(), "_channel"))
                continue;
            const Name name = *reinterpret_cast<const Name*>(program.block() + param.offset);
            const bool by_default =
                name ==
                *reinterpret_cast<const Name*>(program.type().default_block.data() + param.offset);
            if (name.empty() || grids->find(name) >= 0 ||
                (by_default && param.name == Name("temperature_channel")))
                continue;
            diagnostics_.warning(Code::UnknownGrid,
                                 "the volume \"" + node.name().str() + "\" has no grid \"" +
                                     name.str() + "\": " + param.name.str() + " counts as 0 there",
                                 node.where("filename"), "it has " + known);
        }
    }
}

}  // namespace lightsieve
