// mesh_light: a polymesh that shines outward.
#include "nodes/light/light_common.h"
#include "nodes/light/triangle_light.h"

namespace lightsieve {
namespace {

struct MeshLight : LightCommon {
    NodeRef mesh;  ///< a polymesh

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Light> make_light(NodeContext& context) const;
};

/// Moves a mesh to the world and drops what a light does not need. A mirroring matrix turns the winding back, so that
/// the outer side stays the outer one.
TriangleMesh to_world(TriangleMesh mesh, const Mat4f& world_from_object) {
    mesh.positions.resize(1);
    for (Vec3f& p : mesh.positions[0])
        p = world_from_object.point(p);
    mesh.normals.clear();
    mesh.normal_indices.clear();
    mesh.shader_index.clear();
    if (world_from_object.determinant3() < 0) {
        for (std::vector<std::uint32_t>* list : {&mesh.indices, &mesh.uv_indices, &mesh.corner})
            for (std::size_t i = 0; i + 2 < list->size(); i += 3)
                std::swap((*list)[i + 1], (*list)[i + 2]);
    }
    return mesh;
}

NodeType MeshLight::describe() {
    Describe<MeshLight> d("mesh_light", NodeKind::Light,
                          "A polymesh that shines outward with radiance I / (sum of triangle "
                          "areas), or I without normalize; I = color * intensity * 2^exposure.");
    d.param("mesh", &MeshLight::mesh, "The polymesh; its own matrix places the light.");
    describe_light_common(d);
    NodeType type = d.done();
    for (ParamInfo& param : type.params) {
        if (param.name == Name("matrix"))
            param.doc = "Has no effect: the mesh's own matrix places the light.";
        else if (param.name == Name("motion_start") || param.name == Name("motion_end"))
            param.doc = "Has no effect, as `matrix`.";
        else
            continue;
        param.ignored = true;
    }
    return type;
}

std::unique_ptr<Light> MeshLight::make_light(NodeContext& context) const {
    const std::optional<Emission> emission = make_emission(*this, context);
    if (!emission) return nullptr;
    if (!mesh) {
        context.diagnostics().error(Code::InvalidValue,
                                    "mesh light \"" + context.node_name().str() + "\" has no mesh",
                                    context.where("mesh"), "write the name of a polymesh");
        return nullptr;
    }
    Mat4f world_from_object;
    const std::unique_ptr<ShapeGeometry> geometry = context.geometry_of(mesh, world_from_object);
    if (geometry == nullptr) return nullptr;
    TriangleMesh* triangles = std::get_if<TriangleMesh>(&geometry->data);
    if (triangles == nullptr || triangles->positions.empty() || geometry->instance_of) {
        context.diagnostics().error(
            Code::InvalidValue,
            "mesh light \"" + context.node_name().str() + "\" refers to a shape without triangles",
            context.where("mesh"), "write the name of a polymesh");
        return nullptr;
    }
    auto light = std::make_unique<TriangleLight>(
        to_world(std::move(*triangles), world_from_object), *emission, normalize);
    if (!(light->area() > 0)) warn_no_area(context, "mesh");
    return light;
}

}  // namespace

NodeType node_mesh_light() { return MeshLight::describe(); }

}  // namespace lightsieve
