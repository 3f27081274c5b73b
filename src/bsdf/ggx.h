// GGX (Trowbridge-Reitz) microfacets: distribution, Smith masking, sampling of visible normals. All inline.
//
// Everything is local: z is the normal, x and y are the axes of anisotropy, wo.z > 0, microfacet normals point to +z.
// The functions take V(w) = sqrt(w.z^2 + (ax w.x)^2 + (ay w.y)^2) instead of Smith's Lambda = (V / |w.z| - 1) / 2,
// which saves most divisions:   G1 = 2 z / (z + V),   G2 = 2 zo zi / (zi Vo + zo Vi)   (height-correlated).
// Sources: Walter et al. 2007; Heitz, "Understanding the Masking-Shadowing Function", JCGT 3(2), 2014; Dupuy and
// Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023.
#pragma once

#include "bsdf/lobe.h"
#include "core/vec.h"

namespace lightsieve {

/// Below this width a lobe is a mirror: it would be narrower than a pixel and too narrow for floats.
inline constexpr float kSmoothAlpha = 1e-3F;

/// Widths of the distribution along x and y, in [0,1].
struct GgxAlpha {
    float x = 0, y = 0;

    GgxAlpha() = default;
    /// Clamps to [0,1]; not finite becomes 0. If one axis is rough, the other is at least kSmoothAlpha.
    GgxAlpha(float along_x, float along_y) noexcept : x(unit(along_x)), y(unit(along_y)) {
        if (!smooth()) x = std::max(x, kSmoothAlpha), y = std::max(y, kSmoothAlpha);
    }
    /// The same along both.
    explicit GgxAlpha(float isotropic) noexcept : GgxAlpha(isotropic, isotropic) {}
    /// As standard_surface maps its parameters: roughness^2, stretched by anisotropy.
    /// roughness   user roughness in [0,1], before squaring
    /// anisotropy  clamped to [0, 0.98]
    [[nodiscard]] static GgxAlpha from_roughness(float roughness, float anisotropy = 0) noexcept {
        const float aspect = std::sqrt(1 - std::min(unit(anisotropy), 0.98F));
        const float squared = square(unit(roughness));
        return {std::min(squared / aspect, 1.0F), squared * aspect};
    }
    /// A delta lobe.
    [[nodiscard]] bool smooth() const noexcept { return std::max(x, y) < kSmoothAlpha; }
    /// Width of the isotropic lobe that returns about as much light to wo. Fitted: the width across the plane of
    /// incidence counts most, at normal incidence both count the same; E comes out within 3 % (rms).
    [[nodiscard]] float toward(Vec3f wo) const noexcept {
        if (x == y) return x;
        const float x2 = x * x, y2 = y * y, across2 = wo.x * wo.x + wo.y * wo.y;
        const float along =
            across2 > 1e-6F ? (x2 * wo.x * wo.x + y2 * wo.y * wo.y) / across2 : 0.5F * (x2 + y2);
        return std::min(std::sqrt(lerp(x2 + y2 - along, along, 0.5F * wo.z)), 1.0F);
    }
    /// 0: isotropic, toward 1: stretched.
    [[nodiscard]] float stretch() const noexcept { return 1 - std::min(x, y) / std::max(x, y); }

