// Rays that feel what is near: their directions, and ambient occlusion for ambient_occlusion and utility.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "nodes/shader/shader_common.h"
#include "scene/shade_services.h"

namespace lightsieve {

/// What counts as near, and from where.
struct OcclusionSettings {
    std::int32_t samples = 3;  ///< squared
    float spread = 1;          ///< 1: a half space around the normal
    float near_clip = 0, far_clip = 100, falloff = 0;
    Vec3f normal;  ///< unit, on the side that is looked at
    bool invert_normals = false;
    Name trace_set;
    bool inclusive = true, self_only = false;
};

/// Direction number `index` of n_side * n_side: cosine-weighted in the cone around the frame's z that `spread` of the half space
/// leaves.
[[nodiscard]] inline Vec3f probe_direction(const ShadePoint& at, const Frame& frame, float spread,
                                           std::uint32_t stream, std::uint32_t index,
                                           std::uint32_t n_side) {
    const float widest = std::sin(0.5F * kPi * unit(spread));
    const Vec2f disc = sample_concentric_disk(shader_stratum(at, stream, index, n_side)) * widest;
    return frame.world_from_local(
        {disc.x, disc.y, safe_sqrt(1 - disc.x * disc.x - disc.y * disc.y)});
}

/// Part of the cosine-weighted directions that meet something; 0 where no rays can be sent.
[[nodiscard]] inline float occlusion(const ShadePoint& at, const OcclusionSettings& s) {
    constexpr std::int32_t kMostSamples = 32;
    constexpr float kRounding = 1e-5F;  // of positions, relative
    if (at.services == nullptr || s.samples < 1) return 0;
    Vec3f n = s.normal, side = at.entering ? at.geometric_normal : -at.geometric_normal;
    if (s.invert_normals) n = -n, side = -side;
    const Frame frame = Frame::from_z(n);
    const auto n_side = static_cast<std::uint32_t>(std::min(s.samples, kMostSamples));
    const Vec3f p = at.position;
    const float size = 1 + std::max(std::abs(p.x), std::max(std::abs(p.y), std::abs(p.z)));
    float hidden = 0;
    for (std::uint32_t i = 0; i < n_side * n_side; ++i) {
        const Vec3f wi = probe_direction(at, frame, s.spread, 40, i, n_side);
        // A bumped normal may look below the surface, where there is nothing to see.
        if (!(dot(wi, side) > 0)) {
            hidden += 1;
            continue;
        }
        const Probe probe{p + side * (kRounding * size),
                          wi,
                          std::max(0.0F, s.near_clip),
                          s.far_clip > 0 ? s.far_clip : kInfinity,
                          s.self_only,
                          s.trace_set,
                          s.inclusive};
        ProbeHit hit;
        if (at.services->trace(at, probe, hit))
            hidden += s.falloff > 0 ? std::exp(-s.falloff * hit.t) : 1.0F;
    }
    return hidden / static_cast<float>(n_side * n_side);
}

}  // namespace lightsieve
