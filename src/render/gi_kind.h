// The kinds of rays of which options.GI_*_samples say how many leave the vertex where a path splits.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "bsdf/closure.h"

namespace lightsieve {

/// Mirror and Clear are perfectly smooth: all of their rays would be the same one.
enum class GiKind : std::uint8_t {
    Diffuse,
    Specular,
    Transmission,
    Subsurface,
    Volume,
    Mirror,
    Clear
};
inline constexpr std::size_t kGiKinds = 7;

/// The kind of the rays that a lobe sends on.
[[nodiscard]] constexpr GiKind gi_kind(const LobeRecord& record, bool delta) {
    if (record.kind == EventKind::Volume) return GiKind::Volume;
    if (record.subsurface) return GiKind::Subsurface;
    if (record.lobe == EventLobe::Diffuse) return GiKind::Diffuse;
    if (record.kind == EventKind::Transmission)
        return delta ? GiKind::Clear : GiKind::Transmission;
    return delta ? GiKind::Mirror : GiKind::Specular;
}

/// The square of a number of samples, as Arnold means it; none if it is below 1, and never more than anybody needs.
[[nodiscard]] constexpr int squared_samples(std::int32_t n) {
    constexpr std::int32_t kMost = 64;
    const std::int32_t kept = n < 0 ? 0 : n > kMost ? kMost : n;
    return kept * kept;
}

/// Rays of each kind where a path splits: the squares of options.GI_*_samples. 0: there is no such light.
struct GiSamples {
    int diffuse = 4, specular = 4, transmission = 4, subsurface = 4, volume = 4;

    [[nodiscard]] constexpr int of(GiKind kind) const {
        switch (kind) {
            case GiKind::Diffuse: return diffuse;
            case GiKind::Specular: return specular;
            case GiKind::Transmission: return transmission;
            case GiKind::Subsurface: return subsurface;
            case GiKind::Volume: return volume;
            case GiKind::Mirror: return specular > 0 ? 1 : 0;
            case GiKind::Clear: break;
        }
        return transmission > 0 ? 1 : 0;
    }

    /// Samples of lights where a path splits and there are too many lights to ask each: as many as rays of a kind.
    [[nodiscard]] constexpr int light_picks() const {
        constexpr int kMost = 8;
        return std::clamp(std::max({diffuse, specular, transmission, subsurface, volume}), 1,
                          kMost);
    }
};

}  // namespace lightsieve
