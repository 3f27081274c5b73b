#include "bsdf/subsurface.h"

#include <algorithm>
#include <cmath>

namespace lightsieve {
namespace {

constexpr float kMaxAnisotropy = 0.98F;
/// Shortest mean free path over the longest: shorter ones would take many steps to no visible effect.
constexpr float kShortest = 1e-3F;

float unit(float v) { return v > 0 ? std::min(v, 1.0F) : 0.0F; }  // NaN: 0
float finite_positive(float v) { return v > 0 && std::isfinite(v) ? v : 0.0F; }

/// Single-scattering albedo of a half-space with diffuse reflectance r; isotropic, then by similarity with anisotropy g.
float albedo_of(float r, float g) {
    const float d =
        4.09712F + 4.20863F * r - std::sqrt(9.59217F + 41.6808F * r + 17.7126F * r * r);
    const float isotropic = unit(1 - d * d);
    return isotropic / (1 - g * (1 - isotropic));
}

}  // namespace

SubsurfaceMedium::SubsurfaceMedium(Color color, Color radius, float mean_cosine) noexcept
    : reflectance(unit(color.r), unit(color.g), unit(color.b)),
      anisotropy(std::isfinite(mean_cosine)
                     ? std::clamp(mean_cosine, -kMaxAnisotropy, kMaxAnisotropy)
                     : 0) {
    const Color r{finite_positive(radius.r), finite_positive(radius.g), finite_positive(radius.b)};
    const float least = std::max(kShortest * max_component(r), 1e-12F);
    for (int c = 0; c < 3; ++c) {
        albedo[c] = albedo_of(reflectance[c], anisotropy);
        mean_free_path[c] = std::max(r[c], least);
    }
}

bool SubsurfaceMedium::has_depth(Color radius) noexcept {
    return max_component(radius) > 0 && is_finite(radius);
}

Vec3f sample_henyey_greenstein(Vec3f along, float g, Vec2f u) noexcept {
    float cosine = 1 - 2 * u.x;
    if (std::abs(g) > 1e-3F) {
        const float s = (1 - g * g) / (1 + g - 2 * g * u.x);
        cosine = std::clamp((1 + g * g - s * s) / (2 * g), -1.0F, 1.0F);
    }
    const float sine = safe_sqrt(1 - cosine * cosine), phi = 2 * kPi * u.y;
    return Frame::from_z(along).world_from_local(
        {sine * std::cos(phi), sine * std::sin(phi), cosine});
}

}  // namespace lightsieve
