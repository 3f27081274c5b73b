#include "render/displacement.h"

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/parallel.h"
#include "render/shader_program.h"

namespace lightsieve {
namespace {

/// Normals at the vertices: those of the triangles around, by area.
std::vector<Vec3f> averaged_normals(const std::vector<Vec3f>& p,
                                    const std::vector<std::uint32_t>& indices) {
    std::vector<Vec3f> out(p.size());
    for (std::size_t t = 0; t < indices.size(); t += 3) {
        const std::uint32_t a = indices[t], b = indices[t + 1], c = indices[t + 2];
        const Vec3f n = cross(p[b] - p[a], p[c] - p[a]);
        out[a] += n;
        out[b] += n;
        out[c] += n;
    }
    for (Vec3f& n : out)
        n = normalize(n);
    return out;
}

void give_averaged_normals(TriangleMesh& mesh) {
    mesh.normals.clear();
    for (const std::vector<Vec3f>& key : mesh.positions)
        mesh.normals.push_back(averaged_normals(key, mesh.indices));
    mesh.normal_indices = mesh.indices;
}

bool is_vector(const ShaderProgram& program) {
    return program.type().output == OutputType::Vector;
}

constexpr std::array<Vec2f, 3> kCorners{{{0, 0}, {1, 0}, {0, 1}}};

template <class T>
T blend(const std::vector<T>& values, const std::vector<std::uint32_t>& indices, std::size_t t,
        Vec2f b) {
    return values[indices[t]] * (1 - b.x - b.y) + values[indices[t + 1]] * b.x +
           values[indices[t + 2]] * b.y;
}

}  // namespace

DisplacementMap::DisplacementMap(TriangleMesh rest, std::vector<const ShaderProgram*> programs,
                                 const SceneObject& object)
    : had_normals_(!rest.normals.empty()),
      settings_(rest.displacement.value_or(Displacement{})),
      programs_(std::move(programs)) {
    // One normal a vertex, so that what the vertices' triangles share moves together.
    if (rest.normals.empty() || rest.normal_indices != rest.indices) give_averaged_normals(rest);
    rest_.data = std::move(rest);
    in_world_.geometry = in_object_.geometry = &rest_;
    in_world_.lineage = in_object_.lineage = object.lineage;
    in_world_.name = in_object_.name = object.name;
    in_world_.services = in_object_.services = object.services;
    in_world_.id = in_object_.id = object.id;
    in_world_.world_from_object = object.world_from_object.first(1);
    in_world_.object_from_world = object.object_from_world.first(1);
    static const Mat4f kIdentity;
    in_object_.world_from_object = in_object_.object_from_world = {&kIdentity, 1};
    in_world_.shaders = in_object_.shaders = programs_;
}

const TriangleMesh& DisplacementMap::mesh() const { return std::get<TriangleMesh>(rest_.data); }

const ShaderProgram* DisplacementMap::program(std::uint32_t triangle) const {
    const auto& index = mesh().shader_index;
    return programs_[std::min<std::size_t>(index.empty() ? 0 : index[triangle],
                                           programs_.size() - 1)];
}

Vec3f DisplacementMap::offset(const RestPoint& point) const {
    const ShaderProgram* shader = program(point.triangle);
    if (shader == nullptr) return {};
    const TriangleMesh& m = mesh();
    const std::size_t t = std::size_t{point.triangle} * 3;
    const Vec3f normal = normalize(blend(m.normals[0], m.normal_indices, t, point.barycentric));
    const bool vector = is_vector(*shader);
    const SceneObject& object = vector ? in_object_ : in_world_;
    // Looked at straight from above.
    const Vec3f above = normalize(object.object_from_world[0].normal_by_inverse(normal), normal);
    const Vec3f place =
        object.world_from_object[0].point(blend(m.positions[0], m.indices, t, point.barycentric));
    const float scale = length(object.world_from_object[0].vector(normal));
    RayHit hit;
    hit.t = 1;
    hit.primitive = point.triangle;
    hit.barycentric = point.barycentric;
    Surface surface = make_surface(object, {place + above, -above, 0, kInfinity, 0}, hit,
                                   {point.width * scale, 0});
    surface.at.normal = above;
    const ShaderValue v = shader->value(surface.at);
    const Vec3f zero = Vec3f{1, 1, 1} * settings_.zero_value;
    const Vec3f moved =
        vector ? (Vec3f{v.rgb.r, v.rgb.g, v.rgb.b} - zero) * settings_.height
               : normal * ((average(v.rgb) - settings_.zero_value) * settings_.height);
    return is_finite(moved) ? moved : Vec3f{};
}

std::vector<Vec3f> DisplacementMap::vertex_offsets() const {
    // Where texture coordinates have a seam, a vertex is asked for on each side: the mean keeps the surface closed.
    const TriangleMesh& m = mesh();
    const std::size_t n = m.positions[0].size();
    constexpr std::uint32_t kNone = UINT32_MAX;
    std::vector<std::uint32_t> corner_of(n, kNone), count(n, 0);
    std::vector<std::uint32_t> asked;  // triangle corners
    std::set<std::pair<std::uint32_t, std::uint32_t>> seams;
    const auto uv = [&](std::size_t corner) {
        return m.uv_indices.empty() ? 0U : m.uv_indices[corner];
    };
    for (std::size_t c = 0; c < m.indices.size(); ++c) {
        const std::uint32_t v = m.indices[c];
        const bool first = corner_of[v] == kNone;
        if (!first && (uv(corner_of[v]) == uv(c) || !seams.insert({v, uv(c)}).second)) continue;
        if (first) corner_of[v] = static_cast<std::uint32_t>(c);
        asked.push_back(static_cast<std::uint32_t>(c));
        ++count[v];
    }
    std::vector<Vec3f> answers(asked.size());
    constexpr std::size_t kBlock = 1024;
    parallel_for((asked.size() + kBlock - 1) / kBlock, 0, [&](std::size_t block) {
        const std::size_t end = std::min(asked.size(), (block + 1) * kBlock);
        for (std::size_t i = block * kBlock; i < end; ++i) {
            const std::size_t t = asked[i] / 3 * 3;
            const Vec3f edge = m.positions[0][m.indices[t + 1]] - m.positions[0][m.indices[t]];
            answers[i] = offset({asked[i] / 3, kCorners[asked[i] % 3], length(edge)});
        }
    });
    std::vector<Vec3f> out(n);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const std::uint32_t v = m.indices[asked[i]];
        out[v] += answers[i] / static_cast<float>(count[v]);
    }
    return out;
}

