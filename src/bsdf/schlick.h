// GGX microfacets with a Fresnel curve given by colours: facing, near 82 degrees and grazing.
//
// F(c) = f0 + (f90 - f0) (1 - c)^5 - dip c (1 - c)^6. The third term is that of Lazanyi and Szirmay-Kalos (2005), fixed
// by the value at cos = 1/7 (82 degrees), where it is largest. Opaque: single scattering is compensated as for metals.
// For shaders whose users speak in colours (MaterialX generalized_schlick, OpenPBR metal).
// Source: Kutz, Hasan, Edmondson, "Novel aspects of the Adobe Standard Material", 2021.
#pragma once

#include "bsdf/ggx.h"
#include "bsdf/lobe.h"

namespace lightsieve {

/// A Fresnel curve.
struct SchlickCurve {
    Color f0{1, 1, 1};   ///< reflectance facing the viewer
    Color f90{1, 1, 1};  ///< reflectance at grazing angles
    Color dip{0, 0, 0};  ///< coefficient of the third term

    /// Where the third term is largest.
    static constexpr float kDipCos = 1.0F / 7;

    /// The curve from `facing` to `grazing` that has the value `at_dip` at kDipCos.
    [[nodiscard]] static SchlickCurve through(Color facing, Color at_dip,
                                              Color grazing = kWhite) noexcept {
        constexpr float m = 1 - kDipCos, m5 = m * m * m * m * m;
        return {facing, grazing, (lerp(facing, grazing, m5) - at_dip) * (1 / (kDipCos * m * m5))};
    }
    /// c  cosine at the microfacet, [0,1]; a deep dip of a dark curve ends at 0
    [[nodiscard]] Color value(float c) const noexcept {
        const float m = 1 - c, m5 = square(square(m)) * m;
        return clamp(lerp(f0, f90, m5) - dip * (c * m * m5), 0, 1);
    }
};

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
