// disk_light: a flat disc that shines on one side.
#include "core/sampling.h"
#include "nodes/light/flat_profile.h"
#include "nodes/light/light_common.h"

namespace lightsieve {
namespace {

constexpr Vec3f kOrigin{0, 0, 0}, kDirection{0, 0, -1};
constexpr float kRadius = 0.5F;
/// Corners of the polygon around the disc that rays are tested against.
constexpr std::uint32_t kCorners = 64;

struct DiskLight : LightCommon {
    Array<Vec3f> position{&kOrigin, 1, 1};      ///< in light space
    Array<Vec3f> direction{&kDirection, 1, 1};  ///< in light space
    Array<float> radius{&kRadius, 1, 1};        ///< in light space
    float spread = 1;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Light> make_light(NodeContext& context) const;
};

/// An ellipse in space: a disc after a matrix. Sampled by area: its own, or that of the disc around the foot of the
/// perpendicular from which a focused light can come, whichever is smaller.
class DiskSource final : public Light {
  public:
    /// a, b     half axes (conjugate, not necessarily orthogonal); normal: unit, the side that shines
    DiskSource(Vec3f center, Vec3f a, Vec3f b, Vec3f normal, float area, const Emission& radiance,
               const Spread& spread)
        : center_(center),
          a_(a),
          b_(b),
          normal_(normal),
          across_(Frame::from_z(normal)),
          area_(area),
          radiance_(radiance),
          spread_(spread) {
        // Dual vectors: coordinates in units of the half axes.
        const Vec3f n = cross(a, b);
        dual_a_ = cross(b, n) / length_squared(n);
        dual_b_ = cross(n, a) / length_squared(n);
        make_geometry();
        bounds_.axis = normal;
        bounds_.cos_spread = 1;
        bounds_.cos_emission = spread.cosine();
        bounds_.intensity = radiance.magnitude() * area * spread.peak();
    }

    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        const Vec2f d = sample_concentric_disk(u);
        const float height = dot(from - center_, normal_);
        const float reach = reach_of(height);
        const Vec3f on = reach < kInfinity ? from - normal_ * height +
                                                 (across_.x * d.x + across_.y * d.y) * reach
                                           : center_ + a_ * d.x + b_ * d.y;
        const LightEval eval = at(from, on);
        if (!(eval.pdf > 0)) return {};
        const float distance = length(on - from);
        return {(on - from) / distance, distance, eval.radiance, eval.pdf, false};
    }
    [[nodiscard]] LightEval hit(Vec3f from, const LightHit& hit) const override {
        return at(from, hit.position);
    }
    [[nodiscard]] const ShapeGeometry* geometry() const override { return &geometry_; }
    [[nodiscard]] LightBounds bounds() const override { return bounds_; }

  private:
    /// Radius of the disc of points that shine at a height above the light, if that is less than the light; or else
    /// infinity.
    [[nodiscard]] float reach_of(float height) const {
        const float reach = height * spread_.tangent();
        return reach > 0 && kPi * reach * reach < area_ ? reach : kInfinity;
    }

    [[nodiscard]] LightEval at(Vec3f from, Vec3f on) const {
        const Vec3f p = on - center_;
        const Vec2f disk{dot(p, dual_a_), dot(p, dual_b_)};
        // The polygon that rays meet is a little larger than the disc.
        if (!(disk.x * disk.x + disk.y * disk.y <= 1 + 1e-6F)) return {};
        const Vec3f back = from - on;
        const float r2 = length_squared(back), facing = dot(normal_, back);  // distance * cos
        if (!(facing > 0)) return {};
        const float r = std::sqrt(r2), reach = reach_of(facing);
        float area = area_;
        if (reach < kInfinity) {
            if (!(r2 - facing * facing <= reach * reach)) return {};
            area = kPi * reach * reach;
        }
        const float pdf = r2 * r / (facing * area);
        const float factor = spread_.at(normal_, back);
        if (!std::isfinite(pdf) || !(factor > 0)) return {};
        const Vec2f uv{0.5F + 0.5F * disk.x, 0.5F + 0.5F * disk.y};
        return {radiance_.at(on, normal_, uv) * factor, pdf};
    }

