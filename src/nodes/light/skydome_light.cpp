// skydome_light: light from all around, of one colour or from a picture of the surroundings.
//
// An even dome is sampled by the cosine to the surface that asks. A linked colour is cut at its mean: what is above is
// sampled by a table of its brightness (sky_table.h), made once by evaluating the shader, what is below as an even dome;
// so surfaces do not look for the sky below their horizon. With portals (portals.h) directions are drawn through them,
// too. Seen by the camera a skydome is background (B), not light (L).
#include "core/sampling.h"
#include "nodes/light/dome_format.h"
#include "nodes/light/light_common.h"
#include "nodes/light/portals.h"
#include "nodes/light/sky_table.h"

namespace lightsieve {
namespace {

/// Table sizes, in cells around the horizon.
constexpr std::int32_t kMinResolution = 16, kMaxResolution = 8192;

enum class PortalMode : std::int32_t { Off, InteriorOnly, InteriorExterior };

struct SkydomeLight : LightCommon {
    SkydomeLight() { camera = transmission = 1; }
    std::int32_t resolution = 1000;
    DomeFormat format = DomeFormat::LatLong;
    PortalMode portal_mode = PortalMode::InteriorOnly;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Light> make_light(NodeContext& context) const;
};

class DomeSource final : public Light {
  public:
    DomeSource(const Frame& world_from_light, const Emission& emission, DomeFormat format,
               std::int32_t resolution, PortalMode portal_mode)
        : axes_(world_from_light),
          emission_(emission),
          format_(format),
          portal_mode_(portal_mode) {
        if (emission.is_constant()) {
            irradiance_ = kPi * emission.magnitude();
            return;
        }
        const auto width =
            static_cast<std::size_t>(std::clamp(resolution, kMinResolution, kMaxResolution));
        table_ = SkyTable(width, [&](Vec3f local, float footprint) {
            const Color c = emission_.toward(axes_.world_from_local(local),
                                             dome_uv(format_, local), footprint);
            const float value = Emission::magnitude(c);
            return std::isfinite(value) ? value : 0;
        });
        irradiance_ = std::max(table_.irradiance(), kPi * emission_.least_magnitude());
    }

    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        return sample_facing(from, {}, u);
    }
    [[nodiscard]] LightSample sample_facing(Vec3f from, Vec3f normal, Vec2f u) const override {
        if (portals_.empty()) {
            const Vec3f wi = sample_dome(normal, u);
            const LightEval eval = from_dome(normal, wi);
            return {wi, kInfinity, eval.radiance, eval.pdf, false};
        }
        const float through = portal_share(from);
        const bool by_portal = u.x < through;
        u.x = std::min(by_portal ? u.x / through : (u.x - through) / (1 - through),
                       kOneMinusEpsilon);
        const std::optional<Vec3f> wi =
            by_portal ? portals_.sample(from, u) : sample_dome(normal, u);
        if (!wi) return {};
        const LightEval eval = escape_facing(from, normal, *wi);
        return {*wi, kInfinity, eval.radiance, eval.pdf, false};
    }
    [[nodiscard]] LightEval escape(Vec3f from, Vec3f wi) const override {
        return escape_facing(from, {}, wi);
    }
    [[nodiscard]] LightEval escape_facing(Vec3f from, Vec3f normal, Vec3f wi) const override {
        if (portals_.empty()) return from_dome(normal, wi);
        const float by_portals = portals_.pdf(from, wi);
        if (!(by_portals > 0) && portal_mode_ == PortalMode::InteriorOnly) return {};
        LightEval out = from_dome(normal, wi);
        out.pdf = lerp(out.pdf, by_portals, portal_share(from));
        return out;
    }
    [[nodiscard]] LightEval seen(Vec3f, Vec3f wi) const override { return from_dome({}, wi); }
    void set_portals(std::span<const Light* const> portals) override {
        if (portal_mode_ != PortalMode::Off) portals_ = Portals(portals);
    }
    [[nodiscard]] bool infinite() const override { return true; }
    [[nodiscard]] bool is_skydome() const override { return true; }
    [[nodiscard]] LightBounds bounds() const override { return {}; }
    [[nodiscard]] float irradiance() const override { return irradiance_; }

