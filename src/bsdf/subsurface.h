// A medium below a surface, as artists give it: the colour that comes back, and how far light wanders.
//
// The renderer walks through it (render/subsurface_walk.h). Here the colour becomes the medium's single-scattering albedo:
// the inverse of the diffuse reflectance of a half-space without a refracting boundary.
// Source: Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks", as the MaterialX specification
// gives it (subsurface_bsdf).
#pragma once

#include "core/vec.h"

namespace lightsieve {

struct SubsurfaceMedium {
    Color reflectance{0, 0, 0};     ///< diffuse, of a half-space, [0,1]
    Color albedo{0, 0, 0};          ///< of a single scattering, [0,1]
    Color mean_free_path{1, 1, 1};  ///< > 0 [scene units]
    float anisotropy = 0;           ///< mean cosine of the scattering angle, Henyey-Greenstein

    SubsurfaceMedium() = default;
    /// color       clamped to [0,1]; not finite becomes 0
    /// radius      mean free path a channel; channels far shorter than the longest get a thousandth of it
    /// anisotropy  clamped to [-0.98, 0.98]; not finite becomes 0
    SubsurfaceMedium(Color color, Color radius, float anisotropy) noexcept;

    /// Whether a radius gives a walk at all; without one the surface is as good as diffuse.
    [[nodiscard]] static bool has_depth(Color radius) noexcept;
};

/// Direction after scattering. Source: Henyey and Greenstein 1941; inverted as in Pharr, Jakob and Humphreys, "Physically Based
/// Rendering", 4th ed., section 11.3.1.
///
/// along       unit, direction of travel before
/// anisotropy  in (-1, 1)
[[nodiscard]] Vec3f sample_henyey_greenstein(Vec3f along, float anisotropy, Vec2f u) noexcept;

}  // namespace lightsieve
