// Displacement: a shader moves the vertices of a mesh; what is finer than the mesh shows as bumps.
//
// The same programs that shade surfaces say how far. They are asked at points of the mesh as it was (the rest mesh): before
// rendering at each vertex, and with disp_autobump at every hit for the slopes between the vertices. A number moves along the
// smooth normal; a vector moves by itself, in object space, so that it turns with the object. disp_padding has no use
// here: bounds are known, because everything is moved before the first ray.
#pragma once

#include <vector>

#include "render/scene_object.h"
#include "render/surface.h"
#include "scene/shape.h"

namespace lightsieve {

class DisplacementMap {
  public:
    /// rest      a mesh with Displacement settings; gets smooth normals if it has none
    /// programs  by the mesh's shader_index, null where nothing moves; the last one serves larger numbers
    /// object    the shape: its first placement, node and services are used
    DisplacementMap(TriangleMesh rest, std::vector<const ShaderProgram*> programs,
                    const SceneObject& object);
    DisplacementMap(const DisplacementMap&) = delete;
    DisplacementMap& operator=(const DisplacementMap&) = delete;

    /// The rest mesh with its vertices moved, at all motion keys, and with new normals if it had any of its own.
    [[nodiscard]] TriangleMesh displaced() const;
    /// Turns the normal of a hit on the displaced mesh to that of a mesh without end to its fineness, for the ray types that
    /// see it.
    void bump(Surface& surface) const;

  private:
    /// A point of the rest mesh.
    struct RestPoint {
        std::uint32_t triangle = 0;
        Vec2f barycentric;
        float width = 0;  ///< of what is asked for, for texture filtering; object space
    };
    [[nodiscard]] const TriangleMesh& mesh() const;
    [[nodiscard]] const ShaderProgram* program(std::uint32_t triangle) const;
    [[nodiscard]] Vec3f offset(const RestPoint& point) const;
    [[nodiscard]] std::vector<Vec3f> vertex_offsets() const;

    bool had_normals_;
    Displacement settings_;
    std::vector<const ShaderProgram*> programs_;
    ShapeGeometry rest_;
    SceneObject in_world_, in_object_;  ///< the rest mesh as numbers and as vectors are asked
};

}  // namespace lightsieve
