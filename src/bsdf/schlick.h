// GGX microfacets with a Fresnel curve given by colours: facing, near 82 degrees and grazing.
//
// F(c) = f0 + (f90 - f0) (1 - c)^exponent - a c (1 - c)^6, with `a` such that F at cos = 1/7 is `f82` times the plain
// Schlick value (f82 = 1: plain Schlick). Opaque: single scattering is compensated as for metals.
// Sources: Schlick 1994; Kutz, Hasan, Edmondson, "Novel aspects of the Adobe Standard Material", 2021 (f82);
// MaterialX generalized_schlick_bsdf (parameters).
#pragma once

#include "bsdf/ggx.h"
#include "bsdf/lobe.h"

namespace lightsieve {

/// Reflection with a Schlick curve, event <RS>. Delta when smooth.
struct SchlickReflect {
    GgxAlpha alpha;
    Color f0{1, 1, 1};   ///< reflectance facing the viewer
    Color f90{1, 1, 1};  ///< reflectance at grazing angles
    Color dip{0, 0, 0};  ///< the coefficient a
    float exponent = 5;

    SchlickReflect() = default;
    /// Colours are clamped to [0,1], the exponent to [1,20]; not finite becomes 0.
    SchlickReflect(GgxAlpha roughness, Color facing, Color grazing, float schlick_exponent = 5, Color f82 = kWhite) noexcept;

    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return alpha.smooth(); }
};

}  // namespace lightsieve
