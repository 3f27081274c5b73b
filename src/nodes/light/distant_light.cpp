// distant_light: parallel light, or light from a disc of the sky (the sun).
#include "core/sampling.h"
#include "nodes/light/light_common.h"

namespace lightsieve {
namespace {

constexpr Vec3f kDirection{0, 0, -1};
/// Cones narrower than this are treated as parallel light [rad].
constexpr float kMinHalfAngle = 1e-5F;

struct DistantLight : LightCommon {
    Array<Vec3f> direction{&kDirection, 1, 1};  ///< in light space
    float angle = 0;                            ///< full angle of the cone [deg]

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Light> make_light(NodeContext& context) const;
};

class DistantSource final : public Light {
  public:
    /// travel      unit, in which the light goes
    /// irradiance  what `emission` means: of a facing plane with `normalize`, otherwise radiance
    DistantSource(Vec3f travel, float half_angle, const Emission& emission, bool normalized)
        : travel_(travel) {
        delta_ = half_angle < kMinHalfAngle;
        const float half_sine = std::sin(half_angle * 0.5F);
        one_minus_cos_ = 2 * half_sine * half_sine;
        // The projected solid angle of a cone is pi sin^2: that much irradiance has radiance 1 on a facing plane.
        const float projected = kPi * square(std::sin(half_angle));
        if (!delta_) radiance_scale_ = normalized ? 1 / projected : 1;
        irradiance_ = emission.magnitude() * (delta_ ? 1 : radiance_scale_ * projected);
        emission_ = emission;
    }

    [[nodiscard]] LightSample sample(Vec3f, Vec2f u) const override {
        if (delta_) return {-travel_, kInfinity, emission_.toward(-travel_), 1, true};
        const Vec3f wi =
            Frame::from_z(-travel_).world_from_local(sample_uniform_cone(u, one_minus_cos_));
        return {wi, kInfinity, emission_.toward(wi) * radiance_scale_, pdf(), false};
    }

    [[nodiscard]] LightEval escape(Vec3f, Vec3f direction) const override {
        if (delta_) return {};
        // 2 - 2 cos without cancellation, and a little room for the rounding of sampled directions at the rim.
        const float from_axis = 0.5F * length_squared(direction + travel_);
        if (from_axis > one_minus_cos_ * (1 + 1e-6F)) return {};
        return {emission_.toward(direction) * radiance_scale_, pdf()};
    }

    [[nodiscard]] bool infinite() const override { return true; }
    [[nodiscard]] LightBounds bounds() const override {
        LightBounds out;
        out.axis = travel_;
        out.cos_spread = 1 - one_minus_cos_;
        return out;
    }
    [[nodiscard]] float irradiance() const override { return irradiance_; }

  private:
    [[nodiscard]] float pdf() const { return 1 / (2 * kPi * one_minus_cos_); }
    Vec3f travel_;
    Emission emission_;
    float one_minus_cos_ = 0;   ///< of the half angle
    float radiance_scale_ = 1;  ///< radiance for an emission of 1
    float irradiance_ = 0;
    bool delta_ = true;
};

NodeType DistantLight::describe() {
    Describe<DistantLight> d("distant_light", NodeKind::Light,
                             "Parallel light from infinitely far away; color * intensity * "
                             "2^exposure is the irradiance of a facing plane.");
    d.param("direction", &DistantLight::direction,
            "Direction in which the light goes, in light space.");
    d.param("angle", &DistantLight::angle,
            "Full angle of the cone that the light fills evenly; without normalize the colour is "
            "its radiance.")
        .unit("deg")
        .hard_range(0, 180);
    describe_light_common(d);
    return d.done();
}

std::unique_ptr<Light> DistantLight::make_light(NodeContext& context) const {
    const std::optional<Emission> emission = make_emission(*this, context);
    const std::optional<Mat4f> placement = world_from_light(*this, context);
    const std::optional<Vec3f> local = finite_value(direction, kDirection, "direction", context);
    const std::optional<float> full = finite_value({&angle, 1, 1}, 0, "angle", context);
    if (!emission || !placement || !local || !full) return nullptr;
    const Vec3f travel = placement->vector(*local);
    if (!(length_squared(travel) > 0) || !is_finite(travel)) {
        context.diagnostics().error(
            Code::InvalidValue,
            "distant light \"" + context.node_name().str() + "\" has no direction",
            context.where(placement->vector(kDirection) == Vec3f{} ? "matrix" : "direction"),
            "write a direction that is not zero and a matrix that keeps it");
        return nullptr;
    }
    // Scaled by hand first: the length of huge or tiny directions would overflow.
    const float largest =
        std::max(std::abs(travel.x), std::max(std::abs(travel.y), std::abs(travel.z)));
    return std::make_unique<DistantSource>(lightsieve::normalize(travel * (1 / largest)),
                                           deg_to_rad(std::clamp(*full, 0.0F, 180.0F)) * 0.5F,
                                           *emission, normalize);
}

}  // namespace

NodeType node_distant_light() { return DistantLight::describe(); }

}  // namespace lightsieve
