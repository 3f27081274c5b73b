// GGX microfacets with a Fresnel curve given by colours: facing, near 82 degrees and grazing.
//
// Opaque: single scattering is compensated as for metals (conductor.h). For shaders whose users speak in colours
// (MaterialX generalized_schlick, OpenPBR metal).
#pragma once

#include "bsdf/ggx.h"
#include "bsdf/lobe.h"
#include "bsdf/schlick_curve.h"

namespace lightsieve {

/// Reflection with a Schlick curve, event <RS>. Delta when smooth.
struct SchlickReflect {
    GgxAlpha alpha;
    SchlickCurve curve;

    SchlickReflect() = default;
    /// facing, grazing  reflectances, clamped to [0,1]; not finite becomes 0
    /// f82              what multiplies the plain curve at 82 degrees, clamped to [0,1]; white: plain Schlick
    SchlickReflect(GgxAlpha roughness, Color facing, Color grazing, Color f82 = kWhite) noexcept;

    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return alpha.smooth(); }
};

}  // namespace lightsieve
