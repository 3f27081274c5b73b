#include "render/shade_services.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "render/surface.h"
#include "scene/mesh_origin.h"

namespace lightsieve {
namespace {

/// Surfaces that a probe passes because they are not meant.
constexpr int kMaxPassed = 256;

const SceneObject& object_of(const ShadePoint& at) {
    return *static_cast<const SceneObject*>(at.shape);
}

/// Value number `i` of user data as numbers.
ShaderValue number_at(const UserData& data, std::size_t i) {
    const auto load = [&]<class T>(T) { return static_cast<const T*>(data.data)[i]; };
    const auto one = [](float v) { return ShaderValue{Color::grey(v), 1}; };
    switch (data.type) {
        case ParamType::Bool: return one(load(bool{}) ? 1.0F : 0.0F);
        case ParamType::Byte: return one(static_cast<float>(load(std::uint8_t{})));
        case ParamType::Int: return one(static_cast<float>(load(std::int32_t{})));
        case ParamType::UInt: return one(static_cast<float>(load(std::uint32_t{})));
        case ParamType::Float: return one(load(float{}));
        case ParamType::Rgb: return {load(Color{}), 1};
        case ParamType::Rgba: return load(Rgba{});
        case ParamType::Vector: {
            const Vec3f v = load(Vec3f{});
            return {{v.x, v.y, v.z}, 1};
        }
        case ParamType::Vector2: {
            const Vec2f v = load(Vec2f{});
            return {{v.x, v.y, 0}, 1};
        }
        default: return {kBlack, 1};
    }
}

bool is_number(ParamType type) {
    return type != ParamType::String && type != ParamType::Matrix && type != ParamType::Node &&
           type != ParamType::Closure;
}

/// Whether a probe with a trace set meets an object (see Probe::inclusive).
bool in_trace_set(const SceneObject& object, const Probe& probe) {
    if (probe.trace_set.empty()) return true;
    const Array<Name>* sets = nullptr;
    for (auto step = object.lineage->rbegin(); step != object.lineage->rend(); ++step) {
        sets = &step->node->type().shape_common(step->node->block())->trace_sets;
        if (!sets->empty()) break;
    }
    if (sets == nullptr || sets->empty()) return true;
    const auto all = sets->first_key();
    const bool tagged = std::find(all.begin(), all.end(), probe.trace_set) != all.end();
    return tagged == probe.inclusive;
}

}  // namespace

/// User data that shows at a point, and the node that carries it.
struct SceneServices::Found {
    const UserData* data = nullptr;
    const NodeInstance* node = nullptr;
    std::size_t element = 0;  ///< of constant data: which of its values
};

/// The values that meet at a point, and their shares.
struct SceneServices::Spot {
    /// One place.
    struct Part {
        std::size_t index = 0;
        float weight = 1;
    };
    /// Up to three corners of a triangle. Of subdivided meshes: the corners of the face, which may be many; then `mesh` is
    /// set, and for_each asks it.
    std::array<Part, 3> parts{};
    std::size_t n = 1;
    const TriangleMesh* mesh = nullptr;
    std::size_t triangle = 0;
    std::array<float, 3> weights{};
    const UserData* data = nullptr;  ///< of a subdivided mesh

    /// Calls `body(index, weight)` for every value.
    template <class Body>
    void for_each(const Body& body) const {
        if (mesh == nullptr) {
            for (std::size_t i = 0; i < n; ++i)
                body(parts[i].index, parts[i].weight);
            return;
        }
        const MeshOrigin& origin = *mesh->origin;
        for_each_share(origin, triangle, weights, [&](std::size_t slot, float share) {
            body(data->user_class == UserDataClass::Varying ? std::size_t{origin.vertex[slot]}
                                                            : at_corner(origin.corner[slot]),
                 share);
        });
    }

