// round_corners: normals near an edge as if it were rounded.
//
// The normal is the mean of the surfaces' normals within a sphere around the point. Probes go through the sphere along
// the normal and along two tangents, from points of a disc; the balance heuristic weighs what each may find. The weight
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

/// What one probe adds to the sum of normals.
Vec3f RoundCorners::probe(const ShadePoint& at, Vec3f n, float reach, std::uint32_t i,
                          std::uint32_t n_side) const {
    // A stratified point of the disc, and an axis.
    const float side = static_cast<float>(n_side);
    const float x = (static_cast<float>(i % n_side) + shader_random(at, 1, i)) / side,
                y = (static_cast<float>(i / n_side) + shader_random(at, 2, i)) / side;
    const Vec2f disc = sample_concentric_disk({x, y});
    constexpr std::array<float, 3> kShare{0.5F, 0.25F, 0.25F};
    const Frame around = Frame::from_z(n);
    const std::array<Vec3f, 3> axes{around.z, around.x, around.y};
    const float u = shader_random(at, 3, i);
    const std::size_t axis = u < kShare[0] ? 0 : u < kShare[0] + kShare[1] ? 1 : 2;
    const Frame frame = Frame::from_z(axes[axis]);
    const float half = std::sqrt(std::max(0.0F, 1 - disc.x * disc.x - disc.y * disc.y)) * reach;

    Vec3f sum;
    Probe ray{at.position + (frame.x * disc.x + frame.y * disc.y) * reach + frame.z * half,
              -frame.z,
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
        for (std::size_t a = 0; a < axes.size(); ++a)
            density += kShare[a] * std::abs(dot(axes[a], hit.geometric_normal));
        if (distance < 1 && density > 0) sum += hit.normal * ((1 - distance) / density);
        ray.t_min = std::nextafter(hit.t, kInfinity) + 1e-5F * reach;
        if (!(ray.t_min < ray.t_max)) break;
    }
    return sum;
}

Vec3f RoundCorners::eval(const ShadePoint& at) const {
    const Vec3f n = outward_normal(at, normal);
    if (at.services == nullptr || samples < 1 || !(radius > 0)) return n;
    float reach = radius;
    if (object_space)
        reach *= std::cbrt(std::abs(at.services->world_from_object(at).determinant3()));
    const auto n_side = static_cast<std::uint32_t>(std::min(samples, kMostSamples));
    Vec3f sum;
    for (std::uint32_t i = 0; i < n_side * n_side; ++i)
        sum += probe(at, n, reach, i, n_side);
    return normalize(sum, n);
}

}  // namespace

NodeType node_round_corners() { return RoundCorners::describe(); }

}  // namespace lightsieve
