// skydome_light: light from all around, of one colour or from a picture of the surroundings.
//
// A linked colour is sampled from a table over latitude and longitude, made once by evaluating the shader. Cells are
// sampled evenly over their solid angle, and every cell keeps a share of the mean, so that no direction from which
// light may come has density 0. Seen by the camera a skydome is background (B), not light (L).
#include "core/parallel.h"
#include "core/sampling.h"
#include "nodes/light/dome_format.h"
#include "nodes/light/light_common.h"
#include "nodes/light/portals.h"

namespace lightsieve {
namespace {

/// Part of the mean brightness that is added to every cell of the table: details between its samples cost variance,
/// never light.
constexpr float kFloor = 0.02F;
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
        width_ = static_cast<std::size_t>(std::clamp(resolution, kMinResolution, kMaxResolution));
        height_ = width_ / 2;
        make_table();
    }

    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        if (portals_.empty()) return sample_dome(u);
        const float through = portal_share(from);
        const bool by_portal = u.x < through;
        u.x = std::min(by_portal ? u.x / through : (u.x - through) / (1 - through),
                       kOneMinusEpsilon);
        const std::optional<Vec3f> wi = by_portal ? portals_.sample(from, u) : sample_dome(u).wi;
        if (!wi) return {};
        const LightEval eval = escape(from, *wi);
        return {*wi, kInfinity, eval.radiance, eval.pdf, false};
    }
    [[nodiscard]] LightEval escape(Vec3f from, Vec3f wi) const override {
        if (portals_.empty()) return seen(from, wi);
        const float by_portals = portals_.pdf(from, wi);
        if (!(by_portals > 0) && portal_mode_ == PortalMode::InteriorOnly) return {};
        LightEval out = seen(from, wi);
        out.pdf = lerp(out.pdf, by_portals, portal_share(from));
        return out;
    }
    [[nodiscard]] LightEval seen(Vec3f, Vec3f wi) const override {
        if (height_ == 0) return {emission_.toward(wi), kInvPi / 4};
        const Vec2f uv = table_uv(axes_.local_from_world(wi));
        return {radiance(wi), table_.pdf(uv) * cells_per_solid_angle(uv)};
    }
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
        return portal_mode_ == PortalMode::InteriorOnly && height_ == 0 ? 1 : 0.5F;
    }

    [[nodiscard]] LightSample sample_dome(Vec2f u) const {
        if (height_ == 0) {
            const Vec3f wi = sample_uniform_sphere(u);
            return {wi, kInfinity, emission_.toward(wi), kInvPi / 4, false};
        }
        const Distribution2D::Sample s = table_.sample(u);
        const Vec3f wi = axes_.world_from_local(direction(s.uv));
        return {wi, kInfinity, radiance(wi), s.pdf * cells_per_solid_angle(s.uv), false};
    }
    [[nodiscard]] Color radiance(Vec3f wi) const {
        return emission_.toward(wi, dome_uv(format_, axes_.local_from_world(wi)));
    }

    /// The row of a table coordinate.
    [[nodiscard]] std::size_t row(float v) const {
        return std::min(static_cast<std::size_t>(std::max(0.0F, v) * static_cast<float>(height_)),
                        height_ - 1);
    }
    /// sin of the latitude at the lower edge of a row; row `height_` is the zenith.
    [[nodiscard]] double edge(std::size_t y) const {
        return -std::cos(static_cast<double>(kPi) * static_cast<double>(y) /
                         static_cast<double>(height_));
    }

    /// Table to light space: even in longitude, and within a row even in the sine of the latitude.
    [[nodiscard]] Vec3f direction(Vec2f uv) const {
        const std::size_t y = row(uv.y);
        const float inside = uv.y * static_cast<float>(height_) - static_cast<float>(y);
        const float sine = lerp(edges_[y], edges_[y + 1], inside);
        const float cosine = safe_sqrt(1 - sine * sine);
        const float longitude = 2 * kPi * uv.x;
        return {cosine * std::sin(longitude), sine, cosine * std::cos(longitude)};
    }
    [[nodiscard]] Vec2f table_uv(Vec3f d) const {
        const float sine = std::clamp(d.y, -1.0F, 1.0F);
        const float longitude = std::atan2(d.x, d.z) / (2 * kPi);
        // The row by angle, corrected where rounding puts it on the wrong side of an edge.
        std::size_t y = row(0.5F + std::asin(sine) * kInvPi);
        if (sine < edges_[y] && y > 0) --y;
        if (sine >= edges_[y + 1] && y + 1 < height_) ++y;
        return {longitude < 0 ? longitude + 1 : longitude,
                (static_cast<float>(y) + 0.5F) / static_cast<float>(height_)};
    }
    /// Density over the sphere for a density of 1 over the table.
    [[nodiscard]] float cells_per_solid_angle(Vec2f uv) const { return density_[row(uv.y)]; }

    void make_table() {
        edges_.resize(height_ + 1);
        density_.resize(height_);
        std::vector<double> solid_angle(height_);  // of one cell
        for (std::size_t y = 0; y <= height_; ++y)
            edges_[y] = static_cast<float>(edge(y));
        for (std::size_t y = 0; y < height_; ++y) {
            solid_angle[y] = 2 * static_cast<double>(kPi) / static_cast<double>(width_) *
                             (edge(y + 1) - edge(y));
            density_[y] = static_cast<float>(
                1 / (solid_angle[y] * static_cast<double>(width_) * static_cast<double>(height_)));
        }
        std::vector<float> cells(width_ * height_);
        parallel_for(height_, 0, [&](std::size_t y) {
            for (std::size_t x = 0; x < width_; ++x)
                cells[y * width_ + x] = cell_magnitude(x, y);
        });

        // Irradiance of planes that face along the axes; the mean brightness.
        std::array<double, 6> facing{};
        double mean = 0;
        for (std::size_t y = 0; y < height_; ++y)
            for (std::size_t x = 0; x < width_; ++x) {
                const double value = static_cast<double>(cells[y * width_ + x]) * solid_angle[y];
                const Vec3f d = direction(center(x, y));
                mean += value;
                for (int axis = 0; axis < 3; ++axis)
                    facing[static_cast<std::size_t>(2 * axis + (d[axis] > 0 ? 0 : 1))] +=
                        value * static_cast<double>(std::abs(d[axis]));
            }
        mean /= 4 * static_cast<double>(kPi);
        irradiance_ = static_cast<float>(*std::max_element(facing.begin(), facing.end()));
        for (std::size_t y = 0; y < height_; ++y)
            for (std::size_t x = 0; x < width_; ++x) {
                float& cell = cells[y * width_ + x];
                cell = static_cast<float>(
                    (static_cast<double>(cell) + static_cast<double>(kFloor) * mean) *
                    solid_angle[y]);
            }
        table_ = Distribution2D(cells, width_, height_);
        irradiance_ = std::max(irradiance_, kPi * emission_.least_magnitude());
    }

    /// Mean magnitude over a cell, from 2 x 2 points with textures filtered to their distance.
    [[nodiscard]] float cell_magnitude(std::size_t x, std::size_t y) const {
        float sum = 0;
        for (const float dx : {0.25F, 0.75F})
            for (const float dy : {0.25F, 0.75F}) {
                const Vec2f uv{(static_cast<float>(x) + dx) / static_cast<float>(width_),
                               (static_cast<float>(y) + dy) / static_cast<float>(height_)};
                const Vec3f local = direction(uv);
                const Color c =
                    emission_.toward(axes_.world_from_local(local), dome_uv(format_, local),
                                     0.5F / static_cast<float>(width_));
                const float value = Emission::magnitude(c);
                sum += std::isfinite(value) ? value : 0;
            }
        return sum * 0.25F;
    }
    [[nodiscard]] Vec2f center(std::size_t x, std::size_t y) const {
        return {(static_cast<float>(x) + 0.5F) / static_cast<float>(width_),
                (static_cast<float>(y) + 0.5F) / static_cast<float>(height_)};
    }

    Frame axes_;  ///< light space in the world
    Emission emission_;
    DomeFormat format_;
    PortalMode portal_mode_;
    Portals portals_;
    std::size_t width_ = 0, height_ = 0;  ///< of the table; 0: an even dome
    Distribution2D table_;
    std::vector<float> edges_;  ///< sine of the latitude at each row's lower edge, and 1
    std::vector<float>
        density_;  ///< of each row: density over the sphere for a density of 1 over the table
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
