// Cameras: a place on the film to a ray. One class a camera node.
#pragma once

#include "core/matrix.h"
#include "core/vec.h"

namespace lightsieve {

struct CameraRay {
    Vec3f origin, direction;             ///< world space; direction unit
    float t_min = 0, t_max = kInfinity;  ///< clipping planes, as distances along the ray
    /// Factor on what the ray brings: exposure, vignetting. 0: the camera sees nothing there, and nothing is traced.
    float weight = 1;
    float spread = 0;  ///< angle that one pixel covers [rad], for texture filtering; ortho: 0
    float width = 0;  ///< width of a pixel's footprint at the origin [scene units]; perspective: 0
};

class Camera {
  public:
    virtual ~Camera() = default;
    /// film  [0,1]^2 over the frame, (0,0) the upper left corner; may lie outside for overscan
    /// lens  [0,1)^2 for the aperture; time [0,1) within the shutter
    [[nodiscard]] virtual CameraRay ray(Vec2f film, Vec2f lens, float time) const = 0;
    /// World to camera space (looking along -Z) at a shutter time, for Z and the file header.
    [[nodiscard]] virtual Mat4f camera_from_world(float time) const = 0;
    /// The shutter's time [0,1) at a place of the film for a uniform number, and the shutter on the clock of motion keys.
    [[nodiscard]] virtual float sample_time(Vec2f /*film*/, float u) const { return u; }
    [[nodiscard]] virtual float shutter_start() const { return 0; }
    [[nodiscard]] virtual float shutter_end() const { return 0; }
};

}  // namespace lightsieve