  private:
    [[nodiscard]] std::size_t at_corner(std::size_t corner) const {
        return corner < data->indices.n ? data->indices[corner] : data->n;
    }
};

void SceneServices::prepare(const NodeInstance& shape) {
    const auto* counts = shape.find<Array<std::uint32_t>>("num_points");
    const auto data = shape.user_data();
    const bool varying = std::any_of(data.begin(), data.end(), [](const UserData& d) {
        return d.user_class == UserDataClass::Varying;
    });
    if (counts == nullptr || counts->n < 2 || !varying) return;
    std::vector<std::uint32_t>& starts = curve_starts_[&shape];
    starts.push_back(0);
    for (const std::uint32_t n : counts->first_key())
        starts.push_back(starts.back() + n);
}

SceneServices::Found SceneServices::find(const ShadePoint& at, Name name) const {
    const SceneObject& object = object_of(at);
    // A volume without a shape (the atmosphere) has none.
    if (object.lineage == nullptr) return {};
    for (std::size_t i = object.lineage->size(); i-- > 0;) {
        const LineageStep& step = (*object.lineage)[i];
        for (const auto& [shown, data] : step.by_instance)
            if (shown == name)
                return {
                    data, step.node,
                    std::min<std::size_t>(object.instance / step.stride % step.n, data->n - 1)};
        const UserData* data = step.node->find_user_data(name);
        // Only what is the same everywhere can be given to an instance.
        const bool fits = data != nullptr && data->n > 0 && data->data != nullptr &&
                          (i == 0 || data->user_class == UserDataClass::Constant);
        if (fits) return {data, step.node, 0};
    }
    return {};
}

/// Values and shares at a point; false if the data does not fit the geometry.
bool SceneServices::spot_of(const ShadePoint& at, const Found& found, Spot& out) const {
    const UserData& data = *found.data;
    const ShapeGeometry& geometry = *object_of(at).geometry;
    const auto* mesh = std::get_if<TriangleMesh>(&geometry.data);
    const auto* curves = std::get_if<CurveList>(&geometry.data);
    out = {};
    switch (data.user_class) {
        case UserDataClass::Constant: out.parts[0].index = found.element; break;
        case UserDataClass::Uniform: out.parts[0].index = at.face; break;
        case UserDataClass::Varying:
        case UserDataClass::Indexed: {
            if (curves != nullptr) {
                // Values stand along the curve, as control points do.
                const auto starts = curve_starts_.find(found.node);
                const auto* counts = found.node->find<Array<std::uint32_t>>("num_points");
                std::size_t first = 0, n = data.n;
                if (starts != curve_starts_.end() && at.face + 1 < starts->second.size()) {
                    first = starts->second[at.face];
                    n = starts->second[at.face + 1] - first;
                } else if (counts != nullptr && counts->n == 1) {
                    n = (*counts)[0];
                    first = n * at.face;
                }
                if (n == 0) return false;
                const float place =
                    std::clamp(at.curve_uv.y, 0.0F, 1.0F) * static_cast<float>(n - 1);
                const auto i = std::min(static_cast<std::size_t>(place), n > 1 ? n - 2 : 0);
                const float f = place - static_cast<float>(i);
                out.parts[0] = {first + i, 1 - f};
                out.parts[1] = {first + std::min(i + 1, n - 1), f};
                out.n = 2;
                break;
            }
            if (mesh == nullptr) {
                out.parts[0].index = at.face;
                break;
            }
            const Vec2f b = at.barycentric;
            const std::array<float, 3> weights{1 - b.x - b.y, b.x, b.y};
            if (mesh->origin) {
                out.mesh = mesh;
                out.triangle = at.primitive;
                out.weights = weights;
                out.data = &data;
                break;
            }
            const std::vector<std::uint32_t>& corners =
                data.user_class == UserDataClass::Varying ? mesh->indices : mesh->corner;
            const std::size_t t = std::size_t{at.primitive} * 3;
            if (t + 2 >= corners.size()) return false;
            for (std::size_t i = 0; i < 3; ++i) {
                std::size_t& index = out.parts[i].index;
                index = corners[t + i];
                out.parts[i].weight = weights[i];
                if (data.user_class != UserDataClass::Indexed) continue;
                if (index >= data.indices.n) return false;
                index = data.indices[index];
            }
            out.n = 3;
            break;
        }
    }
    bool fits = true;
    out.for_each([&](std::size_t i, float) { fits &= i < data.n; });
    return fits;
}

bool SceneServices::user_value(const ShadePoint& at, Name name, ShaderValue& out) const {
    const Found found = find(at, name);
    Spot spot;
    if (found.data == nullptr || !is_number(found.data->type) || !spot_of(at, found, spot))
        return false;
    out = {kBlack, 0};
    spot.for_each([&](std::size_t i, float weight) {
        const ShaderValue v = number_at(*found.data, i);
        out.rgb += v.rgb * weight;
        out.a += v.a * weight;
    });
    return true;
}

bool SceneServices::user_text(const ShadePoint& at, Name name, Name& out) const {
    const Found found = find(at, name);
    Spot spot;
    if (found.data == nullptr || found.data->type != ParamType::String ||
        !spot_of(at, found, spot))
        return false;
    std::size_t index = 0;
    float most = -1;
    spot.for_each([&](std::size_t i, float weight) {
        if (weight > most) index = i;
        most = std::max(most, weight);
    });
    out = static_cast<const Name*>(found.data->data)[index];
    return true;
}

bool SceneServices::uv_set(const ShadePoint& at, Name name, UvPoint& out) const {
    const Found found = find(at, name);
    Spot spot;
    if (found.data == nullptr || found.data->type != ParamType::Vector2 ||
        !spot_of(at, found, spot))
        return false;
    const auto blend = [&](const Spot& where) {
        const auto* values = static_cast<const Vec2f*>(found.data->data);
        Vec2f sum;
        where.for_each([&](std::size_t i, float weight) { sum = sum + values[i] * weight; });
        return sum;
    };
    out = {};
    out.uv = blend(spot);
    Triangle corners;
    if ((spot.n != 3 && spot.mesh == nullptr) || !triangle(at, corners)) return true;
    std::array<Vec2f, 3> uv;
    for (std::size_t i = 0; i < 3; ++i) {
        Spot corner = spot;
        corner.weights = {};
        corner.weights[i] = 1;
        for (std::size_t k = 0; k < 3; ++k)
            corner.parts[k].weight = k == i ? 1.0F : 0.0F;
        uv[i] = blend(corner);
    }
    // As for the first set: both derivatives from the corners.
    const Vec3f e1 = corners.corners[1] - corners.corners[0],
                e2 = corners.corners[2] - corners.corners[0];
    const Vec2f d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    const float det = d1.x * d2.y - d1.y * d2.x, twice_area = length(cross(e1, e2));
    if (det == 0 || !(twice_area > 0)) return true;
    out.dp_du = (e1 * d2.y - e2 * d1.y) / det;
    out.dp_dv = (e2 * d1.x - e1 * d2.x) / det;
    constexpr float kLeastCosine = 0.1F;  // as for the first set
    const float cosine = std::max(kLeastCosine, std::abs(dot(at.geometric_normal, at.wo)));
    out.width = std::sqrt(std::abs(det) / twice_area) * at.width / cosine;
    return true;
}

Mat4f SceneServices::world_from_object(const ShadePoint& at) const {
    return placement_at(object_of(at), at.time);
}

Mat4f SceneServices::object_from_world(const ShadePoint& at) const {
    const SceneObject& object = object_of(at);
    return object.object_from_world.size() == 1 ? object.object_from_world[0]
                                                : placement_at(object, at.time).inverse();
}

bool SceneServices::triangle(const ShadePoint& at, Triangle& out) const {
    const SceneObject& object = object_of(at);
    const auto* mesh = std::get_if<TriangleMesh>(&object.geometry->data);
    if (mesh == nullptr) return false;
    out = {};
    const Mat4f place = placement_at(object, at.time);
    const std::array<Vec3f, 3> local = triangle_corners(*mesh, at.primitive, at.time);
    for (std::size_t i = 0; i < 3; ++i)
        out.corners[i] = place.point(local[i]);
    if (mesh->origin) {
        // Quads: the edge that their two triangles share is none of theirs.
        out.polygon_edge[at.primitive % 2 == 0 ? 2 : 0] = false;
        return true;
    }
    const std::size_t t = std::size_t{at.primitive} * 3;
    if (mesh->face.empty() || t + 2 >= mesh->corner.size()) return true;
    // The polygon's corners, from all of its triangles, which stand together.
    std::uint32_t first = UINT32_MAX, last = 0;
    const auto widen = [&](std::size_t triangle) {
        for (std::size_t i = 0; i < 3; ++i) {
            first = std::min(first, mesh->corner[triangle * 3 + i]);
            last = std::max(last, mesh->corner[triangle * 3 + i]);
        }
    };
    for (std::size_t i = at.primitive; i < mesh->face.size() && mesh->face[i] == at.face; ++i)
        widen(i);
    for (std::size_t i = at.primitive; i-- > 0 && mesh->face[i] == at.face;)
        widen(i);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = mesh->corner[t + i], b = mesh->corner[t + (i + 1) % 3];
        const auto [low, high] = std::minmax(a, b);
        out.polygon_edge[i] = high - low == 1 || (low == first && high == last);
    }
    return true;
}

