// Openings through which the light of a sky comes in: quad lights with `portal` on.
//
// Seen from a point in a room, most of the sky is wall. Directions drawn through the windows find what is left. An
// opening is chosen by how large it looks from the point, then a direction uniformly over its solid angle; densities
// of a direction that leads through several add up.
// Source of the idea: Bitterli, Novak and Jarosz 2015, "Portal-Masked Environment Map Sampling", whose product with the
// picture of the sky is left out.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/sampling.h"
#include "scene/light.h"

namespace lightsieve {

class Portals {
  public:
    Portals() = default;
    /// lights  of quad lights that are portals; must outlive this
    explicit Portals(std::span<const Light* const> lights) {
        for (const Light* light : lights)
            if (light->geometry() != nullptr) portals_.emplace_back(*light);
    }

    [[nodiscard]] bool empty() const { return portals_.empty(); }

    /// A direction from `from` through a portal, toward the outside; nothing where none can be seen.
    [[nodiscard]] std::optional<Vec3f> sample(Vec3f from, Vec2f u) const {
        const float sum = total(from);
        float left = u.x * sum;
        for (const Portal& portal : portals_) {
            const float size = portal.apparent_size(from);
            if (!(size > 0)) continue;
            if (left >= size) {
                left -= size;
                continue;
            }
            const LightSample through =
                portal.light->sample(from, {std::min(left / size, kOneMinusEpsilon), u.y});
            return through.pdf > 0 ? std::optional(through.wi) : std::nullopt;
        }
        return std::nullopt;
    }
    /// Density of `sample`, per solid angle; 0 for directions through no portal.
    [[nodiscard]] float pdf(Vec3f from, Vec3f wi) const {
        const float sum = total(from);
        if (!(sum > 0)) return 0;
        float out = 0;
        for (const Portal& portal : portals_)
            if (const float size = portal.apparent_size(from); size > 0)
                out += size / sum * portal.pdf(from, wi);
        return out;
    }
    /// Whether any portal can be seen from a point.
    [[nodiscard]] bool seen_from(Vec3f from) const { return total(from) > 0; }

  private:
    struct Portal {
        explicit Portal(const Light& of) : light(&of) {
            const LightBounds bounds = of.bounds();
            normal = bounds.axis;
            center = (bounds.box.lower + bounds.box.upper) * 0.5F;
            area = bounds.intensity;  // its radiance is 1
        }
        /// About the solid angle: exact from afar, bounded from near; 0 exactly where its lit side cannot be seen.
        [[nodiscard]] float apparent_size(Vec3f from) const {
            const Vec3f d = from - center;
            const float facing = dot(d, normal);
            if (!(facing > 0)) return 0;
            // What is edge-on at its centre is not so at its sides.
            const float r2 = length_squared(d) + area;
            const float cosine = (facing + 0.1F * std::sqrt(area)) / std::sqrt(r2);
            return area * std::min(cosine, 1.0F) / r2;
        }
        [[nodiscard]] float pdf(Vec3f from, Vec3f wi) const;

        const Light* light;
        Vec3f normal, center;
        float area;
    };

    [[nodiscard]] float total(Vec3f from) const {
        float sum = 0;
        for (const Portal& portal : portals_)
            sum += portal.apparent_size(from);
        return sum;
    }

    std::vector<Portal> portals_;
};

/// Density with which the portal alone gives a direction: where it meets one of its two triangles.
/// Source: Moeller and Trumbore 1997.
inline float Portals::Portal::pdf(Vec3f from, Vec3f wi) const {
    if (!(dot(wi, normal) < 0)) return 0;
    const TriangleMesh& mesh = std::get<TriangleMesh>(light->geometry()->data);
    for (std::uint32_t t = 0; 3 * t < mesh.indices.size(); ++t) {
        const auto corner = [&](std::uint32_t i) { return mesh.indices[3 * t + i]; };
        const Vec3f a = mesh.positions[0][corner(0)], ab = mesh.positions[0][corner(1)] - a,
                    ac = mesh.positions[0][corner(2)] - a;
        const Vec3f p = cross(wi, ac), s = from - a, q = cross(s, ab);
        const float inverse = 1 / dot(ab, p);
        const float u = dot(s, p) * inverse, v = dot(wi, q) * inverse,
                    distance = dot(ac, q) * inverse;
        // A little room at the edges, where sampled directions are rounded.
        constexpr float kRoom = 1e-5F;
        if (!(u >= -kRoom && v >= -kRoom && u + v <= 1 + kRoom && distance > 0)) continue;
        LightHit hit;
        hit.position = from + wi * distance;
        hit.normal = normal;
        hit.primitive = t;
        hit.distance = distance;
        hit.uv = mesh.uvs[mesh.uv_indices[3 * t]] * (1 - u - v) +
                 mesh.uvs[mesh.uv_indices[3 * t + 1]] * u +
                 mesh.uvs[mesh.uv_indices[3 * t + 2]] * v;
        return light->hit(from, hit).pdf;
    }
    return 0;
}

}  // namespace lightsieve
