// Lights: where they are, how bright toward a point, how to sample them. One class a light node.
//
// A light's radiance toward a point and the density with which `sample` chooses that direction are always found
// together, so that both strategies of multiple importance sampling agree by construction.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/name.h"
#include "core/vec.h"
#include "scene/shape.h"

namespace lightsieve {

/// Parameters of every light node; `describe_light_common` (nodes/light/light_common.h) documents them.
struct LightCommon {
    Color color{1, 1, 1};
    float intensity = 1, exposure = 0;
    bool cast_shadows = true, cast_volumetric_shadows = true;
    float shadow_density = 1;
    Color shadow_color{0, 0, 0};
    std::int32_t samples = 1, volume_samples = 2;
    bool normalize = true;
    /// Factors on what the light adds: seen directly, through transmission, by lobes, indirectly.
    float camera = 0, transmission = 0, diffuse = 1, specular = 1, sss = 1, indirect = 1,
          volume = 1;
    std::int32_t max_bounces = 999;
    Name aov;                   ///< the light group; empty or "default": none
    bool aov_indirect = false;  ///< skydome only: its light counts as background
    Array<NodeRef> filters;
    Array<Mat4f> matrix;
    float motion_start = 0, motion_end = 1;

    /// color * intensity * 2^exposure without the colour: the factor on `color`.
    [[nodiscard]] float strength() const { return intensity * std::exp2(exposure); }
};

/// A direction toward a light.
struct LightSample {
    Vec3f wi;            ///< unit, from the shaded point toward the light
    float distance = 0;  ///< to the light's surface; kInfinity for distant lights
    Color
        radiance;  ///< arriving along wi [W/(m^2 sr)]; for delta lights the irradiance of a facing plane
    float pdf = 0;       ///< per solid angle; 1 for delta lights; 0: no light comes from there
    bool delta = false;  ///< no other strategy can find this light (point, distant without angle)
};

/// Radiance toward a point, and the density with which sample() would have chosen that direction.
struct LightEval {
    Color radiance;
    float pdf = 0;  ///< per solid angle
};

/// A point on a light's geometry, met by a ray.
struct LightHit {
    Vec3f position;
    Vec3f normal;  ///< unit, the geometry's outward side
    Vec2f uv;
    std::uint32_t primitive = 0;
    float distance = 0;  ///< from the ray's origin
};

/// Where a light is and how much it can send where: for choosing among many lights.
/// Source: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".
struct LightBounds {
    Box3f box;               ///< of the emitting points
    Vec3f axis{0, 0, 1};     ///< of the cone of normals
    float cos_spread = -1;   ///< half angle of the cone of normals (theta_o); -1: all directions
    float cos_emission = 0;  ///< further angle to which light leaves (theta_e); 0: a half space
    float intensity =
        0;  ///< largest radiant intensity in any direction, mean of the channels [W/sr]
};

class Light {
  public:
    virtual ~Light() = default;
    /// A direction from `from` toward the light; pdf 0 if none.
    [[nodiscard]] virtual LightSample sample(Vec3f from, Vec2f u) const = 0;
    /// The same for a surface that faces along unit vector `normal` and has no use for light from behind: lights all
    /// around choose better directions. Zero: light from everywhere counts.
    [[nodiscard]] virtual LightSample sample_facing(Vec3f from, Vec3f normal, Vec2f u) const;
    /// A ray from `from` met the light's geometry.
    [[nodiscard]] virtual LightEval hit(Vec3f from, const LightHit& at) const;
    /// A ray from `from` left the scene along unit vector `direction`; black for lights of finite distance.
    [[nodiscard]] virtual LightEval escape(Vec3f from, Vec3f direction) const;
    /// The same with the density of `sample_facing`.
    [[nodiscard]] virtual LightEval escape_facing(Vec3f from, Vec3f normal, Vec3f direction) const;
    /// What a ray of the camera finds, which sees skies beside their portals, too.
    [[nodiscard]] virtual LightEval seen(Vec3f from, Vec3f direction) const;
    /// Before the first ray: the portals of the scene, through which skies may want to shine. They outlive the light.
    virtual void set_portals(std::span<const Light* const> portals);
    /// What rays can meet, in world space; null for lights without extent and for infinite ones.
    [[nodiscard]] virtual const ShapeGeometry* geometry() const { return nullptr; }
    /// Infinitely far: chosen apart from the others, found by rays that leave the scene.
    [[nodiscard]] virtual bool infinite() const { return false; }
    /// True for the skydome: seen directly by the camera it is background (B), not L.
    [[nodiscard]] virtual bool is_skydome() const { return false; }
    /// Infinite lights: only `axis`, in which their light travels, and `cos_spread`, the cone around it.
    [[nodiscard]] virtual LightBounds bounds() const = 0;
    /// For infinite lights: irradiance that it can give to a facing plane, mean of the channels [W/m^2].
    [[nodiscard]] virtual float irradiance() const { return 0; }
};

inline LightSample Light::sample_facing(Vec3f from, Vec3f, Vec2f u) const {
    return sample(from, u);
}
inline LightEval Light::escape_facing(Vec3f from, Vec3f, Vec3f direction) const {
    return escape(from, direction);
}
inline LightEval Light::hit(Vec3f, const LightHit&) const { return {}; }
inline LightEval Light::escape(Vec3f, Vec3f) const { return {}; }
inline LightEval Light::seen(Vec3f from, Vec3f direction) const { return escape(from, direction); }
inline void Light::set_portals(std::span<const Light* const>) {}

}  // namespace lightsieve
