#include "render/surface.h"

#include <array>
#include <cmath>

#include "render/displacement.h"
#include "render/placement.h"
#include "scene/simple_shape.h"

namespace lightsieve {
namespace {

/// A list with motion keys at one time. Things at rest, which most are, cost one look-up a point.
class AtTime {
  public:
    AtTime(const std::vector<std::vector<Vec3f>>& keys, float time)
        : AtTime(keys, blend_at(keys.size(), time)) {}
    [[nodiscard]] Vec3f operator[](std::size_t i) const {
        return f_ == 0 ? first_[i] : first_[i] * (1 - f_) + second_[i] * f_;
    }

  private:
    AtTime(const std::vector<std::vector<Vec3f>>& keys, KeyBlend k)
        : first_(keys[k.first].data()), second_(keys[k.second].data()), f_(k.f) {}
    const Vec3f *first_, *second_;
    float f_;
};

/// What a primitive says about a point, object space.
struct LocalPoint {
    Vec3f position;
    Vec3f geometric_normal;  ///< not normalised
    /// World space, as modelled (not turned to the viewer), not normalised; zero: the geometric one.
    Vec3f shading_normal;
    Vec3f dp_du;         ///< direction of the frame's x axis; zero if there is no uv
    Vec3f uv_du, uv_dv;  ///< dP/du and dP/dv of `uv`; zero if there is none
    Vec2f uv;
    float uv_per_unit = 0;  ///< uv length per object-space length
    std::uint32_t face = 0;
    std::size_t shader = 0;
    // Curves only; see ShadePoint.
    bool on_curve = false, round = false;
    Vec2f curve_uv;
    float curve_offset = 0;
    Vec3f center;        ///< of the cross-section
    float coverage = 1;  ///< see Surface
};

/// From where a hit is looked at.
struct View {
    const Placement& place;
    Vec3f along;  ///< the hit as a point of the ray, world space
    Vec3f wo;     ///< unit, world space
    float time;
    bool wants_uv;  ///< and what goes with them: dp_du, uv_du, uv_dv, uv_per_unit
};

/// How much of a widened radius there was before.
float share_of(float own, float widened) { return widened > own ? own / widened : 1; }

/// A vertex normal that faces away from the viewer, laid onto the horizon.
///
/// Arnold does this before it interpolates, so that no smooth surface shows its back (measured on reference picture
/// test_0073: a cube with soft normals; bending the interpolated normal instead is off by up to 0.2).
Vec3f bent_to_viewer(Vec3f normal, Vec3f wo) {
    const float away = dot(normal, wo);
    return away < 0 ? normalize(normal - wo * away, normal) : normal;
}

/// Interpolates the normals of a triangle's corners, world space.
Vec3f smooth_normal(const TriangleMesh& mesh, std::size_t first, std::array<float, 3> weights,
                    const View& view, Vec3f face_normal) {
    const AtTime normals(mesh.normals, view.time);
    // The side of the surface that is seen decides which way corner normals face.
    const float side = dot(face_normal, view.wo) < 0 ? -1.0F : 1.0F;
    Vec3f sum;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3f local = normals[mesh.normal_indices[first + i]];
        const Vec3f corner = normalize(view.place.normal_to_world(local), face_normal);
        sum += bent_to_viewer(corner * side, view.wo) * weights[i];
    }
    return length_squared(sum) > 0 ? sum * side : face_normal;
}

LocalPoint resolve(const TriangleMesh& mesh, const RayHit& hit, const View& view) {
    const std::size_t t = std::size_t{hit.primitive} * 3;
    const float b1 = hit.barycentric.x, b2 = hit.barycentric.y, b0 = 1 - b1 - b2;
    const AtTime positions(mesh.positions, view.time);
    const Vec3f p0 = positions[mesh.indices[t]], p1 = positions[mesh.indices[t + 1]],
                p2 = positions[mesh.indices[t + 2]];
    LocalPoint out;
    out.position = p0 * b0 + p1 * b1 + p2 * b2;
    out.geometric_normal = cross(p1 - p0, p2 - p0);
    if (!mesh.normals.empty())
        out.shading_normal =
            smooth_normal(mesh, t, {b0, b1, b2}, view,
                          normalize(view.place.normal_to_world(out.geometric_normal)));
    if (!mesh.face.empty()) out.face = mesh.face[hit.primitive];
    if (!mesh.shader_index.empty()) out.shader = mesh.shader_index[hit.primitive];
    if (mesh.uvs.empty() || !view.wants_uv) return out;
    const Vec2f uv0 = mesh.uvs[mesh.uv_indices[t]], uv1 = mesh.uvs[mesh.uv_indices[t + 1]],
                uv2 = mesh.uvs[mesh.uv_indices[t + 2]];
    out.uv = uv0 * b0 + uv1 * b1 + uv2 * b2;
    const Vec2f d1 = uv1 - uv0, d2 = uv2 - uv0;
    const float det = d1.x * d2.y - d1.y * d2.x;
    const float twice_area = length(out.geometric_normal);
    if (det == 0 || !(twice_area > 0)) return out;
    out.dp_du = out.uv_du = ((p1 - p0) * d2.y - (p2 - p0) * d1.y) / det;
    out.uv_dv = ((p2 - p0) * d1.x - (p1 - p0) * d2.x) / det;
    out.uv_per_unit = std::sqrt(std::abs(det) / twice_area);
    return out;
}

LocalPoint on_sphere(Vec3f center, float radius, const View& view) {
    const Vec3f n = normalize(view.place.point_to_object(view.along) - center);
    LocalPoint out;
    out.position = center + n * radius;  // back onto the sphere: t is only as good as a float
    out.geometric_normal = n;
    if (!view.wants_uv) return out;
    out.dp_du = {n.z, 0, -n.x};
    out.uv = {0.5F + std::atan2(n.x, n.z) * (0.5F * kInvPi),
              0.5F + std::asin(std::clamp(n.y, -1.0F, 1.0F)) * kInvPi};
    out.uv_per_unit = radius > 0 ? 1 / (kPi * radius) : 0;
    const float level = std::sqrt(n.x * n.x + n.z * n.z);  // cosine of the latitude
    out.uv_du = out.dp_du * (2 * kPi * radius);
    if (level > 0)
        out.uv_dv = Vec3f{-n.y * n.x / level, level, -n.y * n.z / level} * (kPi * radius);
    return out;
}

LocalPoint resolve(const SphereList& spheres, const RayHit& hit, const View& view) {
    return on_sphere(AtTime(spheres.centers, view.time)[hit.primitive],
                     spheres.radii[hit.primitive], view);
}

LocalPoint resolve(const PointList& points, const RayHit& hit, const View& view) {
    const Vec3f center = AtTime(points.centers, view.time)[hit.primitive];
    const KeyBlend k = blend_at(points.radii.size(), view.time);
    const float radius = std::lerp(points.radii[k.first][hit.primitive],
                                   points.radii[k.second][hit.primitive], k.f);
    LocalPoint out;
    if (!points.own_radii.empty()) {
        const float own = std::lerp(points.own_radii[k.first][hit.primitive],
                                    points.own_radii[k.second][hit.primitive], k.f);
        out.coverage = square(share_of(own, radius));
    }
    if (points.mode == PointList::Mode::Sphere) {
        // What passes it meets its far side, too.
        const float twice = 1 - std::sqrt(1 - out.coverage);
        out = on_sphere(center, radius, view);
        out.coverage = twice;
    } else {
        // Flat, across the ray; uv are those of the square around it.
        const FacingQuad quad = quad_of(points, hit.primitive, center, radius);
        const Frame frame = facing_frame(quad, -view.place.vector_to_object(view.wo));
        const Vec3f from_center = view.place.point_to_object(view.along) - center;
        const float x = dot(from_center, frame.x), y = dot(from_center, frame.y);
        out.position = center + frame.x * x + frame.y * y;
        out.geometric_normal = frame.z;
        out.dp_du = frame.x;
        out.uv = {0.5F + 0.5F * x / quad.half_width, 0.5F + 0.5F * y / quad.half_height};
        out.uv_du = frame.x * (2 * quad.half_width);
        out.uv_dv = frame.y * (2 * quad.half_height);
        out.uv_per_unit = 0.5F / std::min(quad.half_width, quad.half_height);
    }
    out.face = points.index[hit.primitive];
    return out;
}

LocalPoint resolve(const SimpleShape& shape, const RayHit& /*hit*/, const View& view) {
    const SimplePoint at = simple_point(shape, view.place.point_to_object(view.along));
    LocalPoint out;
    out.position = at.position;
    out.geometric_normal = at.normal;
    out.dp_du = out.uv_du = at.dp_du;
    out.uv_dv = at.dp_dv;
    out.uv = at.uv;
    out.uv_per_unit = at.uv_per_unit;
    return out;
}

/// A curve at a parameter: centre, derivative and radius.
struct CurvePoint {
    Vec3f center, derivative;
    float radius = 0, radius_derivative = 0;
};

CurvePoint curve_at(const CurveList& curves, const std::vector<std::vector<float>>& radii,
                    std::size_t first, float u, float time) {
    const AtTime points(curves.points, time);
    const KeyBlend k = blend_at(radii.size(), time);
    const auto radius = [&](std::size_t i) {
        return std::lerp(radii[k.first][i], radii[k.second][i], k.f);
    };
    if (curves.linear) {
        const Vec3f a = points[first], b = points[first + 1];
        const float ra = radius(first), rb = radius(first + 1);
        return {a * (1 - u) + b * u, b - a, std::lerp(ra, rb, u), rb - ra};
    }
    const float w = 1 - u;
    const std::array<float, 4> value{w * w * w, 3 * w * w * u, 3 * w * u * u, u * u * u},
        slope{-3 * w * w, 3 * w * (w - 2 * u), 3 * u * (2 * w - u), 3 * u * u};
    CurvePoint out;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3f p = points[first + i];
        const float r = radius(first + i);
        out.center += p * value[i];
        out.derivative += p * slope[i];
        out.radius += r * value[i];
        out.radius_derivative += r * slope[i];
    }
    // Control points that coincide (ends that are written twice) leave no direction: the chord's.
    if (!(length_squared(out.derivative) > 0)) out.derivative = points[first + 3] - points[first];
    return out;
}

