// Transmission through a sheet without thickness (thin_walled): no bending.
//
// Smooth, the ray goes straight on. Rough, the lobe is a lossless GGX reflection lobe mirrored at the surface: its
// width is that of the specular roughness and its directional albedo is 1 (multiple scattering included), so that
// the layering's 1 - R is the only loss.
#pragma once

#include "bsdf/ggx.h"
#include "bsdf/lobe.h"

namespace lightsieve {

/// Straight or blurred transmission, event <TS>. Delta when smooth.
struct ThinTransmit {
    GgxAlpha alpha;

    ThinTransmit() = default;
    explicit ThinTransmit(GgxAlpha roughness) noexcept : alpha(roughness) {}
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return alpha.smooth(); }
};

}  // namespace lightsieve
