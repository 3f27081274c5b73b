// How a point moves over the picture while the shutter is open: the AOV motionvector.
#pragma once

#include <array>
#include <optional>

#include "core/vec.h"
#include "render/camera_sample.h"
#include "render/scene.h"
#include "scene/camera.h"

namespace lightsieve {

/// The place on the film [0,1]^2 where a camera sees a point, or nothing if it does not see it near `guess`.
///
/// The inverse of Camera::ray by Newton's method, so that it holds for every camera, distorted ones too.
///
/// point  world space
/// lens   the same place of the aperture that a sample goes through
[[nodiscard]] std::optional<Vec2f> film_of(const Camera& camera, Vec3f point, Vec2f lens,
                                           float time, Vec2f guess);

/// From where the sample's point is seen as the shutter opens to where it is seen as it closes [pixels; x to the right, y
/// up]; zero if the camera does not see it at both times.
///
/// at_shutter  the point at both times, world space
[[nodiscard]] Vec2f screen_motion(const Camera& camera, const CameraSample& sample,
                                  const std::array<Vec3f, 2>& at_shutter,
                                  const RenderSettings& settings);

}  // namespace lightsieve
