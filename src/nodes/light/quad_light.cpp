// quad_light: a flat quadrilateral that shines on one side.
#include "core/sampling.h"
#include "nodes/light/flat_profile.h"
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

/// Cells along a side of the table of a textured light.
constexpr std::int32_t kMinResolution = 16, kMaxResolution = 2048;

/// A rectangle, sampled by solid angle. Of one that is focused, the part from which light can come. One with a texture is
/// sampled half by its brightness, too.
class RectangleSource final : public Light {
  public:
    /// p  corners whose winding says which side shines: the one from which they run counter-clockwise
    /// resolution  of the table of a textured light
    RectangleSource(const std::array<Vec3f, 4>& p, const Emission& radiance,
                    const FlatProfile& profile, std::int32_t resolution)
        : rectangle_(p[0], p[1] - p[0], p[3] - p[0]), radiance_(radiance), profile_(profile) {
        geometry_.data = quad_mesh(p);
        for (const Vec3f corner : p)
            bounds_.box.grow(corner);
        bounds_.axis = rectangle_.normal();
        bounds_.cos_spread = 1;
        bounds_.cos_emission = profile.spread.cosine();
        bounds_.intensity = radiance.magnitude() * rectangle_.area() * profile.spread.peak();
        if (!radiance.is_constant() && profile.spread.is_wide())
            make_table(
                static_cast<std::size_t>(std::clamp(resolution, kMinResolution, kMaxResolution)));
    }

