// physical_sky: the clear sky with the sun, for skydomes and backgrounds.
//
// The model is that of nodes/common/sky_model.h; Arnold's own is not published. The shader looks at the direction, so a
// skydome's format does not matter to it. X, Y, Z are the axes in which the sun is placed: Y is up, azimuth 0 is toward X,
// 90 toward Z.
#include "nodes/common/sky_model.h"
#include "scene/describe.h"
#include "scene/node_context.h"
#include "scene/shade_point.h"

namespace lightsieve {
namespace {

struct PhysicalSky {
    float turbidity = 3;
    Color ground_albedo{0.1F, 0.1F, 0.1F};
    bool use_degrees = true;
    float elevation = 45, azimuth = 90;
    Vec3f sun_direction{0, 1, 0};
    bool enable_sun = true, enable_sky = true;
    float sun_size = 0.51F;
    Color sun_tint{1, 1, 1}, sky_tint{1, 1, 1};
    float intensity = 1;
    Vec3f X{1, 0, 0}, Y{0, 1, 0}, Z{0, 0, 1};
    const SkyModel* model = nullptr;  ///< made by prepare()

    static NodeType describe();
    void prepare(NodeContext& context);
    [[nodiscard]] Color eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] Vec3f toward_sun() const;
    [[nodiscard]] Color sun_disc(Vec3f local, float uv_width) const;
};

NodeType PhysicalSky::describe() {
    Describe<PhysicalSky> d("physical_sky", NodeKind::Shader,
                            "The clear sky with the sun, after Hosek and Wilkie. In its units a "
                            "white matt surface under 100 klx has radiance 1.");
    d.param("turbidity", &PhysicalSky::turbidity, "Haze: 1 clear to 10 hazy. Not linked.")
        .hard_range(1, 10);
    d.param("ground_albedo", &PhysicalSky::ground_albedo,
            "How much light the ground throws back to the sky. Not linked.")
        .range(0, 1);
    d.param("use_degrees", &PhysicalSky::use_degrees,
            "The sun is placed by elevation and azimuth; off: by sun_direction.");
    d.param("elevation", &PhysicalSky::elevation, "Of the sun over the horizon. Not linked.")
        .unit("deg")
        .range(-90, 90);
    d.param("azimuth", &PhysicalSky::azimuth, "Of the sun, from X toward Z. Not linked.")
        .unit("deg")
        .range(0, 360);
    d.param("sun_direction", &PhysicalSky::sun_direction,
            "Toward the sun, without use_degrees. Not linked.");
    d.param("enable_sun", &PhysicalSky::enable_sun, "The sun's disc is seen and gives light.");
    d.param("enable_sky", &PhysicalSky::enable_sky, "The sky is seen and gives light.");
    d.param("sun_size", &PhysicalSky::sun_size, "Diameter of the sun; its light stays the same.")
        .unit("deg")
        .range(0, 180);
    d.param("sun_tint", &PhysicalSky::sun_tint, "Factor on the sun.");
    d.param("sky_tint", &PhysicalSky::sky_tint, "Factor on the sky.");
    d.param("intensity", &PhysicalSky::intensity, "Factor on both.");
    d.param("X", &PhysicalSky::X, "Direction in the world of azimuth 0.");
    d.param("Y", &PhysicalSky::Y, "Direction in the world of the zenith.");
    d.param("Z", &PhysicalSky::Z, "Direction in the world of azimuth 90.");
    return d.done();
}

Vec3f PhysicalSky::toward_sun() const {
    if (!use_degrees) return normalize(sun_direction, {0, 1, 0});
    const float e = deg_to_rad(elevation), a = deg_to_rad(azimuth);
    return {std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a)};
}

void PhysicalSky::prepare(NodeContext& context) {
    for (const char* param :
         {"turbidity", "ground_albedo", "elevation", "azimuth", "sun_direction"})
        if (context.is_linked(param))
            context.diagnostics().warning(
                Code::ParamPending,
                std::string("\"") + param + "\" of a physical_sky cannot be linked",
                context.where(param), "the value that is written holds for the whole sky");
    Vec3f sun = toward_sun();
    if (!is_finite(sun)) {
        context.diagnostics().warning(
            Code::InvalidValue, "the sun of \"" + context.node_name().str() + "\" is nowhere",
            context.where(use_degrees ? "elevation" : "sun_direction"),
            "write finite numbers; it is put into the zenith");
        sun = {0, 1, 0};
    }
    const float air = std::isfinite(turbidity) ? turbidity : 3;
    const Color ground = is_finite(ground_albedo) ? ground_albedo : kBlack;
    const auto kept =
        std::make_shared<const SkyModel>(air, ground, sun, context.color_spaces().rendering());
    model = kept.get();
    context.keep(kept);
}

Color PhysicalSky::eval(const ShadePoint& at) const {
    if (model == nullptr) return kBlack;
    const Vec3f local = normalize(
        Vec3f{dot(at.direction, X), dot(at.direction, Y), dot(at.direction, Z)}, {0, 1, 0});
    Color out;
    if (enable_sky) out += model->sky(local) * sky_tint;
    if (enable_sun) out += sun_disc(local, at.uv_width) * sun_tint;
    return out * intensity;
}

/// The sun as an even disc that gives its irradiance; wider where it is asked for the mean over a footprint, so that a
/// table of the sky does not miss it between its points.
Color PhysicalSky::sun_disc(Vec3f local, float uv_width) const {
    // As small as floats can tell directions apart.
    constexpr float kMinRadius = 1e-3F;
    const float radius =
        std::max(deg_to_rad(sun_size) * 0.5F, kMinRadius) + std::max(0.0F, uv_width) * 2 * kPi;
    if (!(radius <= kPi / 2) || local.y < 0) return kBlack;
    // 1 - cos without cancellation.
    const float away = 0.5F * length_squared(local - model->toward_sun());
    const float half = std::sin(radius * 0.5F);
    if (!(away <= 2 * half * half)) return kBlack;
    return model->sun() * (kInvPi / square(std::sin(radius)));
}

}  // namespace

NodeType node_physical_sky() { return PhysicalSky::describe(); }

}  // namespace lightsieve
