// What shaders of hair share: the fibre at a hit.
//
// On curves the fibre is the curve's tangent and the ray's offset across it. Elsewhere (hair shaders on a mesh) it is the
// direction of u, met in the middle.
#pragma once

#include <algorithm>
#include <cmath>

#include "bsdf/closure.h"
#include "nodes/shader/shader_common.h"

namespace lightsieve {

/// The fibre at a hit, as lobes need it.
struct HairFibre {
    std::uint8_t frame = 0;  ///< of the set: x along the fibre, z toward the viewer
    /// Of the set: z is the normal of the round fibre where the ray met it, also on flat ribbons. For diffuse light: a
    /// Lambertian cylinder (Zinke and Weber 2007, section 6). Arnold's hair is dark where only the floor behind it is lit
    /// (reference picture test_0052), so its diffuse part has a side, unlike that of Kajiya and Kay.
    std::uint8_t side_frame = 0;
    float offset = 0;  ///< across, as HairLobe has it

    /// along  direction of the fibre, world space; 0 0 0: the hit's own
    HairFibre(const ShadePoint& at, ClosureSet& out, Vec3f along = {})
        : offset(at.on_curve && std::isfinite(at.curve_offset)
                     ? std::clamp(at.curve_offset, -1.0F, 1.0F)
                     : 0.0F) {
        const Vec3f axis = normalize(along == Vec3f{} ? at.tangent : along, at.tangent);
        const Vec3f toward = at.wo - axis * dot(at.wo, axis);
        // Seen along itself a fibre shows no side: any will do.
        const Vec3f z = normalize(toward, at.normal);
        const Vec3f x = normalize(axis - z * dot(axis, z), at.tangent);
        const Vec3f y = cross(z, x);
        frame = out.add_frame({x, y, z});
        const Vec3f side = y * offset + z * safe_sqrt(1 - offset * offset);
        side_frame = out.add_frame({x, cross(side, x), side});
    }
};

/// Pseudo-random number in [0,1) that belongs to a curve of a shape.
[[nodiscard]] inline float random_of_curve(const ShadePoint& at) {
    std::uint32_t h = at.face * 0x9e3779b9U ^ at.shape_id;
    h = (h ^ (h >> 16U)) * 0x7feb352dU;
    h = (h ^ (h >> 15U)) * 0x846ca68bU;
    return static_cast<float>((h ^ (h >> 16U)) >> 8U) * 0x1p-24F;
}

}  // namespace lightsieve
