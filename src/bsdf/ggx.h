// GGX (Trowbridge-Reitz) microfacets: distribution, Smith masking, sampling of visible normals. All inline.
//
// Everything is local: z is the normal, x and y are the axes of anisotropy, wo.z > 0. Half vectors point to +z.
// Sources: Walter et al. 2007; Heitz, "Understanding the Masking-Shadowing Function", JCGT 2014; Dupuy and Benyoub,
// "Sampling Visible GGX Normals with Spherical Caps", 2023.
#pragma once

#include "core/vec.h"

namespace lightsieve {

/// Below this width a lobe is a mirror: it would be narrower than a pixel and too narrow for floats.
inline constexpr float kSmoothAlpha = 1e-3F;

/// Widths of the distribution along x and y, in [0,1].
struct GgxAlpha {
    float x = 0, y = 0;

    GgxAlpha() = default;
    /// Clamps to [0,1]; not finite becomes 0. If one axis is rough, the other is at least kSmoothAlpha.
    GgxAlpha(float along_x, float along_y) noexcept;
    /// The same along both.
    explicit GgxAlpha(float isotropic) noexcept : GgxAlpha(isotropic, isotropic) {}
    /// As standard_surface maps its parameters: roughness^2, stretched by anisotropy in [0, 0.98].
    [[nodiscard]] static GgxAlpha from_roughness(float roughness, float anisotropy = 0) noexcept;
    /// A delta lobe.
    [[nodiscard]] bool smooth() const noexcept { return std::max(x, y) < kSmoothAlpha; }
};

}  // namespace lightsieve
