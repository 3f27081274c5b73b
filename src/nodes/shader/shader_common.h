// Small helpers of shader nodes: taming of linked values, frames around bumped normals.
//
// Textures and links may bring anything into a parameter. The renderer replaces what is not finite by 0; negative values
// and values above 1 are left to the shader, which clamps where its formula needs it.
#pragma once

#include "core/vec.h"
#include "scene/shade_point.h"

namespace lightsieve {

/// Within 0..1; nan becomes 0.
inline float unit(float v) { return v > 0 ? std::min(v, 1.0F) : 0.0F; }
inline Color unit(Color c) { return {unit(c.r), unit(c.g), unit(c.b)}; }
/// Not below 0; nan becomes 0.
inline float positive(float v) { return v > 0 ? v : 0.0F; }
inline Color positive(Color c) { return {positive(c.r), positive(c.g), positive(c.b)}; }

/// Smallest cosine between a bumped normal and the direction to the viewer.
inline constexpr float kMinFacing = 1e-3F;

/// The normal to shade with, where a parameter may replace the hit's own.
///
/// linked   the parameter's value, world space, any length; 0 0 0: not linked
/// returns  unit, on the side of `wo`: a normal that a bump map has turned away is bent back
inline Vec3f shading_normal(const ShadePoint& at, Vec3f linked) {
    const float len = length(linked);
    if (!(len > 0) || !std::isfinite(len)) return at.normal;
    Vec3f n = linked * (1 / len);
    if (dot(n, at.normal) < 0) n = -n;
    const float facing = dot(n, at.wo);
    return facing >= kMinFacing ? n : normalize(n + at.wo * (kMinFacing - facing), at.normal);
}

}  // namespace lightsieve