TriangleMesh DisplacementMap::displaced() const {
    const TriangleMesh& rest = mesh();
    TriangleMesh out = rest;
    const std::vector<Vec3f> offsets = vertex_offsets();
    for (std::size_t k = 0; k < out.positions.size(); ++k) {
        const std::vector<Vec3f>&first = rest.normals[0],
              &now = rest.normals[std::min(k, rest.normals.size() - 1)];
        for (std::size_t i = 0; i < offsets.size(); ++i) {
            // What stands along the normal turns with it from key to key.
            const float along = dot(offsets[i], first[i]);
            const Vec3f across = offsets[i] - first[i] * along;
            out.positions[k][i] += across + now[i] * along;
        }
    }
    if (had_normals_) {
        give_averaged_normals(out);
    } else {
        out.normals.clear();
        out.normal_indices.clear();
    }
    return out;
}

void DisplacementMap::bump(Surface& surface) const {
    if ((settings_.autobump_visibility & ray_bit(surface.at.ray_type)) == 0) return;
    const std::uint32_t triangle = surface.at.primitive;
    if (program(triangle) == nullptr) return;
    const TriangleMesh& m = mesh();
    const std::size_t t = std::size_t{triangle} * 3;
    const auto corner = [&](std::size_t i) { return m.positions[0][m.indices[t + i]]; };
    const Vec3f e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
    const float longest = std::sqrt(std::max(length_squared(e1), length_squared(e2)));

    // Steps along both edges, of about the width of what the ray sees, so that finer detail is filtered.
    constexpr float kSmallest =
        1e-3F;  // of an edge: rounding of coordinates stays small beside it
    const Mat4f& to_object = surface.object->object_from_world[0];
    const float width = length(to_object.vector(surface.frame.x)) * surface.at.width;
    const float step = std::max(kSmallest, longest > 0 ? 0.5F * width / longest : 0);
    const Vec2f here = surface.at.barycentric;
    // The edges lie in the triangle; laid across the smooth normal they are those of the smooth surface.
    const Vec3f flat = cross(e1, e2);
    const Vec3f rest = normalize(
        had_normals_ ? blend(m.normals[0], m.normal_indices, t, here) : flat, normalize(flat));
    const Vec3f offset_here = offset({triangle, here, width});
    const auto slope = [&](Vec3f edge, Vec2f by) {
        return (edge - rest * dot(edge, rest)) * step + offset({triangle, here + by, width}) -
               offset_here;
    };
    const Vec3f across = cross(slope(e1, {step, 0}), slope(e2, {0, step}));
    const Vec3f turned = normalize(to_object.normal_by_inverse(across), {});
    if (turned == Vec3f{}) return;

    // To the side that is seen, and not below its horizon.
    const Vec3f wo = surface.at.wo;
    Vec3f normal = dot(turned, surface.outward) < 0 ? -turned : turned;
    if (const float away = dot(normal, wo); away < 0)
        normal = normalize(normal - wo * away, normal);
    surface.at.normal = normal;
    surface.frame = Frame::from_z_x(normal, surface.frame.x);
    surface.at.tangent = surface.frame.x;
}

}  // namespace lightsieve
