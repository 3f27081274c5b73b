// Displacement of meshes. See compiler.h.
#include <algorithm>

#include "render/compiler.h"
#include "render/displacement.h"
#include "render/shade_services.h"

namespace lightsieve {

const ShaderProgram* Compiler::displacement_program(const NodeInstance& node, const NodeRef& ref) {
    if (!ref) return nullptr;
    const ShaderProgram* program = program_for(*ref.node);
    if (program == nullptr || program->type().eval_value != nullptr) return program;
    diagnostics_.warning(Code::LinkType,
                         "a " + program->type().name.str() +
                             " gives no number to displace by; the mesh stays as it is",
                         node.where("disp_map"),
                         "link a number (along the normal) or a vector (vector_map)");
    return nullptr;
}

void Compiler::displace(const NodeInstance& node, ShapeGeometry& geometry) {
    auto* mesh = std::get_if<TriangleMesh>(&geometry.data);
    if (mesh == nullptr || !mesh->displacement || option("ignore_displacement", false)) return;
    const ShapeCommon& common = *node.type().shape_common(node.block());
    std::vector<const ShaderProgram*> programs;
    for (const NodeRef& ref : common.disp_map.first_key())
        programs.push_back(displacement_program(node, ref));
    const auto moves = [](const ShaderProgram* p) { return p != nullptr; };
    if (std::none_of(programs.begin(), programs.end(), moves)) return;

    SceneObject place;
    place.lineage = extend(nullptr, node, 1);
    place.name = node.name();
    place.id = common.id;
    place.services = scene_->services.get();
    const std::span<Mat4f> matrices = scene_->matrices.allocate_array<Mat4f>(2);
    matrices[0] = common.matrix.empty() ? Mat4f{} : common.matrix[0];
    matrices[1] = matrices[0].inverse();
    place.world_from_object = matrices.first(1);
    place.object_from_world = matrices.last(1);
    const bool autobump = mesh->displacement->autobump;
    auto map = std::make_shared<DisplacementMap>(std::move(*mesh), std::move(programs), place);
    *mesh = map->displaced();
    if (!autobump) return;
    bumps_[&node] = map.get();
    scene_->kept.push_back(std::move(map));
}

}  // namespace lightsieve
