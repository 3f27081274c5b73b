// uv_projection: a flat texture thrown onto an object: onto a plane, a ball, a cylinder, a box.
#include "nodes/texture/coord_space.h"

namespace lightsieve {
namespace {

enum class Projection : std::int32_t { Planar, Spherical, Cylindrical, Ball, Cubic, Shrinkwrap };

struct UvProjection : SolidPlace {
    Lazy<Rgba> projection_color{{{1, 1, 1}, 1}, {}};
    Projection projection_type = Projection::Planar;
    float u_angle = 180, v_angle = 90;
    bool clamp = false;
    Rgba default_color{{0, 0, 0}, 0};
    Mat4f matrix;
    Mat4f local_from_place;  ///< inverse of the matrix, found by prepare()

    static NodeType describe();
    void prepare(NodeContext& context) {
        SolidPlace::prepare(context);
        local_from_place = matrix.inverse();
    }
    [[nodiscard]] Rgba eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] Vec2f uv_of(Vec3f p, bool& inside) const;
};

NodeType UvProjection::describe() {
    Describe<UvProjection> d("uv_projection", NodeKind::Shader,
                             "A flat texture thrown onto an object.");
    d.param("projection_color", &UvProjection::projection_color, "The texture.");
    d.param("projection_type", &UvProjection::projection_type, "What it is wrapped around.")
        .names({"planar", "spherical", "cylindrical", "ball", "cubic", "shrinkwrap"});
    describe_solid_place(d);
    d.param("u_angle", &UvProjection::u_angle,
            "Angle that the texture covers around spheres and cylinders.")
        .unit("deg");
    d.param("v_angle", &UvProjection::v_angle, "Angle that it covers upward on spheres.")
        .unit("deg");
    d.param("clamp", &UvProjection::clamp, "Outside of the shape lies default_color.");
    d.param("default_color", &UvProjection::default_color,
            "Colour of points that the texture does not cover.");
    d.param("matrix", &UvProjection::matrix,
            "Placement of the shape, which reaches from -1 to 1, in coord_space.");
    return d.done();
}

Vec2f UvProjection::uv_of(Vec3f p, bool& inside) const {
    const float r = length(p), level = std::sqrt(p.x * p.x + p.z * p.z);
    const float around = std::atan2(p.x, p.z), up = std::atan2(p.y, level);
    const auto covers = [](float angle) { return std::fmax(deg_to_rad(angle), 1e-4F); };
    inside = r <= 1;
    switch (projection_type) {
        case Projection::Planar:
            inside = std::abs(p.x) <= 1 && std::abs(p.y) <= 1;
            return {0.5F + 0.5F * p.x, 0.5F + 0.5F * p.y};
        case Projection::Spherical:
            return {0.5F + around / covers(u_angle), 0.5F + up / covers(v_angle)};
        case Projection::Cylindrical:
            inside = level <= 1 && std::abs(p.y) <= 1;
            return {0.5F + around / covers(u_angle), 0.5F + 0.5F * p.y};
        case Projection::Ball: {
            // As a mirrored ball, its pole on +z.
            const float out = safe_sqrt(0.5F - 0.5F * (r > 0 ? p.z / r : 1)),
                        flat = std::sqrt(p.x * p.x + p.y * p.y);
            const float scale = flat > 0 ? 0.5F * out / flat : 0;
            return {0.5F + p.x * scale, 0.5F + p.y * scale};
        }
        case Projection::Cubic: {
            inside = std::abs(p.x) <= 1 && std::abs(p.y) <= 1 && std::abs(p.z) <= 1;
            const Vec3f a{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
            if (a.x >= a.y && a.x >= a.z) return {0.5F + 0.5F * p.z, 0.5F + 0.5F * p.y};
            if (a.y >= a.z) return {0.5F + 0.5F * p.x, 0.5F + 0.5F * p.z};
            return {0.5F + 0.5F * p.x, 0.5F + 0.5F * p.y};
        }
        case Projection::Shrinkwrap: break;
    }
    // A disc pulled over a ball from the top: the border meets at the bottom.
    const float out = (0.5F * kPi - up) * kInvPi;
    return {0.5F + 0.5F * out * std::sin(around), 0.5F + 0.5F * out * std::cos(around)};
}

Rgba UvProjection::eval(const ShadePoint& at) const {
    bool inside = true;
    const Vec2f uv = uv_of(local_from_place.point(place(at)), inside);
    const bool covered = uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1;
    const bool by_angle =
        projection_type == Projection::Spherical || projection_type == Projection::Cylindrical;
    if ((clamp && !inside) || (by_angle && !covered && clamp)) return default_color;
    ShadePoint point = at;
    point.uv = uv;
    point.dp_du = point.dp_dv = {};
    // The shape is two units across, a texture one.
    point.uv_width = 0.5F * at.width * std::cbrt(std::abs(local_from_place.determinant3()));
    return projection_color.at(point);
}

}  // namespace

NodeType node_uv_projection() { return UvProjection::describe(); }

}  // namespace lightsieve
