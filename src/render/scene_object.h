// One shape placed in the world.
//
// A scene may have millions of them, so what many share (shaders, lights, where they came from) is kept once in the
// Scene and only pointed to.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/matrix.h"
#include "core/name.h"
#include "core/ray_type.h"
#include "scene/shape.h"

namespace lightsieve {

class DisplacementMap;  // render/displacement.h
class LightSampler;     // render/light_sampler.h
struct Cutter;          // render/cutting.h
class NodeInstance;     // scene/graph.h
class ShadeServices;    // scene/shade_services.h
class ShaderProgram;    // render/shader_program.h
struct UserData;        // scene/graph.h

/// A node that a shape passed on its way into the world: the shape itself, an instance of it, a procedural around it.
struct LineageStep {
    const NodeInstance* node = nullptr;
    std::uint32_t n = 1;  ///< of an instancer: its instances
    std::uint64_t stride =
        1;  ///< SceneObject::instance / stride % n is the number of the instance
    /// Of an instancer: user data with a value for each instance, by the name that shaders see.
    std::vector<std::pair<Name, const UserData*>> by_instance;
};
/// From the shape that has the geometry to the outermost node.
using Lineage = std::vector<LineageStep>;

struct SceneObject {
    const ShapeGeometry* geometry = nullptr;
    std::span<const Mat4f> world_from_object;       ///< keys over the shutter; the Scene owns them
    std::span<const Mat4f> object_from_world;       ///< inverse of each key
    std::span<const ShaderProgram* const> shaders;  ///< at least one; by the mesh's shader_index
    const LightSampler* lights = nullptr;           ///< lights that illuminate it
    /// Lights in which it casts shadows, one flag a light; null: all.
    const std::vector<bool>* shadow_lights = nullptr;
    const Lineage* lineage = nullptr;         ///< nodes of the graph, which outlives the scene
    const ShadeServices* services = nullptr;  ///< for shaders
    const DisplacementMap* bumps = nullptr;   ///< displacement that shows as bumps; null: none
    const Cutter* cutter = nullptr;           ///< it cuts others (clip_geo); null: it does not
    Name name;
    std::uint64_t instance = 0;  ///< which of the instances that share the lineage
    std::uint32_t id = 0;
    bool in_place = false;  ///< its placement is the identity: nothing needs to be transformed
    std::uint8_t visibility = 255, sidedness = 255;
    bool matte = false, invert_normals = false, receive_shadows = true, self_shadows = true;
    bool may_be_transparent = false;  ///< rays may pass straight through
    bool may_tint_shadows = false;    ///< shadow rays may, though other rays do not
    bool reads_coordinates =
        true;              ///< its shaders look at uv or tangents: frames lie along the tangent
    bool wants_uv = true;  ///< somebody looks at uv: a shader of it, or an output
    bool is_cut = false;   ///< parts of it are not there: Scene::cutters knows which
    /// Rays that meet it may go on behind it, so that what they meet there counts.
    [[nodiscard]] bool may_be_passed() const { return may_be_transparent || sidedness != 255; }
    /// What hides lights from it is not what hides them from a ray that leaves it: only light samples find lights.
    [[nodiscard]] bool tampers_with_shadows() const { return !receive_shadows || !self_shadows; }
};

}  // namespace lightsieve