    void make_geometry() {
        TriangleMesh mesh;
        mesh.positions.resize(1);
        const float outer = 1 / std::cos(kPi / kCorners);
        const bool flip = dot(cross(a_, b_), normal_) < 0;
        for (std::uint32_t i = 0; i < kCorners; ++i) {
            const float angle = 2 * kPi * static_cast<float>(i) / kCorners;
            const float x = outer * std::cos(angle), y = outer * std::sin(angle);
            mesh.positions[0].push_back(center_ + a_ * x + b_ * y);
            mesh.uvs.push_back({0.5F + 0.5F * x, 0.5F + 0.5F * y});
            bounds_.box.grow(mesh.positions[0].back());
        }
        for (std::uint32_t i = 1; i + 1 < kCorners; ++i) {
            for (const std::uint32_t corner : {0U, flip ? i + 1 : i, flip ? i : i + 1})
                mesh.indices.push_back(corner);
            mesh.face.push_back(0);
        }
        mesh.uv_indices = mesh.corner = mesh.indices;
        geometry_.data = std::move(mesh);
    }

    Vec3f center_, a_, b_, normal_;
    Vec3f dual_a_, dual_b_;
    Frame across_;  ///< z along the normal
    float area_;
    Emission radiance_;
    Spread spread_;
    ShapeGeometry geometry_;
    LightBounds bounds_;
};

NodeType DiskLight::describe() {
    Describe<DiskLight> d("disk_light", NodeKind::Light,
                          "A flat disc that shines on one side with radiance I / area, or I "
                          "without normalize; I = color * intensity * 2^exposure.");
    d.param("position", &DiskLight::position, "Centre, in light space.");
    d.param("direction", &DiskLight::direction,
            "Direction in which the disc shines, in light space.");
    d.param("radius", &DiskLight::radius, "Radius; the matrix scales it.")
        .unit("scene units")
        .hard_range(0, kInfinity);
    d.param("spread", &DiskLight::spread,
            "1: light leaves to all sides; less: focused along the normal, up to spread * 90 "
            "degrees from it. The light's power stays the same.")
        .hard_range(0, 1);
    describe_light_common(d);
    return d.done();
}

std::unique_ptr<Light> DiskLight::make_light(NodeContext& context) const {
    const std::optional<Emission> emission = make_emission(*this, context);
    const std::optional<Mat4f> placement = world_from_light(*this, context);
    const std::optional<Vec3f> local_center = finite_value(position, kOrigin, "position", context);
    const std::optional<Vec3f> local_direction =
        finite_value(direction, kDirection, "direction", context);
    const std::optional<float> local_radius = finite_value(radius, kRadius, "radius", context);
    if (!emission || !placement || !local_center || !local_direction || !local_radius)
        return nullptr;
    const Frame frame = Frame::from_z(lightsieve::normalize(*local_direction, kDirection));
    const float r = std::max(0.0F, *local_radius);
    const Vec3f center = placement->point(*local_center), a = placement->vector(frame.x * r),
                b = placement->vector(frame.y * r);
    const Vec3f up = cross(a, b) * (placement->determinant3() < 0 ? -1.0F : 1.0F);
    const float area = kPi * length(up);
    if (!(area > kMinLightArea) || !std::isfinite(area) || !is_finite(center)) {
        warn_no_area(context, "radius");
        return std::make_unique<DarkLight>();
    }
    return std::make_unique<DiskSource>(center, a, b, lightsieve::normalize(up), area,
                                        emission->scaled(normalize ? 1 / area : 1),
                                        Spread(spread));
}

}  // namespace

NodeType node_disk_light() { return DiskLight::describe(); }

}  // namespace lightsieve
