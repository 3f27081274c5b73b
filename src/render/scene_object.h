// One shape placed in the world.
#pragma once

#include <cstdint>
#include <vector>

#include "core/matrix.h"
#include "core/name.h"
#include "core/ray_type.h"
#include "scene/shape.h"

namespace lightsieve {

class DisplacementMap;  // render/displacement.h
class LightSampler;     // render/light_sampler.h
class NodeInstance;     // scene/graph.h
class ShadeServices;    // scene/shade_services.h
class ShaderProgram;    // render/shader_program.h

struct SceneObject {
    const ShapeGeometry* geometry = nullptr;
    std::vector<Mat4f> world_from_object;       ///< keys over the shutter
    std::vector<Mat4f> object_from_world;       ///< inverse of each key
    std::vector<const ShaderProgram*> shaders;  ///< at least one; by the mesh's shader_index
    const LightSampler* lights = nullptr;       ///< lights that illuminate it
    /// Lights in which it casts shadows, one flag a light; empty: all.
    std::vector<bool> shadow_lights;
    Name name;
    /// The shape or instance in the graph, which outlives the scene: user data.
    const NodeInstance* node = nullptr;
    const ShadeServices* services = nullptr;  ///< for shaders
    const DisplacementMap* bumps = nullptr;   ///< displacement that shows as bumps; null: none
    std::uint32_t id = 0;
    std::uint8_t visibility = 255, sidedness = 255;
    bool matte = false, invert_normals = false, receive_shadows = true, self_shadows = true;
    bool may_be_transparent = false;  ///< rays may pass straight through
    bool may_tint_shadows = false;    ///< shadow rays may, though other rays do not
    /// What hides lights from it is not what hides them from a ray that leaves it: only light samples find lights.
    [[nodiscard]] bool tampers_with_shadows() const { return !receive_shadows || !self_shadows; }
};

}  // namespace lightsieve
