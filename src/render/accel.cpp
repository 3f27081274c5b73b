#include "render/accel.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/float4.h"
#include "render/placement.h"
#include "scene/simple_shape.h"

namespace lightsieve {
namespace {

struct DeviceDelete {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePtr = std::unique_ptr<RTCDeviceTy, DeviceDelete>;
using ScenePtr = std::unique_ptr<RTCSceneTy, SceneRelease>;

[[noreturn]] void fail(RTCDevice device, const char* doing) {
    const RTCError code = rtcGetDeviceError(device);
    const char* why =
        code == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory" : "the ray library refused";
    throw InputError({Code::LimitMemory,
                      std::string(why) + " while " + doing,
                      {},
                      "fewer or simpler shapes, or a machine with more memory"});
}

/// The placement at an arbitrary point of the shutter.
Mat4f placement_at(std::span<const Mat4f> keys, float time) {
    if (keys.size() == 1) return keys[0];
    const float x = std::clamp(time, 0.0F, 1.0F) * static_cast<float>(keys.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(x), keys.size() - 2);
    return lerp(keys[i], keys[i + 1], x - static_cast<float>(i));
}

Vec3f position_at(const std::vector<std::vector<Vec3f>>& keys, std::size_t i, float time) {
    if (keys.size() == 1) return keys[0][i];
    const float x = std::clamp(time, 0.0F, 1.0F) * static_cast<float>(keys.size() - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(x), keys.size() - 2);
    const float f = x - static_cast<float>(k);
    return keys[k][i] * (1 - f) + keys[k + 1][i] * f;
}

/// How much a transform scales if it keeps the shape of things; 0 if it stretches or shears.
float even_scale(const Mat4f& m) {
    constexpr float kTolerance = 1e-5F;
    const Vec3f x = m.vector({1, 0, 0}), y = m.vector({0, 1, 0}), z = m.vector({0, 0, 1});
    const float squared = length_squared(x), most = kTolerance * squared;
    const bool even = std::abs(length_squared(y) - squared) <= most &&
                      std::abs(length_squared(z) - squared) <= most &&
                      std::abs(dot(x, y)) <= most && std::abs(dot(y, z)) <= most &&
                      std::abs(dot(z, x)) <= most;
    return even ? std::sqrt(squared) : 0;
}

constexpr std::size_t kMaxKeys = RTC_MAX_TIME_STEP_COUNT;

// Shapes that Embree does not know: it asks for bounds and intersections, always in object space.

/// How far a plane's bounds reach. Embree leaves out what lies beyond 1.8e18.
constexpr float kPlaneReach = 1e15F;

RTCBounds to_embree(const Box3f& box) {
    return {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
}

Box3f reach_of(const SimpleShape& shape) {
    if (shape.kind != SimpleShape::Kind::Plane) return bounds_of(shape);
    const Vec3f far{kPlaneReach, kPlaneReach, kPlaneReach};
    Box3f out{-far, far};
    // A plane across an axis is a flat box: most rays that stay on one side of it never look at it.
    for (int i = 0; i < 3; ++i)
        if (std::abs(shape.axis[i]) == 1) out.lower[i] = out.upper[i] = shape.base[i];
    return out;
}

Vec3f center_at(const PointList& points, std::size_t i, KeyBlend k) {
    return points.centers[k.first][i] * (1 - k.f) + points.centers[k.second][i] * k.f;
}

float radius_at(const PointList& points, std::size_t i, KeyBlend k) {
    return std::lerp(points.radii[k.first][i], points.radii[k.second][i], k.f);
}

Box3f bounds_at_key(const SimpleShape& shape, unsigned /*primitive*/, unsigned /*key*/) {
    return reach_of(shape);
}

Box3f bounds_at_key(const PointList& points, unsigned primitive, unsigned key) {
    const Vec3f c = points.centers[key][primitive];
    const FacingQuad quad = quad_of(points, primitive, c, points.radii[key][primitive]);
    const float r = std::hypot(quad.half_width, quad.half_height);
    return {c - Vec3f{r, r, r}, c + Vec3f{r, r, r}};
}

std::optional<float> hit_at(const SimpleShape& shape, unsigned /*primitive*/, const RTCRay& ray) {
    return hit_simple_shape(shape, {ray.org_x, ray.org_y, ray.org_z},
                            {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tnear, ray.tfar);
}

std::optional<float> hit_at(const PointList& points, unsigned primitive, const RTCRay& ray) {
    const KeyBlend k = blend_at(points.centers.size(), ray.time);
    return hit_facing_quad(quad_of(points, primitive, center_at(points, primitive, k),
                                   radius_at(points, primitive, k)),
                           {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z},
                           ray.tnear, ray.tfar);
}

/// A geometry of `n` primitives that are met by `hit_at`. `shape` must outlive it.
template <class Shape>
RTCGeometry asking_geometry(RTCDevice device, const Shape& shape, std::size_t n,
                            std::size_t n_keys) {
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, static_cast<unsigned>(n));
    rtcSetGeometryTimeStepCount(g, static_cast<unsigned>(n_keys));
    rtcSetGeometryUserData(g, const_cast<Shape*>(&shape));
    rtcSetGeometryBoundsFunction(
        g,
        [](const RTCBoundsFunctionArguments* a) {
            const auto& s = *static_cast<const Shape*>(a->geometryUserPtr);
            *a->bounds_o = to_embree(bounds_at_key(s, a->primID, a->timeStep));
        },
        nullptr);
    // Rays come one by one (rtcIntersect1, rtcOccluded1).
    rtcSetGeometryIntersectFunction(g, [](const RTCIntersectFunctionNArguments* a) {
        if (a->valid[0] == 0) return;
        const auto& s = *static_cast<const Shape*>(a->geometryUserPtr);
        auto* r = reinterpret_cast<RTCRayHit*>(a->rayhit);
        const std::optional<float> t = hit_at(s, a->primID, r->ray);
        if (!t) return;
        r->ray.tfar = *t;
        r->hit.u = r->hit.v = 0;
        r->hit.primID = a->primID;
        r->hit.geomID = a->geomID;
        r->hit.instID[0] = a->context->instID[0];
    });
    rtcSetGeometryOccludedFunction(g, [](const RTCOccludedFunctionNArguments* a) {
        if (a->valid[0] == 0) return;
        const auto& s = *static_cast<const Shape*>(a->geometryUserPtr);
        auto* r = reinterpret_cast<RTCRay*>(a->ray);
        if (hit_at(s, a->primID, *r)) r->tfar = -kInfinity;
    });
    return g;
}

/// Makes one Embree geometry; positions are transformed by `placement` (identity inside an instanced scene).
class GeometryMaker {
  public:
    GeometryMaker(RTCDevice device, std::span<const Mat4f> placement)
        : device_(device), placement_(placement) {}

    RTCGeometry operator()(const TriangleMesh& mesh) const {
        RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        const std::size_t n_keys =
            std::min(kMaxKeys, std::max(mesh.positions.size(), placement_.size()));
        rtcSetGeometryTimeStepCount(g, static_cast<unsigned>(n_keys));
        const std::size_t n = mesh.positions[0].size();
        for (std::size_t k = 0; k < n_keys; ++k) {
            auto* out = static_cast<float*>(
                rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(k),
                                        RTC_FORMAT_FLOAT3, 3 * sizeof(float), n));
            if (out == nullptr) fail(device_, "storing a mesh");
            const float time =
                n_keys == 1 ? 0 : static_cast<float>(k) / static_cast<float>(n_keys - 1);
            const Mat4f to_world = placement_at(placement_, time);
            for (std::size_t i = 0; i < n; ++i) {
                const Vec3f p = to_world.point(position_at(mesh.positions, i, time));
                std::memcpy(out + 3 * i, &p, sizeof(p));
            }
        }
        auto* index = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
        if (index == nullptr) fail(device_, "storing a mesh");
        std::memcpy(index, mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
        return g;
    }

    RTCGeometry operator()(const SphereList& spheres) const {
        RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
        const std::size_t n_keys = std::min(kMaxKeys, spheres.centers.size());
        rtcSetGeometryTimeStepCount(g, static_cast<unsigned>(n_keys));
        const std::size_t n = spheres.radii.size();
        for (std::size_t k = 0; k < n_keys; ++k) {
            auto* out = static_cast<float*>(
                rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(k),
                                        RTC_FORMAT_FLOAT4, 4 * sizeof(float), n));
            if (out == nullptr) fail(device_, "storing spheres");
            for (std::size_t i = 0; i < n; ++i) {
                const Vec3f c = placement_[0].point(spheres.centers[k][i]);
                const std::array<float, 4> v{c.x, c.y, c.z,
                                             spheres.radii[i] * even_scale(placement_[0])};
                std::memcpy(out + 4 * i, v.data(), sizeof(v));
            }
        }
        return g;
    }

    RTCGeometry operator()(const CurveList& curves) const {
        RTCGeometry g = rtcNewGeometry(device_, type_of(curves));
        const auto n_keys = static_cast<unsigned>(std::min(kMaxKeys, curves.points.size()));
        rtcSetGeometryTimeStepCount(g, n_keys);
        const Mat4f& to_world = placement_[0];
        const float scale = even_scale(to_world);
        for (unsigned k = 0; k < n_keys; ++k) {
            store<float>(g, RTC_BUFFER_TYPE_VERTEX, k, RTC_FORMAT_FLOAT4, 4,
                         curves.points[k].size(), [&](std::size_t i) {
                             const Vec3f p = to_world.point(curves.points[k][i]);
                             return std::array{p.x, p.y, p.z, curves.radii[k][i] * scale};
                         });
            if (curves.mode == CurveList::Mode::Oriented)
                store<float>(g, RTC_BUFFER_TYPE_NORMAL, k, RTC_FORMAT_FLOAT3, 3,
                             curves.normals[0].size(), [&](std::size_t i) {
                                 const Vec3f n = to_world.vector(curves.normals[0][i]);
                                 return std::array{n.x, n.y, n.z};
                             });
        }
        store<std::uint32_t>(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, 1,
                             curves.segments.size(),
                             [&](std::size_t i) { return std::array{curves.segments[i].first}; });
        if (curves.linear && curves.mode == CurveList::Mode::Thick)
            store<std::uint8_t>(g, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1,
                                curves.segments.size(),
                                [&](std::size_t i) { return std::array{neighbours(curves, i)}; });
        return g;
    }

    RTCGeometry operator()(const PointList& points) const {
        if (points.mode == PointList::Mode::Quad)
            return asking_geometry(device_, points, points.index.size(),
                                   std::min(kMaxKeys, points.centers.size()));
        RTCGeometry g = rtcNewGeometry(device_, points.mode == PointList::Mode::Sphere
                                                    ? RTC_GEOMETRY_TYPE_SPHERE_POINT
                                                    : RTC_GEOMETRY_TYPE_DISC_POINT);
        const auto n_keys = static_cast<unsigned>(std::min(kMaxKeys, points.centers.size()));
        rtcSetGeometryTimeStepCount(g, n_keys);
        const float scale = even_scale(placement_[0]);
        for (unsigned k = 0; k < n_keys; ++k)
            store<float>(g, RTC_BUFFER_TYPE_VERTEX, k, RTC_FORMAT_FLOAT4, 4, points.index.size(),
                         [&](std::size_t i) {
                             const Vec3f p = placement_[0].point(points.centers[k][i]);
                             return std::array{p.x, p.y, p.z, points.radii[k][i] * scale};
                         });
        return g;
    }

    RTCGeometry operator()(const SimpleShape& shape) const {
        return asking_geometry(device_, shape, 1, 1);
    }

  private:
    static RTCGeometryType type_of(const CurveList& curves) {
        if (curves.linear)
            return curves.mode == CurveList::Mode::Thick ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE
                                                         : RTC_GEOMETRY_TYPE_FLAT_LINEAR_CURVE;
        switch (curves.mode) {
            case CurveList::Mode::Thick: return RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE;
            case CurveList::Mode::Oriented: return RTC_GEOMETRY_TYPE_NORMAL_ORIENTED_BEZIER_CURVE;
            case CurveList::Mode::Ribbon: break;
        }
        return RTC_GEOMETRY_TYPE_FLAT_BEZIER_CURVE;
    }
    /// Straight round segments are joined where their curve goes on.
    static std::uint8_t neighbours(const CurveList& curves, std::size_t i) {
        const auto& all = curves.segments;
        const bool left = i > 0 && all[i - 1].curve == all[i].curve,
                   right = i + 1 < all.size() && all[i + 1].curve == all[i].curve;
        return static_cast<std::uint8_t>((left ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                         (right ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
    }
    /// Fills a buffer of `n` items of `width` values each.
    template <class T, class Item>
    void store(RTCGeometry g, RTCBufferType buffer, unsigned slot, RTCFormat format,
               std::size_t width, std::size_t n, const Item& item) const {
        auto* out = static_cast<T*>(
            rtcSetNewGeometryBuffer(g, buffer, slot, format, width * sizeof(T), n));
        if (out == nullptr) fail(device_, "storing curves or points");
        for (std::size_t i = 0; i < n; ++i) {
            const auto value = item(i);
            std::memcpy(out + width * i, value.data(), sizeof(value));
        }
    }

    RTCDevice device_;
    std::span<const Mat4f> placement_;
};

/// Spheres and curves that a transform moves or squashes stay in object space, and so does all that we are asked about.
bool must_instance(const AccelObject& object) {
    if (std::holds_alternative<SimpleShape>(object.geometry->data)) return true;
    if (const auto* points = std::get_if<PointList>(&object.geometry->data))
        if (points->mode == PointList::Mode::Quad) return true;
    return !std::holds_alternative<TriangleMesh>(object.geometry->data) &&
           (object.world_from_object.size() > 1 || even_scale(object.world_from_object[0]) == 0);
}

/// Bounds of a placed geometry over the whole shutter.
Box3f bounds_of(const AccelObject& object) {
    Box3f out;
    const auto grow = [&](Vec3f p, float radius) {
        for (const Mat4f& m : object.world_from_object) {
            // Half the edges of the box of a transformed ball.
            const auto reach = [&](int i) {
                return radius * length(Vec3f{m.vector({1, 0, 0})[i], m.vector({0, 1, 0})[i],
                                             m.vector({0, 0, 1})[i]});
            };
            const Vec3f center = m.point(p), half{reach(0), reach(1), reach(2)};
            out.grow(center - half);
            out.grow(center + half);
        }
    };
    if (const auto* mesh = std::get_if<TriangleMesh>(&object.geometry->data))
        for (const std::vector<Vec3f>& key : mesh->positions)
            for (const Vec3f p : key)
                grow(p, 0);
    if (const auto* spheres = std::get_if<SphereList>(&object.geometry->data))
        for (const std::vector<Vec3f>& key : spheres->centers)
            for (std::size_t i = 0; i < key.size(); ++i)
                grow(key[i], spheres->radii[i]);
    if (const auto* curves = std::get_if<CurveList>(&object.geometry->data))
        for (std::size_t k = 0; k < curves->points.size(); ++k)
            for (std::size_t i = 0; i < curves->points[k].size(); ++i)
                grow(curves->points[k][i], curves->radii[k][i]);
    if (const auto* points = std::get_if<PointList>(&object.geometry->data))
        for (std::size_t k = 0; k < points->centers.size(); ++k)
            for (std::size_t i = 0; i < points->index.size(); ++i) {
                const Vec3f c = points->centers[k][i];
                const FacingQuad quad = quad_of(*points, i, c, points->radii[k][i]);
                grow(c, std::hypot(quad.half_width, quad.half_height));
            }
    if (const auto* shape = std::get_if<SimpleShape>(&object.geometry->data))
        if (const Box3f box = bounds_of(*shape); !box.empty())
            for (int i = 0; i < 8; ++i)
                grow({(i & 1) != 0 ? box.upper.x : box.lower.x,
                      (i & 2) != 0 ? box.upper.y : box.lower.y,
                      (i & 4) != 0 ? box.upper.z : box.lower.z},
                     0);
    return out;
}

/// Up to 16 boxes around neighbours in a list of objects, four side by side.
class Boxes {
  public:
    explicit Boxes(std::span<const AccelObject> objects) {
        const std::size_t per_box = (objects.size() + kMost - 1) / kMost;
        for (std::size_t i = 0; i < objects.size(); i += per_box) {
            Box3f box;
            for (std::size_t k = i; k < std::min(i + per_box, objects.size()); ++k)
                box.grow(bounds_of(objects[k]));
            add(box);
        }
    }

    /// False only if the ray certainly meets none of the boxes.
    [[nodiscard]] bool may_meet(const Ray& ray) const noexcept {
        const Vec3f inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z};
        for (const Four& f : fours_) {
            Float4 near = all(ray.t_min), far = all(ray.t_max);
            for (int axis = 0; axis < 3; ++axis) {
                const Float4 a = (f.lower[axis] - ray.origin[axis]) * inverse[axis],
                             b = (f.upper[axis] - ray.origin[axis]) * inverse[axis];
                // Rays within a wall give nan: they pass beside what is in the box, which has room on all sides.
                near = larger(smaller(a, b), near);
                far = smaller(larger(b, a), far);
            }
            if (any(near <= far)) return true;
        }
        return false;
    }

  private:
    static constexpr std::size_t kMost = 16;
    /// Four boxes; missing ones repeat the others.
    struct Four {
        Float4 lower[3], upper[3];
    };

    void add(const Box3f& box) {
        constexpr float kRoom = 1e-4F;  // flat boxes get a thickness, and rounding room
        const std::size_t first = n_++ % 4;
        if (first == 0) fours_.emplace_back();
        const float room = kRoom * (length(box.size()) + max_abs(box.lower) + max_abs(box.upper));
        for (std::size_t lane = first; lane < 4; ++lane)
            for (int axis = 0; axis < 3; ++axis) {
                fours_.back().lower[axis][lane] = box.lower[axis] - room;
                fours_.back().upper[axis][lane] = box.upper[axis] + room;
            }
    }
    static float max_abs(Vec3f v) {
        return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
    }

    std::vector<Four> fours_;
    std::size_t n_ = 0;
};

/// Rays beyond kRayReach, or of something that is no number, meet nothing.
bool can_be_traced(const Ray& ray) {
    const Vec3f o = ray.origin, d = ray.direction;
    const Float4 first{o.x, o.y, o.z, d.x}, second{d.y, d.z, 0, 0};
    const Int4 within = (magnitude(first) <= kRayReach) & (magnitude(second) <= kRayReach);
    return !any(~within) && ray.t_min <= ray.t_max;
}

RTCRay to_embree(const Ray& ray, std::uint32_t mask) {
    RTCRay out;
    out.org_x = ray.origin.x;
    out.org_y = ray.origin.y;
    out.org_z = ray.origin.z;
    out.tnear = ray.t_min;
    out.dir_x = ray.direction.x;
    out.dir_y = ray.direction.y;
    out.dir_z = ray.direction.z;
    out.time = ray.time;
    out.tfar = ray.t_max;
    out.mask = mask;
    out.id = 0;
    out.flags = 0;
    return out;
}

constexpr std::uint32_t kAllBits = 0xffffffffU;

}  // namespace

struct Accel::State {
    std::atomic<std::ptrdiff_t> bytes{0};  ///< that Embree holds; outlives `device`, which counts
    DevicePtr device;
    std::map<const ShapeGeometry*, ScenePtr>
        shared;  ///< geometries that are placed more than once
    ScenePtr top;
    std::vector<std::uint32_t> object_of;  ///< by id of a top-level geometry
    std::vector<bool> is_instance;         ///< by id of a top-level geometry
    std::optional<Boxes> boxes;            ///< around objects that most rays miss
    /// Of what has an end, where something has none; else Embree knows.
    std::optional<Box3f> bounds;
    bool empty = true;

    ScenePtr new_scene() const {
        ScenePtr scene(rtcNewScene(device.get()));
        // Robust: no ray slips between neighbouring triangles.
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        return scene;
    }
    void commit(RTCScene scene) const {
        rtcCommitScene(scene);
        if (const RTCError code = rtcGetDeviceError(device.get()); code != RTC_ERROR_NONE) {
            const char* why =
                code == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory" : "the ray library refused";
            throw InputError({Code::LimitMemory,
                              std::string(why) + " while building the acceleration structure",
                              {},
                              "fewer or simpler shapes, or a machine with more memory"});
        }
    }
    /// Hands the geometry over to `scene`.
    static unsigned attach(RTCScene scene, RTCGeometry geometry, std::uint32_t mask) {
        rtcSetGeometryMask(geometry, mask);
        rtcCommitGeometry(geometry);
        const unsigned id = rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        return id;
    }
    RTCScene shared_scene(const ShapeGeometry* geometry) {
        ScenePtr& scene = shared[geometry];
        if (!scene) {
            scene = new_scene();
            const std::vector<Mat4f> identity(1);
            attach(scene.get(), std::visit(GeometryMaker(device.get(), identity), geometry->data),
                   kAllBits);
            commit(scene.get());
        }
        return scene.get();
    }
    void add_instance(std::uint32_t index, const AccelObject& object) {
        RTCGeometry g = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(g, shared_scene(object.geometry));
        const std::size_t n_keys = std::min(kMaxKeys, object.world_from_object.size());
        rtcSetGeometryTimeStepCount(g, static_cast<unsigned>(n_keys));
        for (std::size_t k = 0; k < n_keys; ++k)
            // Rows of a row-vector matrix are the columns of Embree's.
            rtcSetGeometryTransform(g, static_cast<unsigned>(k), RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                                    object.world_from_object[k].m.data());
        remember(attach(top.get(), g, object.mask), index, true);
    }
    void remember(unsigned id, std::uint32_t index, bool instance) {
        if (object_of.size() <= id) {
            object_of.resize(id + 1);
            is_instance.resize(id + 1);
        }
        object_of[id] = index;
        is_instance[id] = instance;
    }
};

Accel::Accel(std::span<const AccelObject> objects, const std::string& isa, bool sparse)
    : state_(std::make_unique<State>()) {
    State& s = *state_;
    if (sparse) s.boxes.emplace(objects);
    // Flush-to-zero is set by our own threads (core/parallel).
    const std::string config = isa.empty() ? std::string() : "isa=" + isa;
    s.device.reset(rtcNewDevice(config.empty() ? nullptr : config.c_str()));
    if (!s.device)
        throw InputError(
            {isa.empty() ? Code::LimitMemory : Code::InvalidValue,
             isa.empty()
                 ? std::string("the ray library cannot be started")
                 : "the ray library cannot be started with instruction set \"" + isa + "\"",
             {},
             "sse2, avx2 and avx512 are known; the processor must have it"});
    rtcSetDeviceMemoryMonitorFunction(
        s.device.get(),
        [](void* counter, ssize_t bytes, bool) {
            *static_cast<std::atomic<std::ptrdiff_t>*>(counter) += bytes;
            return true;
        },
        &s.bytes);
    s.top = s.new_scene();
    std::map<const ShapeGeometry*, int> uses;
    for (const AccelObject& object : objects)
        ++uses[object.geometry];
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const AccelObject& object = objects[i];
        const auto index = static_cast<std::uint32_t>(i);
        if (object.mask == 0) continue;
        s.empty = false;
        if (uses[object.geometry] > 1 || must_instance(object)) {
            s.add_instance(index, object);
        } else {
            RTCGeometry g = std::visit(GeometryMaker(s.device.get(), object.world_from_object),
                                       object.geometry->data);
            s.remember(State::attach(s.top.get(), g, object.mask), index, false);
        }
    }
    s.commit(s.top.get());
    const auto endless = [](const AccelObject& object) {
        const auto* shape = std::get_if<SimpleShape>(&object.geometry->data);
        return shape != nullptr && shape->kind == SimpleShape::Kind::Plane;
    };
    if (std::none_of(objects.begin(), objects.end(), endless)) return;
    s.bounds.emplace();
    for (const AccelObject& object : objects)
        if (object.mask != 0) s.bounds->grow(bounds_of(object));
}

Accel::~Accel() = default;

std::size_t Accel::memory() const {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(state_->bytes, 0));
}

bool Accel::intersect(const Ray& ray, std::uint32_t mask, RayHit& hit) const noexcept {
    if (!can_be_traced(ray)) return false;
    if (state_->boxes && !state_->boxes->may_meet(ray)) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r;
    r.ray = to_embree(ray, mask);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->top.get(), &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    const unsigned id =
        r.hit.instID[0] != RTC_INVALID_GEOMETRY_ID ? r.hit.instID[0] : r.hit.geomID;
    hit = {r.ray.tfar, state_->object_of[id], r.hit.primID, {r.hit.u, r.hit.v}};
    return true;
}

bool Accel::occluded(const Ray& ray, std::uint32_t mask) const noexcept {
    if (!can_be_traced(ray)) return false;
    if (state_->boxes && !state_->boxes->may_meet(ray)) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay r = to_embree(ray, mask);
    rtcOccluded1(state_->top.get(), &context, &r);
    return r.tfar < 0;
}

Box3f Accel::bounds() const {
    if (state_->empty) return {};
    if (state_->bounds) return *state_->bounds;
    RTCBounds b;
    rtcGetSceneBounds(state_->top.get(), &b);
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

bool Accel::empty() const { return state_->empty; }

}  // namespace lightsieve
