// photometric_light: a point or sphere that is as bright to each side as an IES file says.
//
// The file's candela times color * intensity * 2^exposure is the radiant intensity, as for a point light. The beam (vertical
// angle 0) is local -Z, as with every light that points somewhere; horizontal angle 0 is local +X, 90 local +Y. That the
// candela are not normalised and where the axes lie is not documented by Arnold. Brightness goes by the direction from
// the centre, also with a radius, as for a spot light.
#include "io/photometry.h"
#include "nodes/light/light_common.h"
#include "nodes/light/sphere_sampling.h"

namespace lightsieve {
namespace {

struct PhotometricLight : LightCommon {
    Name filename;
    float radius = 0;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Light> make_light(NodeContext& context) const;
};

class PhotometricSource final : public Light {
  public:
    /// axes     light space in the world; radius: 0 is a true point
    /// emission for 1 candela: intensity of a point, radiance of a sphere
    PhotometricSource(Vec3f position, float radius, const Frame& axes, Photometry photometry,
                      const Emission& emission)
        : position_(position),
          radius_(radius),
          axes_(axes),
          photometry_(std::move(photometry)),
          emission_(emission) {
        const Vec3f reach{radius, radius, radius};
        bounds_.box.grow(position - reach);
        bounds_.box.grow(position + reach);
        bounds_.intensity =
            emission.magnitude() * photometry_.peak() * (radius > 0 ? kPi * radius * radius : 1);
        if (radius > 0) geometry_.data = SphereList{{{position}}, {radius}};
    }

    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        if (radius_ > 0) {
            const SphereDirection s = sample_sphere(position_, radius_, from, u);
            if (!(s.pdf > 0)) return {};
            return {s.wi, s.distance, emitted(from), s.pdf, false};
        }
        const Vec3f toward = position_ - from;
        const float distance = length(toward);
        const Color irradiance = emitted(from) * (1 / (distance * distance));
        if (!(distance > 0) || !is_finite(irradiance)) return {};
        return {toward / distance, distance, irradiance, 1, true};
    }
    [[nodiscard]] LightEval hit(Vec3f from, const LightHit& hit) const override {
        const float pdf =
            radius_ > 0 && from_outside(from, hit) ? sphere_pdf(position_, radius_, from) : 0;
        return pdf > 0 ? LightEval{emitted(from), pdf} : LightEval{};
    }
    [[nodiscard]] const ShapeGeometry* geometry() const override {
        return radius_ > 0 ? &geometry_ : nullptr;
    }
    [[nodiscard]] LightBounds bounds() const override { return bounds_; }

  private:
    [[nodiscard]] Color emitted(Vec3f to) const {
        const Vec3f away = lightsieve::normalize(to - position_);
        const Vec3f d = axes_.local_from_world(away);
        return emission_.toward(-away) * photometry_.candela({d.x, d.y, -d.z});
    }

    Vec3f position_;
    float radius_;
    Frame axes_;
    Photometry photometry_;
    Emission emission_;
    ShapeGeometry geometry_;
    LightBounds bounds_;
};

NodeType PhotometricLight::describe() {
    Describe<PhotometricLight> d("photometric_light", NodeKind::Light,
                                 "A luminaire that is as bright to each side as an IES file says; "
                                 "its candela times color * intensity * 2^exposure is the "
                                 "radiant intensity.");
    d.param("filename", &PhotometricLight::filename,
            "IES file (LM-63); its vertical angle 0 is local -Z.");
    d.param("radius", &PhotometricLight::radius,
            "Radius of a shining sphere: softer shadows; 0: a point.")
        .unit("scene units")
        .hard_range(0, kInfinity);
    describe_light_common(d);
    return d.done();
}

/// The file; nothing with a warning where it cannot be used, for the rest of the scene can be rendered.
std::optional<Photometry> load(Name filename, NodeContext& context) {
    try {
        const std::optional<std::string> path = context.find_asset(filename.view());
        return read_photometry(path.value_or(filename.str()));
    } catch (const InputError& e) {
        for (Error error : e.errors()) {
            error.where = context.where("filename");
            error.severity = Severity::Warning;
            error.message += "; the light is left out";
            context.diagnostics().add(error);
        }
        return std::nullopt;
    }
}

std::unique_ptr<Light> PhotometricLight::make_light(NodeContext& context) const {
    const std::optional<Emission> emission = make_emission(*this, context);
    const std::optional<Mat4f> placement = world_from_light(*this, context);
    if (!emission || !placement) return nullptr;
    std::optional<Photometry> photometry = load(filename, context);
    if (!photometry) return std::make_unique<DarkLight>();
    const Vec3f position = placement->point({0, 0, 0});
    const std::optional<Frame> axes = light_axes(*placement);
    if (!axes || !is_finite(position)) {
        context.diagnostics().warning(
            Code::InvalidValue,
            "photometric light \"" + context.node_name().str() + "\" has no direction",
            context.where("matrix"), "its matrix is singular: check its scale");
        return std::make_unique<DarkLight>();
    }
    const float size = std::isfinite(radius) ? std::max(0.0F, radius) : 0;
    const float world_radius = size * mean_scale(*placement);
    const float area = kPi * world_radius * world_radius;
    if (!(area > kMinLightArea) || !std::isfinite(area))
        return std::make_unique<PhotometricSource>(position, 0.0F, *axes, std::move(*photometry),
                                                   *emission);
    return std::make_unique<PhotometricSource>(position, world_radius, *axes,
                                               std::move(*photometry),
                                               emission->scaled(normalize ? 1 / area : 1));
}

}  // namespace

NodeType node_photometric_light() { return PhotometricLight::describe(); }

}  // namespace lightsieve
