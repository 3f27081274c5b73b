// What fills a volume or the inside of a body, as a shader says it at one point.
#pragma once

#include <span>

#include "bsdf/phase.h"
#include "core/vec.h"

namespace lightsieve {

struct LobeRecord;

/// Coefficients per length, and how light scatters.
struct Medium {
    Color extinction;  ///< what is absorbed or scattered away [1/scene unit], >= 0
    Color scattering;  ///< [1/scene unit], >= 0; above the extinction only in artists' haze
    Phase phase;
    const LobeRecord* record = nullptr;  ///< of the scattering event; null: it has none

    [[nodiscard]] bool scatters() const { return !is_black(scattering); }
};

/// Several media in one place. They scatter as one, by the first one's phase function and event.
[[nodiscard]] inline Medium mixed(std::span<const Medium> media) {
    Medium out;
    for (const Medium& m : media) {
        out.extinction += m.extinction;
        out.scattering += m.scattering;
        if (out.record == nullptr && m.scatters()) {
            out.record = m.record;
            out.phase = m.phase;
        }
    }
    return out;
}

/// What is left of light after a distance in a homogeneous medium. Source: Beer-Lambert.
[[nodiscard]] inline Color transmittance(Color extinction, float distance) {
    return {std::exp(-extinction.r * distance), std::exp(-extinction.g * distance),
            std::exp(-extinction.b * distance)};
}

}  // namespace lightsieve