LocalPoint resolve(const CurveList& curves, const RayHit& hit, const View& view) {
    const CurveList::Segment& segment = curves.segments[hit.primitive];
    const float u = std::clamp(hit.barycentric.x, 0.0F, 1.0F);
    const CurvePoint at = curve_at(curves, curves.radii, segment.first, u, view.time);
    const Vec3f along = normalize(at.derivative, {1, 0, 0});

    // The cross-section as the viewer sees it: z toward the viewer, y across.
    const Vec3f seen = view.place.vector_to_object(view.wo);
    const Vec3f z = normalize(seen - along * dot(seen, along), Frame::from_z(along).x);
    const Vec3f y = cross(z, along);
    const Vec3f from_center = view.place.point_to_object(view.along) - at.center;

    LocalPoint out;
    const float radius = std::max(at.radius, 1e-20F);
    const auto across = [&](Vec3f axis) {
        return std::clamp(dot(from_center, axis) / radius, -1.0F, 1.0F);
    };
    out.curve_offset = across(y);
    switch (curves.mode) {
        case CurveList::Mode::Ribbon:
            out.position = at.center + y * (out.curve_offset * radius);
            out.geometric_normal = z;
            break;
        case CurveList::Mode::Thick: {
            // The side of the round fibre, which leans where the radius changes.
            const Vec3f side = normalize(from_center - along * dot(from_center, along), z);
            out.curve_offset = std::clamp(dot(side, y), -1.0F, 1.0F);
            out.position = at.center + side * radius;
            const float speed = length(at.derivative);
            out.geometric_normal = side * speed - along * at.radius_derivative;
            out.round = true;
            break;
        }
        case CurveList::Mode::Oriented: {
            const AtTime normals(curves.normals, view.time);
            const std::size_t first = segment.first, last = first + curves.n_controls() - 1;
            const Vec3f n = normals[first] * (1 - u) + normals[last] * u;
            out.geometric_normal = normalize(n - along * dot(n, along), z);
            out.position = view.place.point_to_object(view.along);
            out.curve_offset = across(cross(out.geometric_normal, along));
            if (dot(out.geometric_normal, z) < 0) out.curve_offset = -out.curve_offset;
            break;
        }
    }
    out.on_curve = true;
    if (!curves.own_radii.empty())
        out.coverage = share_of(
            curve_at(curves, curves.own_radii, segment.first, u, view.time).radius, at.radius);
    out.center = at.center;
    out.dp_du = along;
    out.curve_uv = {0.5F + 0.5F * out.curve_offset, std::lerp(segment.v0, segment.v1, u)};
    out.uv = curves.uvs.empty() ? out.curve_uv : curves.uvs[segment.curve];
    if (curves.uvs.empty()) {
        const float speed = length(at.derivative);
        out.uv_per_unit = speed > 0 ? (segment.v1 - segment.v0) / speed : 0;
        const float dv = segment.v1 - segment.v0;
        out.uv_du = y * (2 * radius);
        if (dv > 0) out.uv_dv = at.derivative / dv;
    }
    out.face = segment.curve;
    return out;
}

