// Directions toward a sphere, uniform over the solid angle that it covers.
//
// Valid for every size down to a float's range: 1 - cos of the cone's half angle is found without cancellation.
// From inside the sphere there are none: our spheres shine outward only.
#pragma once

#include "core/sampling.h"
#include "core/vec.h"
#include "scene/light.h"

namespace lightsieve {

/// A direction toward a sphere.
struct SphereDirection {
    Vec3f wi;            ///< unit
    float distance = 0;  ///< to the sphere's surface
    float pdf = 0;       ///< per solid angle; 0: `from` is not outside
};

/// 1 - cos of the half angle under which a sphere is seen; 0 from inside.
inline float sphere_one_minus_cos(Vec3f center, float radius, Vec3f from) {
    const float d2 = length_squared(center - from), r2 = radius * radius;
    if (!(d2 > r2) || !(r2 > 0)) return 0;
    const float sin2 = r2 / d2;
    return sin2 / (1 + std::sqrt(1 - sin2));
}

/// Density of `sample_sphere` in every direction that meets the sphere; 0 from inside.
inline float sphere_pdf(Vec3f center, float radius, Vec3f from) {
    const float one_minus_cos = sphere_one_minus_cos(center, radius, from);
    return one_minus_cos > 0 ? 1 / (2 * kPi * one_minus_cos) : 0;
}

/// A direction from `from` to the sphere. Source: Shirley, Wang and Zimmerman 1996, "Monte Carlo Techniques for
/// Direct Lighting Calculations", section 3.2.
inline SphereDirection sample_sphere(Vec3f center, float radius, Vec3f from, Vec2f u) {
    const float one_minus_cos = sphere_one_minus_cos(center, radius, from);
    if (!(one_minus_cos > 0)) return {};
    const Vec3f toward = center - from;
    const float d = length(toward);
    const Vec3f local = sample_uniform_cone(u, one_minus_cos);
    SphereDirection out;
    out.wi = Frame::from_z(toward / d).world_from_local(local);
    // Nearer of the two intersections; rounding at the rim may leave a negative root.
    const float sin2 = local.x * local.x + local.y * local.y;
    out.distance = d * local.z - safe_sqrt(radius * radius - d * d * sin2);
    out.pdf = 1 / (2 * kPi * one_minus_cos);
    return out;
}

/// Whether a ray from `from` meets a sphere there from outside. Rays also meet the far side, from within: it is dark.
inline bool from_outside(Vec3f from, const LightHit& hit) {
    return dot(hit.position - from, hit.normal) < 0;
}

}  // namespace lightsieve
