// Disney's diffuse reflection: darker at the edge when smooth, brighter when rough, as measured materials are.
//
// f = color / pi (1 + m (1 - cos_i)^5) (1 + m (1 - cos_o)^5), m = 2 roughness cos^2(theta_d) - 1/2, theta_d being half of the
// angle between both directions. A white rough surface would return more light than it gets when seen near the horizon
// (up to half as much again); the lobe is scaled down to all of it there, and is then no longer reciprocal. The directional
// albedo is a polynomial and exact.
// Source: Burley, "Physically Based Shading at Disney", SIGGRAPH 2012 course notes, section 5.3; MaterialX burley_diffuse_bsdf.
#pragma once

#include "bsdf/lobe.h"

namespace lightsieve {

/// Diffuse reflection, event <RD>.
struct BurleyReflect {
    Color color{0, 0, 0};  ///< reflectance, >= 0
    float roughness = 0;   ///< 0 to 1

    BurleyReflect() = default;
    /// Clamps the roughness to [0,1] and negative colours to 0; not finite becomes 0.
    BurleyReflect(Color reflectance, float diffuse_roughness) noexcept;
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return false; }
};

}  // namespace lightsieve
