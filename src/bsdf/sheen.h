// Sheen: the glow of cloth at grazing angles, from fibres that stand up on the surface.
//
// D = (2 + 1/a) sin(theta_h)^(1/a) / (2 pi) with the masking that Estevez and Kulla fitted to it; no Fresnel, the
// closure's weight is the colour. Directions are drawn uniformly: the lobe is wide and brightest at the horizon.
// Source: Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 course notes.
#pragma once

#include "bsdf/lobe.h"

namespace lightsieve {

/// Narrower lobes would reflect more light than they receive.
inline constexpr float kMinSheenRoughness = 0.07F;

/// Reflection of cloth, event <RS'sheen'>.
struct SheenReflect {
    float roughness = 0.3F;  ///< a of the paper, (0,1]

    SheenReflect() = default;
    /// Clamped to [kMinSheenRoughness, 1]; not finite becomes the smallest.
    explicit SheenReflect(float sheen_roughness) noexcept;
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return false; }
};

}  // namespace lightsieve
