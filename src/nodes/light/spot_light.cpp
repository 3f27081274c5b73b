// spot_light: a point or sphere whose light is confined to a cone.
//
// The beam's cross-section in the tangent plane is a superellipse with exponent 2 / roundness, and the penumbra a
// smoothstep in its norm between the tangents of the inner and the outer half angle. Both were fitted to one of
// Arnold's own pictures (cone 46.1, penumbra 8.05, roundness 0.35: root mean square error 0.003 of the centre's
// brightness, the noise of 8 bits) and are the light of Barzel 1997, "Lighting Controls for Computer Cinematography".
// Brightness goes by the direction from the centre, also with a radius: a sphere softens shadows, not the beam's edge.
#include "nodes/light/light_common.h"
#include "nodes/light/sphere_sampling.h"
#include "nodes/light/superellipse.h"

namespace lightsieve {
namespace {

constexpr Vec3f kOrigin{0, 0, 0}, kLookAt{0, 0, -1}, kUp{0, 1, 0};
constexpr float kNoRadius = 0;
/// Half angles end here, where tangents are still tame [deg].
constexpr float kMaxHalfAngle = 89.9F;

struct SpotLight : LightCommon {
    Array<Vec3f> position{&kOrigin, 1, 1}, look_at{&kLookAt, 1, 1},
        up{&kUp, 1, 1};                     ///< in light space
    Array<float> radius{&kNoRadius, 1, 1};  ///< in light space; 0: a true point
    float lens_radius = 0;
    float cone_angle = 65, penumbra_angle = 0, cosine_power = 0, aspect_ratio = 1, roundness = 1;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Light> make_light(NodeContext& context) const;
};

/// How bright the beam is in a direction, 1 on the axis.
class Beam {
  public:
    Beam() = default;
    Beam(const SpotLight& p, Vec3f axis, Vec3f x)
        : frame_(Frame::from_z_x(axis, x)),
          outline_(p.roundness),
          cosine_power_(std::max(0.0F, p.cosine_power)) {
        const float half = std::clamp(p.cone_angle * 0.5F, 0.0F, kMaxHalfAngle);
        outer_ = std::tan(deg_to_rad(half));
        inner_ = std::tan(deg_to_rad(std::clamp(half - p.penumbra_angle, 0.0F, half)));
        stretch_y_ = p.aspect_ratio;
    }

    /// away  from the beam's apex, any length
    [[nodiscard]] float at(Vec3f away) const {
        const Vec3f v = frame_.local_from_world(away);
        if (!(v.z > 0)) return 0;
        const float distance =
            outline_.norm(std::abs(v.x / v.z), std::abs(v.y / v.z) * stretch_y_);
        if (!(distance < outer_)) return 0;
        float out = 1;
        if (distance > inner_) {
            const float t = (outer_ - distance) / (outer_ - inner_);
            out = t * t * (3 - 2 * t);
        }
        return cosine_power_ == 0 ? out : out * std::pow(v.z / length(v), cosine_power_);
    }
    [[nodiscard]] Vec3f axis() const { return frame_.z; }
    [[nodiscard]] float outer_tangent() const { return outer_; }
    /// Cosine of a half angle that holds the whole beam, corners and all.
    [[nodiscard]] float cos_around() const {
        const float x = outer_, y = outer_ / stretch_y_;
        const float tangent = outline_.is_disc() ? std::max(x, y) : std::sqrt(x * x + y * y);
        return 1 / std::sqrt(1 + tangent * tangent);
    }