  private:
    static float unit(float v) { return v > 0 ? std::min(v, 1.0F) : 0.0F; }  // NaN: 0
};

/// V(w), see above.
[[nodiscard]] inline float ggx_v(Vec3f w, GgxAlpha alpha) noexcept {
    return std::sqrt(w.z * w.z + square(alpha.x * w.x) + square(alpha.y * w.y));
}

/// Density D of microfacets with the direction of h, which need not be a unit vector.
/// h_squared  its squared length, > 0
[[nodiscard]] inline float ggx_d(Vec3f h, float h_squared, GgxAlpha alpha) noexcept {
    const float q = square(h.x / alpha.x) + square(h.y / alpha.y) + h.z * h.z;
    return square(h_squared / q) * (kInvPi / (alpha.x * alpha.y));
}

/// cos and sin of 2 pi u for u in [0,1], within 1e-6. Polynomials, so the same bits everywhere.
[[nodiscard]] inline Vec2f cos_sin_2pi(float u) noexcept {
    // Reduce to [-pi/4, pi/4] around a multiple of pi/2.
    const float quarter = std::floor(4 * u + 0.5F);
    const float x = (u - 0.25F * quarter) * (2 * kPi), x2 = x * x;
    const float s = x * (1 + x2 * (-1.6666655E-1F + x2 * (8.3321609E-3F - 1.9515296E-4F * x2)));
    const float c =
        1 - 0.5F * x2 + x2 * x2 * (4.1666646E-2F + x2 * (-1.3887316E-3F + 2.4433157E-5F * x2));
    // Turn back by that multiple.
    const int turn = static_cast<int>(quarter) & 3;
    const float cos_value = (turn & 1) != 0 ? s : c, sin_value = (turn & 1) != 0 ? c : s;
    return {turn == 1 || turn == 2 ? -cos_value : cos_value, turn >= 2 ? -sin_value : sin_value};
}

/// A microfacet normal (unit vector) that wo sees, with density G1(wo) D(h) max(0, wo . h) / wo.z.
[[nodiscard]] inline Vec3f ggx_sample_visible_normal(Vec3f wo, GgxAlpha alpha, Vec2f u) noexcept {
    // Stretch wo to the hemisphere of unit roughness, draw a point of the cap of reflections, unstretch.
    const Vec3f stretched = Vec3f{alpha.x * wo.x, alpha.y * wo.y, wo.z} * (1 / ggx_v(wo, alpha));
    const Vec2f direction = cos_sin_2pi(u.x);
    const float z = (1 - u.y) * (1 + stretched.z) - stretched.z;
    const float r = safe_sqrt(1 - z * z);
    const Vec3f h = Vec3f{r * direction.x, r * direction.y, z} + stretched;
    const Vec3f facet{alpha.x * h.x, alpha.y * h.y, std::max(h.z, 1e-7F)};
    return facet * (1 / std::sqrt(length_squared(facet)));
}

/// Reflection by white microfacets.
struct GgxReflection {
    float f = 0;          ///< D G2 / (4 wo.z), i.e. f * cos for F = 1
    float pdf = 0;        ///< of sampling visible normals
    float cos_theta = 0;  ///< between wo and the microfacet
};

/// Value and density for two directions above the surface; not for smooth lobes.
[[nodiscard]] inline GgxReflection ggx_reflection(Vec3f wo, Vec3f wi, GgxAlpha alpha) noexcept {
    const Vec3f h = wo + wi;
    const float h_squared = length_squared(h);
    const float d = ggx_d(h, h_squared, alpha);
    const float v_o = ggx_v(wo, alpha), v_i = ggx_v(wi, alpha);
    return {0.5F * d * wi.z / (wi.z * v_o + wo.z * v_i), 0.5F * d / (wo.z + v_o),
            std::min(0.5F * std::sqrt(h_squared), 1.0F)};
}

/// eval() of a rough GGX reflection lobe for wi.z > 0.
/// fresnel  gives the reflectance of a microfacet for its cosine, with everything else that scales it
template <class Fresnel>
[[nodiscard]] inline LobeEval ggx_eval_reflection(Vec3f wo, Vec3f wi, GgxAlpha alpha,
                                                  const Fresnel& fresnel) noexcept {
    const GgxReflection r = ggx_reflection(wo, wi, alpha);
    return {fresnel(r.cos_theta) * r.f, r.pdf};
}

/// sample() of a GGX reflection lobe, smooth or rough.
template <class Fresnel>
[[nodiscard]] inline LobeSample ggx_sample_reflection(Vec3f wo, Vec2f u, GgxAlpha alpha,
                                                      const Fresnel& fresnel) noexcept {
    if (alpha.smooth()) return {{-wo.x, -wo.y, wo.z}, fresnel(wo.z), 1};
    const Vec3f h = ggx_sample_visible_normal(wo, alpha, u);
    const Vec3f wi = h * (2 * dot(wo, h)) - wo;
    if (!(wi.z > 0)) return {};
    const GgxReflection r = ggx_reflection(wo, wi, alpha);
    return {wi, fresnel(r.cos_theta) * r.f, r.pdf};
}

}  // namespace lightsieve
