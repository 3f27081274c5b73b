// Diffuse reflection of a surface of small mirrorless facets: flatter than Lambert's, bright toward where light comes from.
//
// f = color / pi (A + B max(0, s) / max(cos_i, cos_o)), s = wi . wo - cos_i cos_o, which is max(0, cos phi) sin(alpha)
// tan(beta) of the paper; A = 1 - r^2 / 2 / (r^2 + 0.57), B = 0.45 r^2 / (r^2 + 0.09). The constant 0.57 in place of 0.33
// is the paper's way to count light that bounces among facets. Arnold's diffuse_roughness is that model: in one of its
// own pictures (a felt of roughness 1, lit from behind and above) the floor has 0.69 of Lambert's brightness in all channels and
// places, A is 0.68, and its reflection in a mirror, seen from the other side, fits B; with 0.33, with Fujii's and with the
// energy-preserving form it does not. White surfaces of middle roughness would return up to 4 % more light than they get
// when seen near the horizon; the lobe is scaled down to all of it there, and is then no longer reciprocal.
// Source: Oren and Nayar 1994, "Generalization of Lambert's Reflectance Model", section 4.4.
#pragma once

#include "bsdf/lobe.h"

namespace lightsieve {

/// Diffuse reflection, event <RD>.
struct OrenNayarReflect {
    Color color{0, 0, 0};  ///< reflectance, >= 0
    float roughness = 0;   ///< 0 (Lambert) to 1: deviation of the facets' slope angles [rad]

    OrenNayarReflect() = default;
    /// Clamps the roughness to [0,1] and negative colours to 0; not finite becomes 0.
    OrenNayarReflect(Color reflectance, float diffuse_roughness) noexcept;
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    /// Exact.
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return false; }
};

}  // namespace lightsieve
