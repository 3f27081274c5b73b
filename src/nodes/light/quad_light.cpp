// quad_light: a flat quadrilateral that shines on one side.
#include "core/sampling.h"
#include "nodes/light/light_common.h"
#include "nodes/light/rectangle.h"
#include "nodes/light/triangle_light.h"

namespace lightsieve {
namespace {

/// The corners that exporters write: seen from the lit side (from -Z) they run counter-clockwise from the lower left.
constexpr std::array<Vec3f, 4> kVertices{{{1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}};
/// Corners may be this far, relative to the size, from those of a rectangle to be sampled as one.
constexpr float kRectangleTolerance = 1e-5F;

struct QuadLight : LightCommon {
    Array<Vec3f> vertices{kVertices.data(), 4, 1};  ///< in light space
    std::int32_t resolution = 512;
    float spread = 1, roundness = 0, soft_edge = 0;
    bool portal = false;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Light> make_light(NodeContext& context) const;
};

/// Two triangles over four corners; corner i has the texture coordinate of a square.
TriangleMesh quad_mesh(const std::array<Vec3f, 4>& p) {
    TriangleMesh mesh;
    mesh.positions = {{p.begin(), p.end()}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.uv_indices = mesh.indices;
    mesh.face = {0, 0};
    mesh.corner = mesh.indices;
    return mesh;
}

/// A rectangle, sampled by solid angle.
class RectangleSource final : public Light {
  public:
    /// p  corners whose winding says which side shines: the one from which they run counter-clockwise
    RectangleSource(const std::array<Vec3f, 4>& p, const Emission& radiance)
        : rectangle_(p[0], p[1] - p[0], p[3] - p[0]), radiance_(radiance) {
        geometry_.data = quad_mesh(p);
        for (const Vec3f corner : p)
            bounds_.box.grow(corner);
        bounds_.axis = rectangle_.normal();
        bounds_.cos_spread = 1;
        bounds_.intensity = radiance.magnitude() * rectangle_.area();
    }

    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        const RectangleView view(rectangle_, from);
        if (!view.visible()) return {};
        const RectangleView::Sample s = view.sample(u);
        const Vec3f toward = s.position - from;
        const float distance = length(toward);
        const float pdf = view.pdf(s);
        if (!(pdf > 0)) return {};
        return {toward / distance, distance, radiance_.at(s.position, rectangle_.normal(), s.uv),
                pdf, false};
    }
    [[nodiscard]] LightEval hit(Vec3f from, const LightHit& at) const override {
        const RectangleView view(rectangle_, from);
        if (!view.visible()) return {};
        return {radiance_.at(at.position, rectangle_.normal(), at.uv),
                view.pdf({at.position, at.uv})};
    }
    [[nodiscard]] const ShapeGeometry* geometry() const override { return &geometry_; }
    [[nodiscard]] LightBounds bounds() const override { return bounds_; }

  private:
    Rectangle rectangle_;
    Emission radiance_;
    ShapeGeometry geometry_;
    LightBounds bounds_;
};

bool is_rectangle(const std::array<Vec3f, 4>& p) {
    const Vec3f x = p[1] - p[0], y = p[3] - p[0];
    const float size = length(x) + length(y);
    return length(p[0] + p[2] - p[1] - p[3]) <= kRectangleTolerance * size &&
           std::abs(dot(x, y)) <= kRectangleTolerance * length(x) * length(y);
}

NodeType QuadLight::describe() {
    Describe<QuadLight> d("quad_light", NodeKind::Light,
                          "A flat quadrilateral that shines on one side with radiance I / area, "
                          "or I without normalize; I = color * intensity * 2^exposure.");
    d.param("vertices", &QuadLight::vertices,
            "Four corners in light space; light leaves on the side from which they run "
            "counter-clockwise.");
    d.param("resolution", &QuadLight::resolution,
            "Size of Arnold's table for sampling textured lights.")
        .ignored();
    d.param("spread", &QuadLight::spread,
            "1: light leaves to all sides; less: focused along the normal.")
        .range(0, 1)
        .pending();
    d.param("roundness", &QuadLight::roundness, "Rounds the corners, up to a disc.")
        .range(0, 1)
        .pending();
    d.param("soft_edge", &QuadLight::soft_edge, "Width of a smooth edge, relative to the size.")
        .range(0, 1)
        .pending();
    d.param("portal", &QuadLight::portal, "Only lets skydome light in.").pending();
    describe_light_common(d);
    return d.done();
}

std::unique_ptr<Light> QuadLight::make_light(NodeContext& context) const {
    const std::optional<Emission> emission = make_emission(*this, context);
    const std::optional<Mat4f> placement = world_from_light(*this, context);
    if (!emission || !placement) return nullptr;
    if (vertices.n * vertices.n_keys < 4) {
        context.diagnostics().error(
            Code::InvalidValue,
            "quad light \"" + context.node_name().str() + "\" has fewer than four corners",
            context.where("vertices"), "write `vertices 4 1 VECTOR` and four points");
        return nullptr;
    }
    std::array<Vec3f, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
        p[i] = placement->point(vertices[i]);
        if (is_finite(p[i])) continue;
        context.diagnostics().error(
            Code::InvalidValue,
            "a corner of quad light \"" + context.node_name().str() + "\" is not finite",
            context.where("vertices"), "write finite numbers");
        return nullptr;
    }
    // A mirroring matrix turns the winding, but light still leaves along local -Z.
    if (placement->determinant3() < 0) {
        std::swap(p[0], p[1]);
        std::swap(p[2], p[3]);
    }
    auto triangles = std::make_unique<TriangleLight>(quad_mesh(p), *emission, normalize);
    if (!(triangles->area() > 0)) {
        warn_no_area(context, "vertices");
        return triangles;
    }
    if (!is_rectangle(p)) return triangles;
    return std::make_unique<RectangleSource>(
        p, emission->scaled(normalize ? 1 / triangles->area() : 1));
}

}  // namespace

NodeType node_quad_light() { return QuadLight::describe(); }

}  // namespace lightsieve
