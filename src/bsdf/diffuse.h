// Diffuse reflection and its mirror image, diffuse transmission through a thin sheet.
//
// Roughness 0 is exactly Lambert. Above, the energy-preserving Oren-Nayar model (EON): the single-scattering
// part of Fujii's "QON" plus a multiple-scattering part, so that a white surface returns everything at any
// roughness. The multiple-scattering part depends on the reflectance, so the colour belongs to the model and not to
// the closure's weight. Sampling is cosine-weighted.
// Source: Portsmouth, Kutz, Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025.
#pragma once

#include "bsdf/lobe.h"

namespace lightsieve {

/// Reflectance and roughness of a rough diffuse surface; what DiffuseReflect and DiffuseTransmit share.
struct DiffuseSurface {
    Color color{0, 0, 0};  ///< reflectance, >= 0; above 1 only the single scattering grows
    float roughness = 0;   ///< 0 (Lambert) to 1, the r of the paper

    DiffuseSurface() = default;
    /// Clamps the roughness to [0,1] and negative colours to 0; not finite becomes 0.
    DiffuseSurface(Color reflectance, float diffuse_roughness) noexcept
        : color(non_negative(reflectance.r), non_negative(reflectance.g),
                non_negative(reflectance.b)),
          roughness(std::min(non_negative(diffuse_roughness), 1.0F)) {}
    /// f(wo, wi) * cos theta_i for two directions above the surface [1/sr].
    [[nodiscard]] Color value(Vec3f wo, Vec3f wi) const noexcept {
        return roughness == 0 ? color * (kInvPi * wi.z) : rough_value(wo, wi);
    }
    /// Directional albedo for cos theta_o in (0,1].
    [[nodiscard]] Color albedo(float cos_theta_o) const noexcept {
        return roughness == 0 ? color : rough_albedo(cos_theta_o);
    }

  private:
    [[nodiscard]] Color rough_value(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] Color rough_albedo(float cos_theta_o) const noexcept;
    static float non_negative(float v) { return v > 0 && std::isfinite(v) ? v : 0.0F; }
};

/// Diffuse reflection, event <RD>.
struct DiffuseReflect {
    DiffuseSurface surface;

    DiffuseReflect() = default;
    explicit DiffuseReflect(Color color, float roughness = 0) noexcept
        : surface(color, roughness) {}
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept {
        return wi.z > 0 ? LobeEval{surface.value(wo, wi), kInvPi * wi.z} : LobeEval{};
    }
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept { return surface.albedo(wo.z); }
    [[nodiscard]] bool delta() const noexcept { return false; }
};

/// Diffuse transmission of a sheet without thickness, event <TD>: DiffuseReflect mirrored at the surface.
struct DiffuseTransmit {
    DiffuseSurface surface;

    DiffuseTransmit() = default;
    explicit DiffuseTransmit(Color color, float roughness = 0) noexcept
        : surface(color, roughness) {}
    [[nodiscard]] LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;
    [[nodiscard]] LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
    [[nodiscard]] Color albedo(Vec3f wo) const noexcept { return surface.albedo(wo.z); }
    [[nodiscard]] bool delta() const noexcept { return false; }
};

}  // namespace lightsieve