Name SceneServices::shape_name(const ShadePoint& at) const { return object_of(at).name; }

Name SceneServices::material_name(const ShadePoint& at) const {
    const SceneObject& object = object_of(at);
    const auto* mesh =
        object.geometry == nullptr ? nullptr : std::get_if<TriangleMesh>(&object.geometry->data);
    std::size_t index = 0;
    if (mesh != nullptr && at.primitive < mesh->shader_index.size())
        index = mesh->shader_index[at.primitive];
    return object.shaders[std::min(index, object.shaders.size() - 1)]->name;
}

std::vector<Name> SceneServices::user_values(const ShadePoint& at, Name name) const {
    const Found found = find(at, name);
    std::vector<Name> out;
    if (found.data == nullptr) return out;
    const UserData& data = *found.data;
    const auto add = [&](std::size_t i) {
        if (data.type == ParamType::String)
            out.push_back(static_cast<const Name*>(data.data)[i]);
        else if (data.type == ParamType::Int || data.type == ParamType::UInt ||
                 data.type == ParamType::Byte)
            out.emplace_back(std::to_string(std::lround(number_at(data, i).rgb.r)));
    };
    if (data.user_class == UserDataClass::Constant) {
        add(found.element);
        return out;
    }
    for (std::size_t i = 0; i < data.n; ++i)
        add(i);
    return out;
}

std::int32_t SceneServices::n_lights() const {
    return static_cast<std::int32_t>(scene_.lights.size());
}

bool SceneServices::trace(const ShadePoint& at, const Probe& probe, ProbeHit& out) const {
    Ray ray{probe.origin, probe.direction, probe.t_min, probe.t_max, at.time};
    for (int passed = 0; passed < kMaxPassed; ++passed) {
        RayHit hit;
        if (!scene_.accel->intersect(ray, ray_bit(RayType::DiffuseReflect), hit)) return false;
        const SceneObject& object = scene_.objects[hit.object];
        const bool same = &object == at.shape;
        if ((same || !probe.self_only) && in_trace_set(object, probe)) {
            const Surface surface = make_surface(object, ray, hit, {});
            const Vec3f geometric = surface.at.geometric_normal;
            const Vec3f normal = surface.at.normal;
            out = {hit.t, surface.at.position, geometric,
                   dot(normal, geometric) < 0 ? -normal : normal, same};
            return true;
        }
        ray.t_min = std::nextafter(hit.t, kInfinity);
    }
    return false;
}

}  // namespace lightsieve
