// From a ray's hit to the point that shaders see.
#pragma once

#include "core/vec.h"
#include "render/ray.h"
#include "render/scene.h"
#include "scene/shade_point.h"

namespace lightsieve {

/// A hit with its geometry resolved.
struct Surface {
    ShadePoint at;  ///< filled for shaders
    Frame frame;    ///< shading frame: z is at.normal, x along dP/du
    Vec3f outward;  ///< unit geometric normal on the side of wo
    const SceneObject* object = nullptr;
    const ShaderProgram* shader = nullptr;
    float t = 0;  ///< along the ray
};

/// Width of a ray's footprint, for texture filtering: `width + spread * distance` scene units.
struct Footprint {
    float width = 0, spread = 0;
};

/// Resolves a hit on `object`. Everything in world space.
[[nodiscard]] Surface make_surface(const SceneObject& object, const Ray& ray, const RayHit& hit,
                                   const Footprint& footprint);

/// The same as far as lights need it: position, outward normal as modelled, uv.
[[nodiscard]] LightHit make_light_hit(const SceneObject& object, const Ray& ray,
                                      const RayHit& hit);

}  // namespace lightsieve
