// Transmission through a sheet without thickness (thin_walled): no bending.
//
// Smooth, the ray goes straight on. Rough, the lobe is a lossless GGX reflection lobe mirrored at the surface; its
// directional albedo is 1 (multiple scattering included), so that the layering's 1 - R is the only loss.
#pragma once

#include "bsdf/ggx.h"
#include "bsdf/lobe.h"

namespace lightsieve {

/// Straight or blurred transmission, event <TS>. Delta when smooth.
struct ThinTransmit {
    GgxAlpha alpha;

    ThinTransmit() = default;
    /// roughness  width of the mirrored reflection lobe
    explicit ThinTransmit(GgxAlpha roughness) noexcept : alpha(roughness) {}
    /// Through a sheet: two rough interfaces with the index `ior` between them.
    ///
    /// A facet that leans by a small angle t turns what it reflects by 2 t, what it refracts by (ior - 1) t in the end. The
    /// density of the sum of two such turns peaks at a third of that of one (slopes of GGX are Student's t with two degrees
    /// of freedom, characteristic function alpha k K1(alpha k)); the lobe with that peak is sqrt(3) as wide as one turn's.
    [[nodiscard]] static ThinTransmit through_sheet(GgxAlpha interfaces, float ior) noexcept;
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return alpha.smooth(); }
};

}  // namespace lightsieve
