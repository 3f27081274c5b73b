// round_corners: normals near an edge as if it were rounded.
//
// The normal is the mean of the surfaces' normals within a sphere around the point. Probes go through the sphere along
// the normal and along two tangents, through points of a disc; the balance heuristic weighs what each may find. The weight
// falls from the centre to the sphere's border as a cone.
// Source: King, Kulla, Conty and Fajardo 2013, "BSSRDF Importance Sampling" (the axes of the probes).
#include <array>

#include "core/sampling.h"
#include "nodes/bump/bump_common.h"

namespace lightsieve {
namespace {

/// Most probes a point: samples are squared.
constexpr std::int32_t kMostSamples = 16;

struct RoundCorners {
    std::int32_t samples = 6;
    float radius = 0.01F;
    Vec3f normal;
    Name trace_set;
    bool inclusive = true, self_only = false, object_space = true;

    static NodeType describe();
    void prepare(NodeContext& context) {
        if (!context.is_linked("normal")) normal = {};
    }
    [[nodiscard]] Vec3f eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] Vec3f probe(const ShadePoint& at, Vec3f n, float reach, std::uint32_t i,
                              std::uint32_t n_side) const;
};

NodeType RoundCorners::describe() {
    Describe<RoundCorners> d("round_corners", NodeKind::Shader,
                             "Normals near an edge as if it were rounded.");
    d.param("samples", &RoundCorners::samples, "Square root of the number of probes.")
        .range(0, 16);
    d.param("radius", &RoundCorners::radius, "Radius of the rounding.").unit("scene units");
    d.param("normal", &RoundCorners::normal,
            "Normal to start from, world space; acts when linked.");
    d.param("trace_set", &RoundCorners::trace_set, "Set of shapes that are met, or not met.");
    d.param("inclusive", &RoundCorners::inclusive,
            "Shapes of trace_set are met, else all but those.");
    d.param("self_only", &RoundCorners::self_only, "Only the shape itself is met.");
    d.param("object_space", &RoundCorners::object_space,
            "radius is a length of the object, which its scale changes.");
    return d.done();
}

/// What the probes through one point of the disc add to the sum of normals: one along each axis.
Vec3f RoundCorners::probe(const ShadePoint& at, Vec3f n, float reach, std::uint32_t i,
                          std::uint32_t n_side) const {
    const Vec2f disc = sample_concentric_disk(shader_stratum(at, 1, i, n_side));
    const float half = std::sqrt(std::max(0.0F, 1 - disc.x * disc.x - disc.y * disc.y)) * reach;
    const Frame around = Frame::from_z(n);
    const std::array<Vec3f, 3> axes{around.z, around.x, around.y};
    Vec3f sum;
    for (const Vec3f axis : axes) {
        const Frame frame = Frame::from_z(axis);
        Probe ray{at.position + (frame.x * disc.x + frame.y * disc.y) * reach + axis * half,
                  -axis,
                  0,
                  2 * half,
                  self_only,
                  trace_set,
                  inclusive};
        ProbeHit hit;
        constexpr int kMostHits = 8;
        for (int found = 0; found < kMostHits && at.services->trace(at, ray, hit); ++found) {
            const float distance = length(hit.position - at.position) / reach;
            float density = 0;  // of finding this point, all axes together
            for (const Vec3f a : axes)
                density += std::abs(dot(a, hit.geometric_normal));
            if (distance < 1 && density > 0) sum += hit.normal * ((1 - distance) / density);
            ray.t_min = std::nextafter(hit.t, kInfinity) + 1e-5F * reach;
            if (!(ray.t_min < ray.t_max)) break;
        }
    }
    return sum;
}

Vec3f RoundCorners::eval(const ShadePoint& at) const {
    const Vec3f n = outward_normal(at, {}), linked = outward_normal(at, normal);
    if (at.services == nullptr || samples < 1 || !(radius > 0)) return linked;
    float reach = radius;
    if (object_space)
        reach *= std::cbrt(std::abs(at.services->world_from_object(at).determinant3()));
    // What is seen by the way needs no more than one sample.
    const bool seen = at.ray == nullptr || at.ray->bounces == 0;
    const auto n_side = static_cast<std::uint32_t>(seen ? std::min(samples, kMostSamples) : 1);
    Vec3f sum;
    for (std::uint32_t i = 0; i < n_side * n_side; ++i)
        sum += probe(at, n, reach, i, n_side);
    // What the linked normal leans away from the surface's own comes on top of the rounding.
    return normalize(normalize(sum, n) + (linked - n), linked);
}

}  // namespace

NodeType node_round_corners() { return RoundCorners::describe(); }

}  // namespace lightsieve
