// Schlick's Fresnel curve with a dip near grazing angles:  F(c) = f0 + (f90 - f0) (1 - c)^5 - dip c (1 - c)^6.
//
// The third term is the correction of Lazanyi and Szirmay-Kalos (2005), fixed by the value at cos = 1/7 (82 degrees),
// where it is largest. Being a polynomial of c, its mean over the microfacets follows from three tabulated moments.
// Source: Kutz, Hasan, Edmondson, "Novel aspects of the Adobe Standard Material", 2021.
#pragma once

#include "bsdf/albedo_table.h"
#include "core/vec.h"

namespace lightsieve {

struct SchlickCurve {
    Color f0{1, 1, 1};   ///< reflectance facing the viewer
    Color f90{1, 1, 1};  ///< reflectance at grazing angles
    Color dip{0, 0, 0};  ///< coefficient of the third term

    /// Where the third term is largest.
    static constexpr float kDipCos = 1.0F / 7;

    /// The curve from f0 to `f90` that has the value `at_dip` at kDipCos.
    [[nodiscard]] static SchlickCurve through(Color f0, Color at_dip, Color f90 = kWhite) noexcept {
        constexpr float m = 1 - kDipCos, m5 = m * m * m * m * m;
        return {f0, f90, (lerp(f0, f90, m5) - at_dip) * (1 / (kDipCos * m * m5))};
    }
    /// c  cosine at the microfacet, [0,1]
    [[nodiscard]] Color value(float c) const noexcept {
        const float m = 1 - c, m5 = square(square(m)) * m;
        return lerp(f0, f90, m5) - dip * (c * m * m5);
    }
    /// Mean over the light that white microfacets reflect.
    [[nodiscard]] Color mean(const GgxMoments& moments) const noexcept {
        return clamp(lerp(f0, f90, moments.schlick) - dip * moments.schlick6, 0, 1);
    }
};

}  // namespace lightsieve
