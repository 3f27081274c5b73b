// cylinder_light: the mantle of a cylinder that shines outward (a neon tube).
#include "nodes/light/light_common.h"
#include "nodes/light/triangle_light.h"

namespace lightsieve {
namespace {

constexpr Vec3f kTop{0, 1, 0}, kBottom{0, -1, 0};
constexpr float kRadius = 1;
/// Facets around the mantle; what rays meet and what is sampled are the same facets.
constexpr std::uint32_t kFacets = 64;

struct CylinderLight : LightCommon {
    Array<Vec3f> top{&kTop, 1, 1}, bottom{&kBottom, 1, 1};  ///< ends of the axis, in light space
    Array<float> radius{&kRadius, 1, 1};                    ///< in light space

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Light> make_light(NodeContext& context) const;
};

/// The mantle in world space, wound so that the outer side shines.
TriangleMesh mantle(Vec3f bottom, Vec3f top, float radius, const Mat4f& matrix) {
    const Frame frame = Frame::from_z(lightsieve::normalize(top - bottom));
    const bool flip = matrix.determinant3() < 0;
    TriangleMesh mesh;
    mesh.positions.resize(1);
    // Facets touch the circle at a mean radius: as much area as the true mantle has.
    const float r = radius * (kPi / kFacets) / std::sin(kPi / kFacets);
    for (std::uint32_t i = 0; i <= kFacets; ++i) {
        const float angle = 2 * kPi * static_cast<float>(i % kFacets) / kFacets;
        const Vec3f around = frame.x * (r * std::cos(angle)) + frame.y * (r * std::sin(angle));
        mesh.positions[0].push_back(matrix.point(bottom + around));
        mesh.positions[0].push_back(matrix.point(top + around));
        const float u = static_cast<float>(i) / kFacets;
        mesh.uvs.push_back({u, 0});
        mesh.uvs.push_back({u, 1});
    }
    for (std::uint32_t i = 0; i < kFacets; ++i) {
        const std::uint32_t a = 2 * i, b = a + 2, c = a + 3, d = a + 1;
        for (const std::array<std::uint32_t, 3> t : {std::array{a, b, c}, std::array{a, c, d}}) {
            for (const std::size_t k : {0UL, flip ? 2UL : 1UL, flip ? 1UL : 2UL})
                mesh.indices.push_back(t[k]);
            mesh.face.push_back(i);
        }
    }
    mesh.uv_indices = mesh.corner = mesh.indices;
    return mesh;
}

NodeType CylinderLight::describe() {
    Describe<CylinderLight> d("cylinder_light", NodeKind::Light,
                              "The mantle of a cylinder that shines outward with radiance I / "
                              "area, or I without normalize; I = color * intensity * 2^exposure.");
    d.param("top", &CylinderLight::top, "One end of the axis, in light space.");
    d.param("bottom", &CylinderLight::bottom, "The other end of the axis, in light space.");
    d.param("radius", &CylinderLight::radius, "Radius; the matrix scales it.")
        .unit("scene units")
        .hard_range(0, kInfinity);
    describe_light_common(d);
    return d.done();
}

std::unique_ptr<Light> CylinderLight::make_light(NodeContext& context) const {
    const std::optional<Emission> emission = make_emission(*this, context);
    const std::optional<Mat4f> placement = world_from_light(*this, context);
    const std::optional<Vec3f> upper = finite_value(top, kTop, "top", context);
    const std::optional<Vec3f> lower = finite_value(bottom, kBottom, "bottom", context);
    const std::optional<float> size = finite_value(radius, kRadius, "radius", context);
    if (!emission || !placement || !upper || !lower || !size) return nullptr;
    auto light = std::make_unique<TriangleLight>(
        mantle(*lower, *upper, std::max(0.0F, *size), *placement), *emission, normalize);
    if (!(light->area() > 0)) warn_no_area(context, "radius");
    return light;
}

}  // namespace

NodeType node_cylinder_light() { return CylinderLight::describe(); }

}  // namespace lightsieve