Surface surface_at(const Placement& place, const SceneObject& object, const Ray& ray,
                   const RayHit& hit, const Footprint& footprint) {
    const View view{place, ray.origin + ray.direction * hit.t, -ray.direction, ray.time,
                    object.wants_uv};
    const LocalPoint local =
        std::visit([&](const auto& g) { return resolve(g, hit, view); }, object.geometry->data);
    Surface out;
    out.object = &object;
    out.t = hit.t;
    out.shader = object.shaders[std::min(local.shader, object.shaders.size() - 1)];
    out.coverage = local.coverage;
    const Vec3f wo = view.wo;
    const float outside = object.invert_normals ? -1.0F : 1.0F;
    const Vec3f geometric = normalize(place.normal_to_world(local.geometric_normal) * outside);
    const Vec3f shading = local.shading_normal == Vec3f{}
                              ? geometric
                              : normalize(local.shading_normal * outside, geometric);
    ShadePoint& at = out.at;
    at.position = place.point_to_world(local.position);
    at.wo = wo;
    at.geometric_normal = geometric;
    at.entering = dot(geometric, wo) >= 0;
    out.outward = at.entering ? geometric : -geometric;
    at.normal = dot(shading, out.outward) < 0 ? -shading : shading;
    const bool has_uv = !(local.dp_du == Vec3f{});
    const Vec3f tangent = has_uv ? place.vector_to_world(local.dp_du) : Vec3f{};
    out.frame = has_uv ? Frame::from_z_x(at.normal, tangent) : Frame::from_z_level(at.normal);
    at.tangent = out.frame.x;
    if (has_uv && !object.reads_coordinates) out.frame = Frame::from_z_level(at.normal);
    at.uv = local.uv;
    at.barycentric = hit.barycentric;
    if (object.wants_uv) {
        at.dp_du = place.vector_to_world(local.uv_du);
        at.dp_dv = place.vector_to_world(local.uv_dv);
    }
    at.width = footprint.width + footprint.spread * hit.t;
    at.ray_length = hit.t;
    at.primitive = hit.primitive;
    at.services = object.services;
    if (local.uv_per_unit > 0) {
        const float cosine = std::max(0.1F, std::abs(dot(geometric, wo)));
        const float scale = length(local.dp_du) > 0 ? length(tangent) / length(local.dp_du) : 1;
        at.uv_width = local.uv_per_unit * at.width / (cosine * std::max(scale, 1e-20F));
    }
    at.face = local.face;
    if (local.on_curve) {
        at.on_curve = true;
        at.curve_uv = local.curve_uv;
        at.curve_offset = local.curve_offset;
        at.tangent = normalize(tangent, out.frame.x);
        out.round_fibre = local.round;
        out.fibre_center = place.point_to_world(local.center);
    }
    at.shape_id = object.id;
    at.time = ray.time;
    at.shape = &object;
    at.direction = ray.direction;
    return out;
}

