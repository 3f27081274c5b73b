#include "render/accel.h"

#include <embree3/rtcore.h>

#include <cstring>
#include <map>

#include "core/error.h"

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
    const char* why = code == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory" : "the ray library refused";
    throw InputError({Code::LimitMemory, std::string(why) + " while " + doing, {}, "fewer or simpler shapes, or a machine with more memory"});
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

constexpr std::size_t kMaxKeys = RTC_MAX_TIME_STEP_COUNT;

/// Makes one Embree geometry; positions are transformed by `placement` (identity inside an instanced scene).
class GeometryMaker {
  public:
    GeometryMaker(RTCDevice device, std::span<const Mat4f> placement) : device_(device), placement_(placement) {}

    RTCGeometry operator()(const TriangleMesh& mesh) const {
        RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        const std::size_t n_keys = std::min(kMaxKeys, std::max(mesh.positions.size(), placement_.size()));
        rtcSetGeometryTimeStepCount(g, static_cast<unsigned>(n_keys));
        const std::size_t n = mesh.positions[0].size();
        for (std::size_t k = 0; k < n_keys; ++k) {
            auto* out = static_cast<float*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(k), RTC_FORMAT_FLOAT3, 3 * sizeof(float), n));
            if (out == nullptr) fail(device_, "storing a mesh");
            const float time = n_keys == 1 ? 0 : static_cast<float>(k) / static_cast<float>(n_keys - 1);
            const Mat4f to_world = placement_at(placement_, time);
            for (std::size_t i = 0; i < n; ++i) {
                const Vec3f p = to_world.point(position_at(mesh.positions, i, time));
                std::memcpy(out + 3 * i, &p, sizeof(p));
            }
        }
        auto* index = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
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
            auto* out = static_cast<float*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(k), RTC_FORMAT_FLOAT4, 4 * sizeof(float), n));
            if (out == nullptr) fail(device_, "storing spheres");
            for (std::size_t i = 0; i < n; ++i) {
                const Vec3f c = spheres.centers[k][i];
                const std::array<float, 4> v{c.x, c.y, c.z, spheres.radii[i]};
                std::memcpy(out + 4 * i, v.data(), sizeof(v));
            }
        }
        return g;
    }

  private:
    RTCDevice device_;
    std::span<const Mat4f> placement_;
};

/// Spheres stay in object space: a transform may squash them.
bool must_instance(const AccelObject& object) { return std::holds_alternative<SphereList>(object.geometry->data); }

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
    DevicePtr device;
    std::map<const ShapeGeometry*, ScenePtr> shared;  ///< geometries that are placed more than once
    ScenePtr top;
    std::vector<std::uint32_t> object_of;             ///< by id of a top-level geometry
    std::vector<bool> is_instance;                    ///< by id of a top-level geometry
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
            const char* why = code == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory" : "the ray library refused";
            throw InputError({Code::LimitMemory, std::string(why) + " while building the acceleration structure", {}, "fewer or simpler shapes, or a machine with more memory"});
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
            attach(scene.get(), std::visit(GeometryMaker(device.get(), identity), geometry->data), kAllBits);
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
            rtcSetGeometryTransform(g, static_cast<unsigned>(k), RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, object.world_from_object[k].m.data());
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

Accel::Accel(std::span<const AccelObject> objects, const std::string& isa) : state_(std::make_unique<State>()) {
    State& s = *state_;
    // Flush-to-zero is set by our own threads (core/parallel).
    const std::string config = isa.empty() ? std::string() : "isa=" + isa;
    s.device.reset(rtcNewDevice(config.empty() ? nullptr : config.c_str()));
    if (!s.device) throw InputError({Code::LimitMemory, "the ray library cannot be started with instruction set \"" + isa + "\"", {}, "sse2, avx2 and avx512 are known; the processor must have it"});
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
            RTCGeometry g = std::visit(GeometryMaker(s.device.get(), object.world_from_object), object.geometry->data);
            s.remember(State::attach(s.top.get(), g, object.mask), index, false);
        }
    }
    s.commit(s.top.get());
}

Accel::~Accel() = default;

bool Accel::intersect(const Ray& ray, std::uint32_t mask, RayHit& hit) const noexcept {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r;
    r.ray = to_embree(ray, mask);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->top.get(), &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    const unsigned id = r.hit.instID[0] != RTC_INVALID_GEOMETRY_ID ? r.hit.instID[0] : r.hit.geomID;
    hit = {r.ray.tfar, state_->object_of[id], r.hit.primID, {r.hit.u, r.hit.v}};
    return true;
}

bool Accel::occluded(const Ray& ray, std::uint32_t mask) const noexcept {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay r = to_embree(ray, mask);
    rtcOccluded1(state_->top.get(), &context, &r);
    return r.tfar < 0;
}

Box3f Accel::bounds() const {
    if (state_->empty) return {};
    RTCBounds b;
    rtcGetSceneBounds(state_->top.get(), &b);
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

bool Accel::empty() const { return state_->empty; }

}  // namespace lightsieve
