// Metal: GGX microfacets with the exact Fresnel reflectance of a complex index, per channel.
//
// Light that bounces among the facets is compensated (ggx_compensation.h), so a white metal returns everything at any
// roughness. albedo() takes the Fresnel curve at three mean cosines; it is within 0.02 of the integral.
// Source: Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014.
#pragma once

#include "bsdf/ggx.h"
#include "bsdf/lobe.h"

namespace lightsieve {

/// Reflection of a metal, event <RS>. Delta when smooth.
struct ConductorReflect {
    GgxAlpha alpha;
    Color n{1, 1, 1};  ///< index of refraction relative to the side of wo
    Color k{0, 0, 0};  ///< extinction

    ConductorReflect() = default;
    /// n and k; negative and NaN become 0, infinite very large.
    ConductorReflect(GgxAlpha roughness, Color index, Color extinction) noexcept;
    /// The metal with the given reflectance facing the viewer and `edge_tint` (0..1, 1 = brightest) toward the edge.
    [[nodiscard]] static ConductorReflect from_artistic(GgxAlpha roughness, Color reflectivity,
                                                        Color edge_tint) noexcept;

    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept;
    [[nodiscard]] bool delta() const noexcept { return alpha.smooth(); }
};

}  // namespace lightsieve