  private:
    Frame frame_;  ///< z along the axis
    float outer_ = 0,
          inner_ = 0;      ///< tangents of the half angles of the cone and of its fully lit part
    float stretch_y_ = 1;  ///< width / height
    Superellipse outline_;
    float cosine_power_ = 0;
};

class SpotSource final : public Light {
  public:
    /// radius    0: a true point; emission: intensity of a point, radiance of a sphere
    /// setback   how far the beam's apex lies behind the lens
    SpotSource(Vec3f position, float radius, float setback, const Beam& beam,
               const Emission& emission)
        : position_(position),
          apex_(position - beam.axis() * setback),
          radius_(radius),
          setback_(setback),
          beam_(beam),
          emission_(emission) {
        const Vec3f reach{radius, radius, radius};
        bounds_.box.grow(position - reach);
        bounds_.box.grow(position + reach);
        bounds_.axis = beam.axis();
        bounds_.cos_spread = 1;
        // Seen from the lens a set back beam opens to all of the half space.
        bounds_.cos_emission = setback > 0 ? 0 : beam.cos_around();
        bounds_.intensity = beam.outer_tangent() > 0
                                ? emission.magnitude() * (radius > 0 ? kPi * radius * radius : 1)
                                : 0;
        if (radius > 0) geometry_.data = SphereList{{{position}}, {radius}};
    }

    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        const float beam = shape(from);
        if (!(beam > 0)) return {};
        return radius_ > 0 ? sample_ball(from, u, beam) : sample_point(from, beam);
    }
    [[nodiscard]] LightEval hit(Vec3f from, const LightHit& hit) const override {
        const float beam = shape(from);
        const float pdf = radius_ > 0 && beam > 0 && from_outside(from, hit)
                              ? sphere_pdf(position_, radius_, from)
                              : 0;
        return pdf > 0 ? LightEval{emitted(from) * beam, pdf} : LightEval{};
    }
    [[nodiscard]] const ShapeGeometry* geometry() const override {
        return radius_ > 0 ? &geometry_ : nullptr;
    }
    [[nodiscard]] LightBounds bounds() const override { return bounds_; }

  private:
    /// Brightness toward a point, as a factor on the light of a sphere or point at `position`.
    [[nodiscard]] float shape(Vec3f from) const {
        const Vec3f away = from - apex_;
        if (setback_ > 0 && !(dot(from - position_, beam_.axis()) > 0)) return 0;
        const float beam = beam_.at(away);
        // The apex, not the lens, is where the light spreads from.
        if (setback_ > 0 && radius_ > 0)
            return beam * (length_squared(from - position_) / length_squared(away));
        return beam;
    }
    [[nodiscard]] Color emitted(Vec3f from) const { return emission_.toward(from - position_); }

    [[nodiscard]] LightSample sample_point(Vec3f from, float beam) const {
        const Vec3f toward = apex_ - from;
        const float d = length(toward);
        const Color irradiance = emitted(from) * (beam / (d * d));
        if (!(d > 0) || !is_finite(irradiance)) return {};
        // A shadow ray ends at the lens.
        const float depth = dot(from - apex_, beam_.axis());
        return {toward / d, d * ((depth - setback_) / depth), irradiance, 1, true};
    }
    [[nodiscard]] LightSample sample_ball(Vec3f from, Vec2f u, float beam) const {
        const SphereDirection s = sample_sphere(position_, radius_, from, u);
        if (!(s.pdf > 0)) return {};
        return {s.wi, s.distance, emitted(from) * beam, s.pdf, false};
    }

