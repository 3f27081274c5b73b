// What the AOV of each lobe should be, by integrating the lobes themselves on a grid: no paths, no terms, no automata.
//
// The lobes of a shader are taken from the compiled scene by name of the shape and evaluated one by one; which AOV a lobe
// belongs to is decided here by its event's kind, lobe and label. Good for lobes that are smooth on the scale of the grid.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "core/vec.h"
#include "render/scene.h"

namespace lightsieve::testing {

/// Values by AOV: "diffuse", "specular" (sheen included), "coat", "sheen", "transmission", "sss".
using LobeSums = std::map<std::string, Color>;

/// A flat surface, seen at one point.
struct SeenPoint {
    std::string shape;  ///< name of the shape whose shader is meant
    Vec3f position;
    Vec3f normal;  ///< unit, on the side of `wo`
    Vec3f wo;      ///< unit, toward the viewer
};

/// Integral of f |cos| over the directions to a parallelogram of radiance 1 that nothing hides.
///
/// corner, u, v  the parallelogram is corner + s u + t v for s, t in 0..1; both of its sides shine
/// n             grid points along each edge
[[nodiscard]] LobeSums integrate_over_quad(const Scene& scene, const SeenPoint& point,
                                           Vec3f corner, Vec3f u, Vec3f v, int n);

/// Integral of f |cos| radiance over all directions.
///
/// n  grid lines of latitude; twice as many of longitude, around the normal
[[nodiscard]] LobeSums integrate_over_sphere(const Scene& scene, const SeenPoint& point,
                                             const std::function<Color(Vec3f)>& radiance, int n);

/// What lobes of a single direction (mirrors, thin panes) carry; the integrals leave them out.
[[nodiscard]] LobeSums mirror_weights(const Scene& scene, const SeenPoint& point);

}  // namespace lightsieve::testing
