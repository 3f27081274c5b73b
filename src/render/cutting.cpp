#include "render/cutting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "render/shader_program.h"
#include "render/surface.h"
#include "scene/graph.h"

namespace lightsieve {
namespace {

/// Along no axis and no diagonal: modelled faces seldom hold it, so rays along it do not run in them.
const Vec3f kProbe = normalize(Vec3f{0.5377F, 0.6113F, 0.5806F}, {0, 0, 1});
/// Surfaces that one probe counts.
constexpr int kMaxCrossings = 256;
/// Shapes that a probe may be inside of at once.
constexpr std::size_t kMaxInside = 16;
constexpr std::uint32_t kAllRays = 0xffffffffU;

/// The least distance along a ray beyond `t`. Embree takes denormal numbers for 0.
float just_beyond(float t) {
    return std::max(std::nextafter(t, kInfinity), std::numeric_limits<float>::min());
}

const ShaderProgram* cutting_shader(const SceneObject& object) {
    static const Name kClipGeo("clip_geo");
    const ShaderProgram* shader = object.shaders[0];
    return shader->type().name == kClipGeo ? shader : nullptr;
}

/// Whether a shape, or what it was placed by, carries a trace set.
bool carries(const SceneObject& object, Name set) {
    if (object.lineage == nullptr) return false;
    return std::any_of(object.lineage->begin(), object.lineage->end(), [&](const auto& step) {
        const auto sets =
            step.node->type().shape_common(step.node->block())->trace_sets.first_key();
        return std::find(sets.begin(), sets.end(), set) != sets.end();
    });
}

/// Whether a shape parts the space into an inside and an outside.
bool has_inside(const SceneObject& object) {
    const auto& data = object.geometry->data;
    return std::holds_alternative<TriangleMesh>(data) || std::holds_alternative<SphereList>(data);
}

bool inside_of(const Cutter& cutter, Vec3f p, float time) {
    Ray ray{p, kProbe, 0, kInfinity, time};
    bool inside = false;
    RayHit hit;
    for (int i = 0; i < kMaxCrossings && cutter.boundary->intersect(ray, kAllRays, hit); ++i) {
        inside = !inside;
        ray.t_min = just_beyond(hit.t);
    }
    return inside;
}

/// Whether a point lies in something that the cutter cuts.
bool in_something_cut(const Cutter& cutter, Vec3f p, float time, const Accel& accel,
                      const std::vector<SceneObject>& objects) {
    Ray ray{p, kProbe, 0, kInfinity, time};
    std::array<std::uint32_t, kMaxInside> crossed{};
    std::size_t n = 0;  // of those that were crossed an odd number of times
    RayHit hit;
    for (int i = 0; i < kMaxCrossings && accel.intersect(ray, kAllRays, hit); ++i) {
        ray.t_min = just_beyond(hit.t);
        const SceneObject& object = objects[hit.object];
        if (!object.is_cut || object.cutter != nullptr || !has_inside(object) ||
            !cutter.cuts(object))
            continue;
        const auto end = crossed.begin() + static_cast<std::ptrdiff_t>(n);
        if (const auto known = std::find(crossed.begin(), end, hit.object); known != end)
            *known = crossed[--n];
        else if (n < kMaxInside)
            crossed[n++] = hit.object;
    }
    return n > 0;
}

}  // namespace

bool Cutter::cuts(const SceneObject& object) const {
    return trace_set.empty() || carries(object, trace_set) == inclusive;
}

void Cutters::find(std::vector<SceneObject>& objects, const std::string& isa) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        SceneObject& object = objects[i];
        const ShaderProgram* shader = cutting_shader(object);
        if (shader == nullptr) continue;
        own.push_back(i);
        Cutter& cutter = cutters_.emplace_back();
        const auto parameter = [&]<class T>(const char* name, T fallback) {
            const ParamInfo* info = shader->type().find(name);
            return info == nullptr ? fallback
                                   : *reinterpret_cast<const T*>(shader->block() + info->offset);
        };
        cutter.trace_set = parameter("trace_set", Name{});
        cutter.inclusive = parameter("inclusive", true);
        cutter.has_face = !shader->parts.empty();
        const AccelObject boundary{object.geometry, object.world_from_object, kAllRays};
        cutter.boundary = std::make_unique<Accel>(std::span(&boundary, 1), isa);
    }
    if (cutters_.empty()) return;
    for (std::size_t i = 0; i < own.size(); ++i)
        objects[own[i]].cutter = &cutters_[i];
    for (SceneObject& object : objects) {
        object.is_cut = object.cutter != nullptr ||
                        std::any_of(cutters_.begin(), cutters_.end(),
                                    [&](const Cutter& cutter) { return cutter.cuts(object); });
        // Rays may pass it, so every hit is looked at.
        object.may_be_transparent |= object.is_cut;
    }
}

bool Cutters::is_there(const Surface& surface, const Accel& accel,
                       const std::vector<SceneObject>& objects) const {
    const SceneObject& object = *surface.object;
    const Vec3f p = surface.at.position;
    const float time = surface.at.time;
    if (object.cutter != nullptr)
        return object.cutter->has_face &&
               in_something_cut(*object.cutter, p, time, accel, objects);
    return std::none_of(cutters_.begin(), cutters_.end(), [&](const Cutter& cutter) {
        return cutter.cuts(object) && inside_of(cutter, p, time);
    });
}

}  // namespace lightsieve
