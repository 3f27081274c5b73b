// Cones, cylinders, disks and planes as formulas: where a ray meets them, and what a point on them is like.
//
// Exact instead of made of triangles: silhouettes are round at any size, and a plane has no end. All is in object space
// and in double precision, because rays come from far away and shapes may be small.
#pragma once

#include <array>
#include <optional>

#include "core/vec.h"
#include "scene/shape.h"

namespace lightsieve {

/// The smallest t with t_min <= t <= t_max at which origin + t * direction lies on the shape; nothing if there is none.
/// The direction need not have unit length.
[[nodiscard]] std::optional<float> hit_simple_shape(const SimpleShape& shape, Vec3f origin,
                                                    Vec3f direction, float t_min, float t_max);

/// A point of the surface.
struct SimplePoint {
    Vec3f position;
    Vec3f normal;         ///< unit, outward; of disks and planes the axis
    Vec2f uv;             ///< around and along; see simple_point
    Vec3f dp_du, dp_dv;   ///< zero where uv are degenerate (the tip of a cone)
    float uv_per_unit{};  ///< uv length per length, the larger one of the two
};

/// The point of the surface that is nearest to `p`, which lies near the surface.
///
/// uv: mantles have u around, [0,1], counter-clockwise as seen from the top, and v from base to top; disks u around and v
/// from the middle (or the hole) to the rim; planes lengths along two axes.
[[nodiscard]] SimplePoint simple_point(const SimpleShape& shape, Vec3f p);

/// Object space box. Planes have none that could be written down: theirs is empty.
[[nodiscard]] Box3f bounds_of(const SimpleShape& shape);

/// A square that is turned to the ray: half its width and height, and its upward direction's turn.
struct FacingQuad {
    Vec3f center;
    float half_width = 0, half_height = 0, rotation_rad = 0;
    Vec3f up;
};

/// Axes of a quad as a ray with this direction sees it: x to the right, y upward, z against the ray.
[[nodiscard]] Frame facing_frame(const FacingQuad& quad, Vec3f direction);

/// Where a ray meets the quad. A ray that starts within the quad's ball does not: it would meet the quad that it comes from.
[[nodiscard]] std::optional<float> hit_facing_quad(const FacingQuad& quad, Vec3f origin,
                                                   Vec3f direction, float t_min, float t_max);

/// Quad number `i` of a list, which is at `center` with `radius` now; of other modes the square around the point.
[[nodiscard]] FacingQuad quad_of(const PointList& points, std::size_t i, Vec3f center,
                                 float radius);

}  // namespace lightsieve
