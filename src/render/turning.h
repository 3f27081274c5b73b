// Matrices between motion keys that turn, instead of passing through one another element by element.
//
// Everything that moves is interpolated element by element between neighbouring keys, here and in Embree. A wheel that
// turns by 90 degrees between two keys would shrink on the way. So keys are put in between, close enough together that
// what is left of the error does not show: each is made of the stretch, the rotation and the place of a point that
// moves straight, all halfway.
#pragma once

#include <span>
#include <vector>

#include "core/matrix.h"
#include "scene/shape.h"

namespace lightsieve {

/// The keys, evenly spread in time as before, with as many more in between as the rotation needs.
///
/// center  the point, object space, that moves along a line between keys; ignored by RotateAboutOrigin and Linear
[[nodiscard]] std::vector<Mat4f> turning_keys(std::span<const Mat4f> keys, TransformType type,
                                              Vec3f center);

}  // namespace lightsieve
