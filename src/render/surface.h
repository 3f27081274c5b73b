// From a ray's hit to the point that shaders see.
#pragma once

#include <array>

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
    /// Round curves: rays to the far side leave from there, for their lobes are those of the whole fibre.
    bool round_fibre = false;
    Vec3f fibre_center;      ///< of the cross-section, world space
    bool in_medium = false;  ///< no surface but a point in a volume: it has no sides
    /// What is really there of a shape that was drawn wider than it is (min_pixel_width): the rest is transparent.
    float coverage = 1;
};

/// Adds the closures of the surface's shader.
///
/// at  the surface's point, or a copy that differs in what the path knows
void add_closures(const Surface& surface, const ShadePoint& at, ClosureSet& out);

/// Where a ray that leaves the surface toward `wi` starts.
[[nodiscard]] Vec3f start_of_ray(const Surface& surface, Vec3f wi);

/// Width of a ray's footprint, for texture filtering: `width + spread * distance` scene units.
struct Footprint {
    float width = 0, spread = 0;
};

/// Resolves a hit on `object`. Everything in world space.
[[nodiscard]] Surface make_surface(const SceneObject& object, const Ray& ray, const RayHit& hit,
                                   const Footprint& footprint);

/// Tells a surface which type of ray met it, and turns its normal where such rays see displacement as bumps.
void meet(Surface& surface, RayType type);

/// The same as far as lights need it: position, outward normal as modelled, uv.
[[nodiscard]] LightHit make_light_hit(const SceneObject& object, const Ray& ray,
                                      const RayHit& hit);

/// Where the surface's point is at another time: 0 as the shutter opens, 1 as it closes. World space.
[[nodiscard]] Vec3f position_at(const Surface& surface, float time);

/// Placement of an object at a time within the shutter.
[[nodiscard]] Mat4f placement_at(const SceneObject& object, float time);

/// Corners of a triangle at a time, object space.
[[nodiscard]] std::array<Vec3f, 3> triangle_corners(const TriangleMesh& mesh,
                                                    std::uint32_t triangle, float time);

}  // namespace lightsieve
