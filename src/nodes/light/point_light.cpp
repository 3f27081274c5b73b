// point_light: a point, or a sphere that shines outward.
#include "nodes/light/light_common.h"
#include "nodes/light/sphere_sampling.h"

namespace lightsieve {
namespace {

constexpr Vec3f kOrigin{0, 0, 0};
constexpr float kNoRadius = 0;

struct PointLight : LightCommon {
    Array<Vec3f> position{&kOrigin, 1, 1};  ///< in light space
    Array<float> radius{&kNoRadius, 1, 1};  ///< in light space; 0: a true point

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Light> make_light(NodeContext& context) const;
};

/// A true point: E = I cos / r^2.
class PointSource final : public Light {
  public:
    PointSource(Vec3f position, const Emission& emission)
        : position_(position), emission_(emission) {
        bounds_.box.grow(position);
        bounds_.intensity = emission.magnitude();
    }
    [[nodiscard]] LightSample sample(Vec3f from, Vec2f) const override {
        const Vec3f toward = position_ - from;
        const float distance = length(toward), falloff = 1 / (distance * distance);
        const Color irradiance = emission_.at(position_, -(toward / distance), {}) * falloff;
        if (!std::isfinite(falloff) || !is_finite(irradiance)) return {};
        return {toward / distance, distance, irradiance, 1, true};
    }
    [[nodiscard]] LightBounds bounds() const override { return bounds_; }

  private:
    Vec3f position_;
    Emission emission_;
    LightBounds bounds_;
};

/// A sphere of even radiance.
class SphereSource final : public Light {
  public:
    SphereSource(Vec3f center, float radius, const Emission& radiance)
        : center_(center), radius_(radius), radiance_(radiance) {
        geometry_.data = SphereList{{{center}}, {radius}};
        bounds_.box.grow(center - Vec3f{radius, radius, radius});
        bounds_.box.grow(center + Vec3f{radius, radius, radius});
        bounds_.intensity = radiance.magnitude() * kPi * radius * radius;
    }
    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        const SphereDirection s = sample_sphere(center_, radius_, from, u);
        if (!(s.pdf > 0)) return {};
        return {s.wi, s.distance, emitted(from + s.wi * s.distance), s.pdf, false};
    }
    [[nodiscard]] LightEval hit(Vec3f from, const LightHit& at) const override {
        const float pdf = from_outside(from, at) ? sphere_pdf(center_, radius_, from) : 0;
        return pdf > 0 ? LightEval{emitted(at.position), pdf} : LightEval{};
    }
    [[nodiscard]] const ShapeGeometry* geometry() const override { return &geometry_; }
    [[nodiscard]] LightBounds bounds() const override { return bounds_; }

  private:
    [[nodiscard]] Color emitted(Vec3f on) const {
        return radiance_.is_constant() ? radiance_.at(on, {}, {})
                                       : radiance_.at(on, lightsieve::normalize(on - center_), {});
    }

    Vec3f center_;
    float radius_;
    Emission radiance_;
    ShapeGeometry geometry_;
    LightBounds bounds_;
};

NodeType PointLight::describe() {
    Describe<PointLight> d("point_light", NodeKind::Light,
                           "Light from a point to all sides (color * intensity * 2^exposure is "
                           "its radiant intensity), or from a sphere.");
    d.param("position", &PointLight::position, "Centre, in light space.");
    d.param("radius", &PointLight::radius,
            "Radius of a shining sphere with radiance I / (pi radius^2), or I without normalize; "
            "0: a true point.")
        .unit("scene units")
        .hard_range(0, kInfinity);
    describe_light_common(d);
    return d.done();
}

std::unique_ptr<Light> PointLight::make_light(NodeContext& context) const {
    const std::optional<Emission> emission = make_emission(*this, context);
    const std::optional<Mat4f> placement = world_from_light(*this, context);
    const std::optional<Vec3f> local = finite_value(position, kOrigin, "position", context);
    const std::optional<float> size = finite_value(radius, kNoRadius, "radius", context);
    if (!emission || !placement || !local || !size) return nullptr;
    const Vec3f center = placement->point(*local);
    if (!is_finite(center)) {
        context.diagnostics().error(
            Code::InvalidValue,
            "point light \"" + context.node_name().str() + "\" lies outside the range of numbers",
            context.where("position"), "move it nearer");
        return nullptr;
    }
    const float world_radius = std::max(0.0F, *size) * mean_scale(*placement);
    const float area = kPi * world_radius * world_radius;
    if (!(area > kMinLightArea) || !std::isfinite(area))
        return std::make_unique<PointSource>(center, *emission);
    return std::make_unique<SphereSource>(center, world_radius,
                                          emission->scaled(normalize ? 1 / area : 1));
}

}  // namespace

NodeType node_point_light() { return PointLight::describe(); }

}  // namespace lightsieve