// How far the point of a primitive goes from one time to another, object space.

Vec3f way(const TriangleMesh& mesh, const ShadePoint& at, float from, float to) {
    if (mesh.positions.size() == 1) return {};
    const std::array<Vec3f, 3> before = triangle_corners(mesh, at.primitive, from),
                               after = triangle_corners(mesh, at.primitive, to);
    const float b1 = at.barycentric.x, b2 = at.barycentric.y;
    return (after[0] - before[0]) * (1 - b1 - b2) + (after[1] - before[1]) * b1 +
           (after[2] - before[2]) * b2;
}

/// Spheres and points.
template <class Shape>
    requires requires(const Shape& shape) { shape.centers; }
Vec3f way(const Shape& shape, const ShadePoint& at, float from, float to) {
    return AtTime(shape.centers, to)[at.primitive] - AtTime(shape.centers, from)[at.primitive];
}

Vec3f way(const CurveList& curves, const ShadePoint& at, float from, float to) {
    const std::size_t first = curves.segments[at.primitive].first;
    const float u = std::clamp(at.barycentric.x, 0.0F, 1.0F);
    return curve_at(curves, curves.radii, first, u, to).center -
           curve_at(curves, curves.radii, first, u, from).center;
}

Vec3f way(const SimpleShape& /*shape*/, const ShadePoint& /*at*/, float /*from*/, float /*to*/) {
    return {};
}