    Vec3f position_, apex_;
    float radius_, setback_;
    Beam beam_;
    Emission emission_;
    ShapeGeometry geometry_;
    LightBounds bounds_;
};

NodeType SpotLight::describe() {
    Describe<SpotLight> d("spot_light", NodeKind::Light,
                          "A cone of light from a point or sphere; color * intensity * 2^exposure "
                          "is its radiant intensity on the axis.");
    d.param("position", &SpotLight::position, "Centre, in light space.");
    d.param("look_at", &SpotLight::look_at, "Point that the light shines at, in light space.");
    d.param("up", &SpotLight::up, "Direction that points up in the beam, in light space.");
    d.param("radius", &SpotLight::radius,
            "Radius of a shining sphere with radiance I / (pi radius^2), or I without normalize: "
            "softer shadows; 0: a true point.")
        .unit("scene units")
        .hard_range(0, kInfinity);
    d.param("lens_radius", &SpotLight::lens_radius,
            "Radius of a lens that cuts off the cone: the light spreads from behind it.")
        .unit("scene units")
        .hard_range(0, kInfinity);
    d.param("cone_angle", &SpotLight::cone_angle, "Full angle of the cone.")
        .unit("deg")
        .hard_range(0, 180);
    d.param("penumbra_angle", &SpotLight::penumbra_angle,
            "Width of the soft edge, inside the cone.")
        .unit("deg")
        .range(0, 90);
    d.param("cosine_power", &SpotLight::cosine_power,
            "The light falls off as this power of the cosine to the axis.")
        .range(0, 20);
    d.param("aspect_ratio", &SpotLight::aspect_ratio,
            "Width of the beam over its height; the width has the cone's angle.")
        .range(0.1F, 10);
    d.param("roundness", &SpotLight::roundness, "1: an elliptical beam; 0: a rectangular one.")
        .hard_range(0, 1);
    describe_light_common(d);
    return d.done();
}

std::unique_ptr<Light> SpotLight::make_light(NodeContext& context) const {
    const std::optional<Emission> emission = make_emission(*this, context);
    const std::optional<Mat4f> placement = world_from_light(*this, context);
    const std::optional<Vec3f> eye = finite_value(position, kOrigin, "position", context);
    const std::optional<Vec3f> target = finite_value(look_at, kLookAt, "look_at", context);
    const std::optional<Vec3f> upward = finite_value(up, kUp, "up", context);
    const std::optional<float> size = finite_value(radius, kNoRadius, "radius", context);
    bool good = emission && placement && eye && target && upward && size;
    for (const auto& [value, name] : {std::pair{&lens_radius, "lens_radius"},
                                      {&cone_angle, "cone_angle"},
                                      {&penumbra_angle, "penumbra_angle"},
                                      {&cosine_power, "cosine_power"},
                                      {&aspect_ratio, "aspect_ratio"},
                                      {&roundness, "roundness"}})
        good = finite_value({value, 1, 1}, 0, name, context) && good;
    if (good && !(aspect_ratio > 0)) {
        context.diagnostics().error(
            Code::InvalidValue,
            "the aspect ratio of spot light \"" + context.node_name().str() + "\" is not above 0",
            context.where("aspect_ratio"), "write a value above 0");
        good = false;
    }
    if (!good) return nullptr;

    const Mat4f placed = Mat4f::look_at(*eye, *target, *upward) * *placement;
    const Vec3f center = placed.point({}), axis = placed.vector({0, 0, -1}),
                x = placed.vector({1, 0, 0});
    if (!is_finite(center) || !(length_squared(axis) > 0) || !is_finite(axis)) {
        context.diagnostics().error(
            Code::InvalidValue,
            "spot light \"" + context.node_name().str() + "\" has no direction",
            context.where("matrix"), "write a matrix that keeps local -Z");
        return nullptr;
    }
    const Beam beam(*this, lightsieve::normalize(axis), x);
    const float scale = mean_scale(*placement), world_radius = std::max(0.0F, *size) * scale;
    const float area = kPi * world_radius * world_radius;
    const bool sphere = area > kMinLightArea && std::isfinite(area);
    const float setback = lens_radius > 0 && beam.outer_tangent() > 0
                              ? lens_radius * scale / beam.outer_tangent()
                              : 0;
    return std::make_unique<SpotSource>(center, sphere ? world_radius : 0,
                                        std::isfinite(setback) ? setback : 0, beam,
                                        emission->scaled(sphere && normalize ? 1 / area : 1));
}

}  // namespace

NodeType node_spot_light() { return SpotLight::describe(); }

}  // namespace lightsieve