  private:
    /// How many of the samples go through portals: all where nothing else is lit and the sky is even; half where the sky
    /// is a picture, of which a small sun is not found through a window by chance, or shines beside the portals, too.
    [[nodiscard]] float portal_share(Vec3f from) const {
        if (!portals_.seen_from(from)) return portal_mode_ == PortalMode::InteriorOnly ? 1 : 0;
        return portal_mode_ == PortalMode::InteriorOnly && table_.empty() ? 1 : 0.5F;
    }

    /// Part of the samples of a surface that are drawn as from an even dome.
    [[nodiscard]] float even_part() const {
        // A surface may not see the bright parts at all.
        constexpr float kLeast = 0.1F;
        return table_.empty() ? 1 : std::max(kLeast, table_.even_share());
    }
    [[nodiscard]] Vec3f sample_dome(Vec3f normal, Vec2f u) const {
        if (normal == Vec3f{})
            return table_.empty() ? sample_uniform_sphere(u)
                                  : axes_.world_from_local(table_.sample(SkyTable::Part::All, u));
        const float even = even_part();
        if (u.x < even)
            return Frame::from_z(normal).world_from_local(
                sample_cosine_hemisphere({std::min(u.x / even, kOneMinusEpsilon), u.y}));
        u.x = std::min((u.x - even) / (1 - even), kOneMinusEpsilon);
        return axes_.world_from_local(table_.sample(SkyTable::Part::AboveMean, u));
    }
    /// Radiance from a direction, and the density with which sample_dome would have chosen it.
    [[nodiscard]] LightEval from_dome(Vec3f normal, Vec3f wi) const {
        const bool faces = !(normal == Vec3f{});
        const float cosine = faces ? kInvPi * std::max(0.0F, dot(normal, wi)) : kInvPi / 4;
        if (table_.empty()) return {emission_.toward(wi), cosine};
        const Vec3f local = axes_.local_from_world(wi);
        const float pdf =
            faces ? lerp(table_.pdf(SkyTable::Part::AboveMean, local), cosine, even_part())
                  : table_.pdf(SkyTable::Part::All, local);
        return {emission_.toward(wi, dome_uv(format_, local)), pdf};
    }

    Frame axes_;  ///< light space in the world
    Emission emission_;
    DomeFormat format_;
    PortalMode portal_mode_;
    Portals portals_;
    SkyTable table_;  ///< empty: an even dome
    float irradiance_ = 0;
};

NodeType SkydomeLight::describe() {
    Describe<SkydomeLight> d(
        "skydome_light", NodeKind::Light,
        "Light from all around with radiance color * intensity * 2^exposure.");
    d.param("resolution", &SkydomeLight::resolution,
            "Cells around the horizon of the table from which a linked colour is sampled.")
        .range(kMinResolution, kMaxResolution);
    d.param("format", &SkydomeLight::format, "Layout of a linked colour's texture coordinates.")
        .names({"mirrored_ball", "angular", "latlong"});
    d.param("portal_mode", &SkydomeLight::portal_mode,
            "What quad lights with `portal` on are to the dome. off: nothing; interior_only: its "
            "light comes in through them alone (the camera sees it all the same); "
            "interior_exterior: its light comes from everywhere, and they help to find it.")
        .names({"off", "interior_only", "interior_exterior"});
    d.param("aov_indirect", &LightCommon::aov_indirect,
            "The light counts as background (B) in light path expressions, not as light (L).");
    describe_light_common(d);
    return d.done();
}

std::unique_ptr<Light> SkydomeLight::make_light(NodeContext& context) const {
    const std::optional<Emission> emission = make_emission(*this, context);
    const std::optional<Mat4f> placement = world_from_light(*this, context);
    if (!emission || !placement) return nullptr;
    std::optional<Frame> axes = light_axes(*placement);
    if (!axes) {
        context.diagnostics().warning(
            Code::InvalidValue,
            "the matrix of skydome \"" + context.node_name().str() + "\" is singular",
            context.where("matrix"), "the dome is not rotated");
        axes = Frame{};
    }
    return std::make_unique<DomeSource>(*axes, *emission, format, resolution, portal_mode);
}

}  // namespace

NodeType node_skydome_light() { return SkydomeLight::describe(); }

}  // namespace lightsieve