LightHit light_hit_at(const Placement& place, const SceneObject& object, const Ray& ray,
                      const RayHit& hit) {
    const View view{place, ray.origin + ray.direction * hit.t, -ray.direction, ray.time, true};
    const LocalPoint local =
        std::visit([&](const auto& g) { return resolve(g, hit, view); }, object.geometry->data);
    const Vec3f normal = normalize(place.normal_to_world(local.geometric_normal));
    return {place.point_to_world(local.position), normal, local.uv, hit.primitive, hit.t};
}

}  // namespace

Vec3f start_of_ray(const Surface& surface, Vec3f wi) {
    if (surface.in_medium) return surface.at.position;
    const bool outside = dot(wi, surface.outward) > 0;
    if (!surface.round_fibre || outside)
        return offset_ray_origin(surface.at.position,
                                 outside ? surface.outward : -surface.outward);
    // Across the fibre to where it comes out, in the plane of the cross-section.
    const Vec3f axis = surface.at.tangent;
    const Vec3f across = normalize(wi - axis * dot(wi, axis), -surface.outward);
    const float chord = -2 * dot(surface.at.position - surface.fibre_center, across);
    return offset_ray_origin(surface.at.position + across * std::max(chord, 0.0F), across);
}

Surface make_surface(const SceneObject& object, const Ray& ray, const RayHit& hit,
                     const Footprint& footprint) {
    return with_placement(object, ray.time, [&](const Placement& place) {
        return surface_at(place, object, ray, hit, footprint);
    });
}

bool Scene::is_there(const Surface& surface, RayType type) const {
    const SceneObject& object = *surface.object;
    if (!surface.at.entering && (object.sidedness & ray_bit(type)) == 0) return false;
    return !object.is_cut || cutters.is_there(surface, *accel, objects);
}

void add_closures(const Surface& surface, const ShadePoint& at, ClosureSet& out) {
    if (surface.coverage < 1) {
        out.transparent(Color::grey(1 - surface.coverage));
        out.set_scale(Color::grey(surface.coverage));
    }
    surface.shader->closures(at, out);
}

void meet(Surface& surface, RayType type) {
    surface.at.ray_type = type;
    if (surface.object->bumps != nullptr) surface.object->bumps->bump(surface);
}

LightHit make_light_hit(const SceneObject& object, const Ray& ray, const RayHit& hit) {
    return with_placement(object, ray.time, [&](const Placement& place) {
        return light_hit_at(place, object, ray, hit);
    });
}

Vec3f position_at(const Surface& surface, float time) {
    const ShadePoint& at = surface.at;
    const SceneObject& object = *surface.object;
    const Vec3f here = with_placement(object, at.time, [&](const Placement& place) {
        return place.point_to_object(at.position);
    });
    const Vec3f there = here + std::visit([&](const auto& g) { return way(g, at, at.time, time); },
                                          object.geometry->data);
    return with_placement(object, time,
                          [&](const Placement& place) { return place.point_to_world(there); });
}

Mat4f placement_at(const SceneObject& object, float time) {
    return with_placement(object, time,
                          [](const Placement& place) { return place.world_from_object; });
}

std::array<Vec3f, 3> triangle_corners(const TriangleMesh& mesh, std::uint32_t triangle,
                                      float time) {
    const AtTime positions(mesh.positions, time);
    const std::size_t t = std::size_t{triangle} * 3;
    return {positions[mesh.indices[t]], positions[mesh.indices[t + 1]],
            positions[mesh.indices[t + 2]]};
}

}  // namespace lightsieve
