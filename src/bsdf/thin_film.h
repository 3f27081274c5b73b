// Reflection by a surface under a film as thin as the wavelengths of light: soap, oil, anodised metal.
//
// Waves that are reflected above and below the film interfere, more or less according to wavelength, which gives
// colours that change with the angle. The spectrum is integrated in closed form: sensitivities of the eye as Gaussians, the
// reflectance as a series of cosines.
// Source: Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence".
#pragma once

#include "bsdf/ggx.h"
#include "bsdf/lobe.h"
#include "bsdf/schlick.h"

namespace lightsieve {

/// A film on a base of known optical constants; the other side of the film is air.
struct ThinFilm {
    float thickness = 0;                    ///< [nm], >= 0
    float ior = 1.5F;                       ///< of the film
    Color n{1.5F, 1.5F, 1.5F}, k{0, 0, 0};  ///< of the base, relative to air

    /// Reflectance for light from air under that cosine, linear ACEScg, each channel in [0,1].
    [[nodiscard]] Color reflectance(float cos_theta) const noexcept;
};

/// A film on a base whose reflectance is given by colours; the other side of the film is air.
struct FilmOnSchlick {
    float thickness = 0;  ///< [nm], >= 0
    float ior = 1.5F;     ///< of the film
    SchlickCurve base;    ///< as it would be without the film

    /// As ThinFilm. Face on it is the film on the dielectric of the base's reflectance; the base's curve keeps its shape.
    [[nodiscard]] Color reflectance(float cos_theta) const noexcept;
};

/// GGX reflection with the reflectance of a film on each microfacet.
struct FilmReflect {
    GgxAlpha alpha;
    ThinFilm film;

    FilmReflect() = default;
    /// thickness  [nm], clamped to [0, 1e5]; film_ior clamped to [1, 4]; n and k as for ConductorReflect
    FilmReflect(GgxAlpha roughness, float thickness, float film_ior, Color n, Color k) noexcept;

    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return alpha.smooth(); }
};

/// The same over a base that is given by colours.
struct FilmedSchlickReflect {
    GgxAlpha alpha;
    FilmOnSchlick film;

    FilmedSchlickReflect() = default;
    /// thickness and film_ior as for FilmReflect, the base as for SchlickReflect
    FilmedSchlickReflect(float thickness, float film_ior, const SchlickReflect& base) noexcept;

    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return alpha.smooth(); }
};

}  // namespace lightsieve
