// light_blocker: a region that a light does not reach, without any object.
#include "scene/describe.h"
#include "scene/light_filter.h"
#include "scene/node_context.h"
#include "scene/shade_point.h"

namespace lightsieve {
namespace {

enum class BlockerShape : std::int32_t { Box, Sphere, Plane, Cylinder };
enum class BlockerAxis : std::int32_t { X, Y, Z };

struct LightBlocker {
    Mat4f geometry_matrix;
    BlockerShape geometry_type = BlockerShape::Box;
    float density = 0, roundness = 0, width_edge = 0, height_edge = 0, ramp = 0;
    BlockerAxis axis = BlockerAxis::X;
    Color shader;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<LightFilter> make_light_filter(NodeContext& context,
                                                                 const LightPlace& place) const;
};

NodeType LightBlocker::describe() {
    Describe<LightBlocker> d("light_blocker", NodeKind::LightFilter,
                             "Keeps a light away from a region: of what lies in a box, sphere or "
                             "cylinder, or behind a square.");
    d.param("geometry_matrix", &LightBlocker::geometry_matrix,
            "Placement of the region, which has size 1 around the origin.");
    d.param("geometry_type", &LightBlocker::geometry_type, "Its shape.")
        .names({"box", "sphere", "plane", "cylinder"});
    d.param("density", &LightBlocker::density, "Part of the light that is taken.").range(0, 1);
    d.param("roundness", &LightBlocker::roundness, "Rounds the corners of boxes and squares.")
        .range(0, 1);
    d.param("width_edge", &LightBlocker::width_edge, "Part of the width over which it fades.")
        .range(0, 1);
    d.param("height_edge", &LightBlocker::height_edge, "Part of the height over which it fades.")
        .range(0, 1);
    d.param("ramp", &LightBlocker::ramp, "Lets density fall off along `axis`.").range(0, 1);
    d.param("axis", &LightBlocker::axis, "Axis of the ramp.").names({"x", "y", "z"});
    d.param("shader", &LightBlocker::shader, "Colour that blocked light gets.");
    return d.done();
}

class Blocker final : public LightFilter {
  public:
    Blocker(const LightBlocker& node, ColorInput color)
        : n_(node), local_from_world_(node.geometry_matrix.inverse()), color_(color) {}
    [[nodiscard]] Color filtered(Color radiance, Vec3f from, Vec3f to, float) const override {
        Vec3f p = local_from_world_.point(to);
        if (n_.geometry_type == BlockerShape::Plane) {
            // Where the light's way crosses the square, if it does.
            const Vec3f q = local_from_world_.point(from);
            if (!(p.z * q.z < 0)) return radiance;
            p = p + (q - p) * (p.z / (p.z - q.z));
        }
        const float taken = unit(n_.density) * inside(p) * ramp(p);
        if (!(taken > 0)) return radiance;
        ShadePoint point;
        point.position = to;
        point.uv = {p.x + 0.5F, p.y + 0.5F};
        return lerp(radiance, radiance * color_.at(point), taken);
    }

  private:
    static float unit(float v) { return v > 0 ? std::min(v, 1.0F) : 0.0F; }
    /// 1 in the middle, 0 from the border (x = 1) on; `edge` is the part over which it fades.
    static float fading(float x, float edge) {
        if (x >= 1) return 0;
        if (!(edge > 0)) return 1;
        const float t = unit((1 - x) / edge);
        return t * t * (3 - 2 * t);
    }
    [[nodiscard]] float inside(Vec3f p) const {
        const Vec3f a{std::abs(p.x) * 2, std::abs(p.y) * 2, std::abs(p.z) * 2};
        switch (n_.geometry_type) {
            case BlockerShape::Sphere: return fading(length(a), n_.width_edge);
            case BlockerShape::Cylinder:
                return fading(std::sqrt(a.x * a.x + a.z * a.z), n_.width_edge) *
                       fading(a.y, n_.height_edge);
            case BlockerShape::Plane:
            case BlockerShape::Box: break;
        }
        const float depth = n_.geometry_type == BlockerShape::Box ? fading(a.z, n_.width_edge) : 1;
        // Between a square and a circle.
        const float round = unit(n_.roundness), circle = std::sqrt(a.x * a.x + a.y * a.y);
        const float x = lerp(a.x, circle, round), y = lerp(a.y, circle, round);
        return depth * fading(x, n_.width_edge) * fading(y, n_.height_edge);
    }
    [[nodiscard]] float ramp(Vec3f p) const {
        return lerp(1.0F, unit(p[static_cast<int>(n_.axis)] + 0.5F), unit(n_.ramp));
    }

    LightBlocker n_;
    Mat4f local_from_world_;
    ColorInput color_;
};

std::unique_ptr<LightFilter> LightBlocker::make_light_filter(NodeContext& context,
                                                             const LightPlace&) const {
    bool invertible = false;
    (void)geometry_matrix.inverse(&invertible);
    if (!invertible) {
        context.diagnostics().warning(Code::InvalidValue,
                                      "the geometry_matrix of light_blocker \"" +
                                          context.node_name().str() +
                                          "\" is flat: the blocker is left out",
                                      context.where("geometry_matrix"));
        return nullptr;
    }
    return std::make_unique<Blocker>(*this, context.color_input("shader"));
}

}  // namespace

NodeType node_light_blocker() { return LightBlocker::describe(); }

}  // namespace lightsieve
