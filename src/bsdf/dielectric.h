// The interface between two transparent media: reflection and refraction as two separate lobes.
//
// They are separate because they make different events and because shaders weight them apart:
//     specular * spec_refl + (1 - specular * R(spec_refl)) * transmission * spec_trans      (standard_surface)
// Hence the forms chosen here:
//  - DielectricReflect is F G2 D of the microfacets: what it does not reflect, the layering hands to the lobes below.
//    Only from inside, where total reflection is strong, is multiple scattering compensated: factor 1 + F (1 - E) / E.
//    Its albedo R is exact Fresnel when smooth.
//  - DielectricTransmit has the *shape* of Walter's refraction, (1 - F) G D, but is scaled to directional albedo 1;
//    the factor 1 - R comes from the layering alone. So white glass is lossless: smooth exactly (F and 1 - F, total
//    reflection 1), rough within 1 % (only close to the horizon inside, where hardly any light gets through, it loses
//    more). A smooth lobe past the critical angle is black.
//  - Radiance is not scaled by 1/eta^2 on refraction, as production renderers do: the factors of entering and
//    leaving cancel wherever camera and lights are in the same medium.
// eta is n(far side) / n(side of wo): the IOR from outside, 1/IOR from inside.
// Sources: Walter et al. 2007; Heitz 2014 (shadowing); Dupuy and Benyoub 2023 (sampling).
#pragma once

#include "bsdf/ggx.h"
#include "bsdf/lobe.h"

namespace lightsieve {

/// Relative indices are kept within [1/kMaxEta, kMaxEta].
inline constexpr float kMaxEta = 4;

/// Fresnel reflection of a dielectric, from either side; event <RS>. Delta when smooth.
struct DielectricReflect {
    GgxAlpha alpha;
    float eta = 1.5F;

    DielectricReflect() = default;
    /// eta  n(far side) / n(side of wo); outside the valid range is clamped, not finite becomes 1 (no interface)
    DielectricReflect(GgxAlpha roughness, float relative_ior) noexcept;
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    /// R of the layering formulas.
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return alpha.smooth(); }
};

/// Refraction, event <TS>, scaled to directional albedo 1. Delta when smooth or when eta is nearly 1.
struct DielectricTransmit {
    GgxAlpha alpha;
    float eta = 1.5F;

    DielectricTransmit() = default;
    /// eta as for DielectricReflect.
    DielectricTransmit(GgxAlpha roughness, float relative_ior) noexcept;
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    /// 1; less near the horizon inside of a rough medium, and 0 for a smooth interface past the critical angle.
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept;
};

}  // namespace lightsieve
