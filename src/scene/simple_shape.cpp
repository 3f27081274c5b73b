#include "scene/simple_shape.h"

#include <cmath>

namespace lightsieve {
namespace {

/// Three doubles: differences of squares lose too much in floats.
struct Vec3d {
    double x = 0, y = 0, z = 0;
    Vec3d(double a, double b, double c) : x(a), y(b), z(c) {}
    explicit Vec3d(Vec3f v) : x(v.x), y(v.y), z(v.z) {}
    friend Vec3d operator+(Vec3d a, Vec3d b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3d operator-(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3d operator*(Vec3d a, double s) { return {a.x * s, a.y * s, a.z * s}; }
};
double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3f to_float(Vec3d v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Roots of a t^2 + 2 b t + c, the smaller one first; `n` of them.
struct Roots {
    std::array<double, 2> t{};
    int n = 0;
};

Roots solve(double a, double b, double c) {
    // A ray along a generator of the cone meets it once.
    constexpr double kFlat = 1e-14;
    if (std::abs(a) <= kFlat * std::abs(b)) {
        if (b == 0) return {};
        return {{-c / (2 * b), 0}, 1};
    }
    const double squared = b * b - a * c;
    if (!(squared >= 0)) return {};
    // The root without cancellation first, the other from their product.
    const double q = -(b + std::copysign(std::sqrt(squared), b));
    const double first = q / a, second = q != 0 ? c / q : first;
    return {{std::min(first, second), std::max(first, second)}, 2};
}

std::optional<float> within(double t, float t_min, float t_max) {
    if (!(t >= double{t_min} && t <= double{t_max})) return std::nullopt;
    return static_cast<float>(t);
}

std::optional<float> hit_mantle(const SimpleShape& s, Vec3f origin, Vec3f direction, float t_min,
                                float t_max) {
    // |p - axis|^2 = (r0 + k h)^2, where h is the height of p above the base.
    const Vec3d axis(s.axis), q = Vec3d(origin) - Vec3d(s.base), d(direction);
    const double qh = dot(q, axis), dh = dot(d, axis);
    const Vec3d qr = q - axis * qh, dr = d - axis * dh;
    const double k = (double{s.second_radius} - double{s.radius}) / double{s.height};
    const double r = double{s.radius} + k * qh;
    const Roots roots =
        solve(dot(dr, dr) - k * k * dh * dh, dot(qr, dr) - k * dh * r, dot(qr, qr) - r * r);
    for (int i = 0; i < roots.n; ++i) {
        const double t = roots.t[static_cast<std::size_t>(i)], h = qh + t * dh;
        if (!(h >= 0 && h <= double{s.height})) continue;
        if (const auto hit = within(t, t_min, t_max)) return hit;
    }
    return std::nullopt;
}

std::optional<float> hit_flat(const SimpleShape& s, Vec3f origin, Vec3f direction, float t_min,
                              float t_max) {
    const Vec3d axis(s.axis), q = Vec3d(origin) - Vec3d(s.base), d(direction);
    const double facing = dot(d, axis);
    if (facing == 0) return std::nullopt;
    const double t = -dot(q, axis) / facing;
    if (s.kind == SimpleShape::Kind::Disk) {
        const Vec3d p = q + d * t;
        const double squared = dot(p, p), rim = double{s.radius}, hole = double{s.second_radius};
        if (!(squared <= rim * rim && squared >= hole * hole)) return std::nullopt;
    }
    return within(t, t_min, t_max);
}

/// Angle about the axis as a fraction of a turn, and the direction in which it grows.
float turn_of(const Frame& frame, Vec3f radial) {
    const float u = std::atan2(dot(radial, frame.y), dot(radial, frame.x)) * (0.5F * kInvPi);
    return u < 0 ? u + 1 : u;
}

SimplePoint on_mantle(const SimpleShape& s, Vec3f p) {
    const Frame frame = Frame::from_z(s.axis);
    const Vec3d axis(s.axis), q = Vec3d(p) - Vec3d(s.base);
    const double h = std::clamp(dot(q, axis), 0.0, double{s.height});
    const Vec3f radial = normalize(to_float(q - axis * dot(q, axis)), frame.x);
    const float along = static_cast<float>(h) / s.height;
    const float r = std::lerp(s.radius, s.second_radius, along);
    const float slope = (s.second_radius - s.radius) / s.height;
    const float side = std::sqrt(s.height * s.height +
                                 (s.second_radius - s.radius) * (s.second_radius - s.radius));
    SimplePoint out;
    out.position = to_float(Vec3d(s.base) + axis * h + Vec3d(radial) * double{r});
    out.normal = normalize(radial - s.axis * slope);
    out.uv = {turn_of(frame, radial), along};
    out.dp_du = cross(s.axis, radial) * (2 * kPi * r);
    out.dp_dv = s.axis * s.height + radial * (s.second_radius - s.radius);
    out.uv_per_unit = std::max(r > 0 ? 1 / (2 * kPi * r) : 0, 1 / side);
    return out;
}

SimplePoint on_disk(const SimpleShape& s, Vec3f p) {
    const Frame frame = Frame::from_z(s.axis);
    const Vec3d axis(s.axis), q = Vec3d(p) - Vec3d(s.base);
    const Vec3f flat = to_float(q - axis * dot(q, axis));
    const Vec3f radial = normalize(flat, frame.x);
    const float r = length(flat), width = s.radius - s.second_radius;
    SimplePoint out;
    out.position = s.base + flat;
    out.normal = s.axis;
    out.uv = {turn_of(frame, radial), std::clamp((r - s.second_radius) / width, 0.0F, 1.0F)};
    out.dp_du = cross(s.axis, radial) * (2 * kPi * r);
    out.dp_dv = radial * width;
    out.uv_per_unit = std::max(r > 0 ? 1 / (2 * kPi * r) : 0, 1 / width);
    return out;
}

SimplePoint on_plane(const SimpleShape& s, Vec3f p) {
    const Frame frame = Frame::from_z(s.axis);
    const Vec3d axis(s.axis), q = Vec3d(p) - Vec3d(s.base);
    const Vec3d flat = q - axis * dot(q, axis);
    SimplePoint out;
    out.position = to_float(Vec3d(s.base) + flat);
    out.normal = s.axis;
    const Vec3f f = to_float(flat);
    out.uv = {dot(f, frame.x), dot(f, frame.y)};
    out.dp_du = frame.x;
    out.dp_dv = frame.y;
    out.uv_per_unit = 1;
    return out;
}

}  // namespace

std::optional<float> hit_simple_shape(const SimpleShape& shape, Vec3f origin, Vec3f direction,
                                      float t_min, float t_max) {
    return shape.kind == SimpleShape::Kind::Mantle
               ? hit_mantle(shape, origin, direction, t_min, t_max)
               : hit_flat(shape, origin, direction, t_min, t_max);
}

SimplePoint simple_point(const SimpleShape& shape, Vec3f p) {
    switch (shape.kind) {
        case SimpleShape::Kind::Mantle: return on_mantle(shape, p);
        case SimpleShape::Kind::Disk: return on_disk(shape, p);
        case SimpleShape::Kind::Plane: break;
    }
    return on_plane(shape, p);
}

Box3f bounds_of(const SimpleShape& shape) {
    Box3f out;
    if (shape.kind == SimpleShape::Kind::Plane) return out;
    const auto grow = [&](Vec3f center, float radius) {
        // Half the edges of the box of a disk across the axis.
        const auto reach = [&](float a) { return radius * safe_sqrt(1 - a * a); };
        const Vec3f half{reach(shape.axis.x), reach(shape.axis.y), reach(shape.axis.z)};
        out.grow(center - half);
        out.grow(center + half);
    };
    grow(shape.base, shape.radius);
    if (shape.kind == SimpleShape::Kind::Mantle)
        grow(shape.base + shape.axis * shape.height, shape.second_radius);
    return out;
}

Frame facing_frame(const FacingQuad& quad, Vec3f direction) {
    const Vec3f z = -normalize(direction);
    const Vec3f right = cross(quad.up, z);
    const Frame level = Frame::from_z_x(z, right);
    const float c = std::cos(quad.rotation_rad), s = std::sin(quad.rotation_rad);
    return {level.x * c + level.y * s, level.y * c - level.x * s, z};
}

std::optional<float> hit_facing_quad(const FacingQuad& quad, Vec3f origin, Vec3f direction,
                                     float t_min, float t_max) {
    const Vec3f to_center = quad.center - origin;
    const float ball = square(quad.half_width) + square(quad.half_height);
    if (length_squared(to_center) <= ball) return std::nullopt;
    const Vec3d d(direction);
    const double t = dot(Vec3d(to_center), d) / dot(d, d);
    const auto hit = within(t, t_min, t_max);
    if (!hit) return std::nullopt;
    const Vec3f from_center = to_float(d * t - Vec3d(to_center));
    if (length_squared(from_center) > ball) return std::nullopt;
    const Frame frame = facing_frame(quad, direction);
    const bool inside = std::abs(dot(from_center, frame.x)) <= quad.half_width &&
                        std::abs(dot(from_center, frame.y)) <= quad.half_height;
    return inside ? hit : std::nullopt;
}

FacingQuad quad_of(const PointList& points, std::size_t i, Vec3f center, float radius) {
    if (points.mode != PointList::Mode::Quad) return {center, radius, radius, 0, points.up};
    return {center, radius, radius / points.aspect[i], points.rotation_rad[i], points.up};
}

}  // namespace lightsieve
