// Where light goes from a particle of a volume: the phase function, as a lobe without sides.
//
// A vertex in a medium is a hit whose lobes go all around, so that everything that asks lobes (light samples, sharing of a
// path among AOVs, albedo probes) needs no second way. Two Henyey-Greenstein lobes, mixed: most smoke and cloud is well
// described by one forward and one backward lobe.
// Source: Henyey and Greenstein 1941; Kattawar 1975 for the mixture.
#pragma once

#include "bsdf/lobe.h"

namespace lightsieve {

/// Shape of the scattering of a medium. Mean cosines in (-1, 1).
struct Phase {
    float anisotropy = 0;  ///< mean cosine of the first lobe: above 0 light goes on forward
    float secondary_anisotropy = 0;  ///< of the second
    float mix = 0;                   ///< share of the second lobe, [0,1]

    Phase() = default;
    /// Clamps the anisotropies to [-0.98, 0.98] and the share to [0,1]; not finite becomes 0.
    explicit Phase(float first, float second = 0, float share = 0) noexcept;
    friend bool operator==(const Phase&, const Phase&) = default;
};

/// The phase function as a lobe, event V. Values are densities of directions: a volume has no cosine.
struct PhaseLobe {
    Phase phase;

    PhaseLobe() = default;
    explicit PhaseLobe(const Phase& p) noexcept : phase(p) {}
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    /// 1: what is absorbed is the medium's business.
    [[nodiscard]] Color albedo(Vec3f) const noexcept { return kWhite; }
    [[nodiscard]] bool delta() const noexcept { return false; }
};

}  // namespace lightsieve
