// Light filters: what stands between a light and what it lights: decay, barn doors, blockers, slides.
//
// A filter is a factor on the light that goes from one point to another, or what replaces it. Lights know nothing of
// their filters: the renderer puts a light with filters into a FilteredLight.
#pragma once

#include "core/matrix.h"
#include "core/vec.h"

namespace lightsieve {

/// Where the filtered light is, for filters that hang in front of it.
struct LightPlace {
    Mat4f world_from_light, light_from_world;
    /// Tangent of half the cone of a spot light; 0: the light has no cone.
    float cone_tangent = 0;
};

class LightFilter {
  public:
    virtual ~LightFilter() = default;
    /// The light that is left of `radiance` on its way from the light to a point.
    ///
    /// to        the point that is lit, world space
    /// from      on the light, world space; for infinite lights a point in the light's direction
    /// distance  between them; kInfinity for infinite lights
    [[nodiscard]] virtual Color filtered(Color radiance, Vec3f from, Vec3f to,
                                         float distance) const = 0;
};

}  // namespace lightsieve