    // In one piece: small structs of floats are slow to hand from call to call.
    [[nodiscard, gnu::flatten]] LightSample sample(Vec3f from, Vec2f u) const override {
        if (profile_.spread.is_wide()) return sample_of(rectangle_, from, u);
        const std::optional<Part> part = lit_part(from);
        return part ? sample_of(part->rectangle, from, u) : LightSample{};
    }
    [[nodiscard, gnu::flatten]] LightEval hit(Vec3f from, const LightHit& at) const override {
        if (profile_.spread.is_wide())
            return eval_of(RectangleView(rectangle_, from), from, at.position, at.uv, at.uv);
        const std::optional<Part> part = lit_part(from);
        if (!part) return {};
        const Vec2f size = part->high - part->low;
        const Vec2f uv{(at.uv.x - part->low.x) / size.x, (at.uv.y - part->low.y) / size.y};
        if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) return {};
        return eval_of(RectangleView(part->rectangle, from), from, at.position, uv, at.uv);
    }
    [[nodiscard]] const ShapeGeometry* geometry() const override { return &geometry_; }
    [[nodiscard]] LightBounds bounds() const override { return bounds_; }

  private:
    /// A part of the rectangle, between two places along its edges.
    struct Part {
        Vec2f low, high;
        Rectangle rectangle;
    };

    /// The part that holds every point which shines at `from`: the square around the foot of the perpendicular whose
    /// half width is seen under the light's half angle.
    [[nodiscard]] std::optional<Part> lit_part(Vec3f from) const {
        const float height = dot(from - rectangle_.corner(), rectangle_.normal());
        if (!(height > 0)) return std::nullopt;
        const Vec2f foot = rectangle_.uv_of(from);
        const float reach = height * profile_.spread.tangent();
        const Vec2f half{reach / rectangle_.width(), reach / rectangle_.height()};
        const Vec2f low{std::max(0.0F, foot.x - half.x), std::max(0.0F, foot.y - half.y)},
            high{std::min(1.0F, foot.x + half.x), std::min(1.0F, foot.y + half.y)};
        if (!(low.x < high.x && low.y < high.y)) return std::nullopt;
        return Part{low, high, rectangle_.part(low, high)};
    }

    [[nodiscard]] LightSample sample_of(const Rectangle& rectangle, Vec3f from, Vec2f u) const {
        const RectangleView view(rectangle, from);
        if (!view.visible()) return {};
        const RectangleView::Sample s = sample_place(view, u);
        const Vec3f toward = s.position - from;
        const float distance = length(toward);
        const Vec2f uv = profile_.spread.is_wide() ? s.uv : rectangle_.uv_of(s.position);
        const LightEval eval = eval_of(view, from, s.position, s.uv, uv);
        if (!(eval.pdf > 0)) return {};
        return {toward / distance, distance, eval.radiance, eval.pdf, false};
    }
    /// part_uv  place on the rectangle of the view; uv: on the whole one
    [[nodiscard]] LightEval eval_of(const RectangleView& view, Vec3f from, Vec3f position,
                                    Vec2f part_uv, Vec2f uv) const {
        if (!view.visible()) return {};
        Color radiance = radiance_.at(position, rectangle_.normal(), uv);
        if (!profile_.is_plain()) {
            const float factor = profile_.at(rectangle_.normal(), from - position, uv);
            if (!(factor > 0)) return {};
            radiance *= factor;
        }
        const float pdf = view.pdf({position, part_uv});
        return {radiance, picture_ ? 0.5F * (pdf + picture_pdf(from, position, uv)) : pdf};
    }

    /// A place on the light: by its looks from there, or half of the time by its brightness.
    [[nodiscard]] RectangleView::Sample sample_place(const RectangleView& view, Vec2f u) const {
        if (!picture_) return view.sample(u);
        if (u.x < 0.5F) return view.sample({2 * u.x, u.y});
        const Vec2f uv = picture_->sample({2 * u.x - 1, u.y}).uv;
        return {rectangle_.corner() + rectangle_.axis_x() * (uv.x * rectangle_.width()) +
                    rectangle_.axis_y() * (uv.y * rectangle_.height()),
                uv};
    }
    /// Density of the places that are drawn by brightness, per solid angle.
    [[nodiscard]] float picture_pdf(Vec3f from, Vec3f position, Vec2f uv) const {
        const Vec3f back = from - position;
        const float r2 = length_squared(back), facing = dot(rectangle_.normal(), back);
        const float pdf = picture_->pdf(uv) / rectangle_.area() * (r2 * std::sqrt(r2) / facing);
        return facing > 0 && std::isfinite(pdf) ? pdf : 0;
    }
    void make_table(std::size_t n) {
        std::vector<float> cells(n * n);
        double sum = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const Vec2f uv{(static_cast<float>(i % n) + 0.5F) / static_cast<float>(n),
                           (static_cast<float>(i / n) + 0.5F) / static_cast<float>(n)};
            const Vec3f on = rectangle_.corner() +
                             rectangle_.axis_x() * (uv.x * rectangle_.width()) +
                             rectangle_.axis_y() * (uv.y * rectangle_.height());
            const float value = Emission::magnitude(radiance_.at(on, rectangle_.normal(), uv)) *
                                profile_.outline.at(uv);
            cells[i] = std::isfinite(value) ? value : 0;
            sum += static_cast<double>(cells[i]);
        }
        if (sum > 0) picture_.emplace(cells, n, n);
    }

    Rectangle rectangle_;
    Emission radiance_;
    FlatProfile profile_;
    std::optional<Distribution2D> picture_;  ///< brightness over the light, if it has a texture
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
            "Cells along a side of the table by which a textured light is sampled.")
        .range(kMinResolution, kMaxResolution);
    d.param("spread", &QuadLight::spread,
            "1: light leaves to all sides; less: focused along the normal, up to spread * 90 "
            "degrees from it. The light's power stays the same.")
        .hard_range(0, 1);
    d.param("roundness", &QuadLight::roundness,
            "Rounds the corners, up to an ellipse. What is left is as bright as before.")
        .hard_range(0, 1);
    d.param("soft_edge", &QuadLight::soft_edge,
            "Width of a smooth edge, as a part of the way from the outline to the middle.")
        .hard_range(0, 1);
    d.param("portal", &QuadLight::portal,
            "The quadrilateral is no light but an opening through which skydomes shine, to its "
            "lit side; see skydome_light.portal_mode.");
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
    // A portal's own light is only a measure of the directions through it.
    const Emission shown = portal ? Emission(ColorInput(kWhite), 1) : *emission;
    const FlatProfile profile =
        portal ? FlatProfile{} : FlatProfile{{roundness, soft_edge}, Spread(spread)};
    const bool by_area = normalize && !portal;
    auto triangles = std::make_unique<TriangleLight>(quad_mesh(p), shown, by_area, profile);
    if (!(triangles->area() > 0)) {
        warn_no_area(context, "vertices");
        return triangles;
    }
    if (!is_rectangle(p)) return triangles;
    return std::make_unique<RectangleSource>(p, shown.scaled(by_area ? 1 / triangles->area() : 1),
                                             profile, resolution);
}

}  // namespace

NodeType node_quad_light() { return QuadLight::describe(); }

}  // namespace lightsieve
