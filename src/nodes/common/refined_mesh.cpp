#include "nodes/common/refined_mesh.h"

#include <algorithm>
#include <cmath>

#include "scene/mesh_origin.h"

namespace lightsieve {
namespace {

std::vector<std::uint32_t> triangles_of(const std::vector<std::uint32_t>& quads) {
    std::vector<std::uint32_t> out;
    out.reserve(quads.size() / 4 * 6);
    for (std::size_t q = 0; q < quads.size(); q += 4)
        for (const std::size_t corner : {0, 1, 2, 0, 2, 3})
            out.push_back(quads[q + corner]);
    return out;
}

/// The node's own normals, blended linearly: one for each corner of each triangle.
void keep_normals(const RefinedMeshInput& input, TriangleMesh& mesh) {
    const MeshOrigin& origin = *mesh.origin;
    const std::size_t n = mesh.indices.size();
    for (const std::span<const Vec3f> key : input.normals) {
        std::vector<Vec3f>& out = mesh.normals.emplace_back(n);
        for (std::size_t i = 0; i < n; ++i) {
            std::array<float, 3> at{};
            at[i % 3] = 1;
            Vec3f sum;
            for_each_share(origin, i / 3, at, [&](std::size_t slot, float share) {
                sum += key[input.normal_of_corner[origin.corner[slot]]] * share;
            });
            out[i] = normalize(sum, {});
        }
    }
    mesh.normal_indices.resize(n);
    for (std::size_t i = 0; i < n; ++i)
        mesh.normal_indices[i] = static_cast<std::uint32_t>(i);
}

/// Largest size that `size(a, b)` gives for an edge of the cage.
template <class Size>
float largest_over_edges(const SubdivisionCage& cage, const Size& size) {
    float out = 0;
    for (std::size_t f = 0; f + 1 < cage.first_corner.size(); ++f) {
        const std::size_t begin = cage.first_corner[f], end = cage.first_corner[f + 1];
        for (std::size_t i = begin; i < end; ++i)
            out = std::max(out, size(cage.vertex[i], cage.vertex[i + 1 < end ? i + 1 : begin]));
    }
    return out;
}

/// Distance of each vertex from the middle of its neighbours: about what it has to move to the limit surface, and more than
/// what any other point has to.
std::vector<float> bends(const SubdivisionCage& cage, std::span<const Vec3f> p) {
    std::vector<Vec3f> sums(p.size());
    std::vector<std::uint32_t> counts(p.size());
    largest_over_edges(cage, [&](std::uint32_t a, std::uint32_t b) {
        sums[a] += p[b];
        sums[b] += p[a];
        ++counts[a];
        ++counts[b];
        return 0.0F;
    });
    std::vector<float> out(p.size());
    for (std::size_t i = 0; i < p.size(); ++i)
        if (counts[i] > 0) out[i] = length(p[i] - sums[i] / static_cast<float>(counts[i]));
    return out;
}

}  // namespace

std::optional<TriangleMesh> refined_mesh(const RefinedMeshInput& input) {
    const Subdivision subdivision(input.cage);
    if (!subdivision.valid()) return std::nullopt;
    TriangleMesh out;
    out.origin = subdivision.origin();
    out.indices = triangles_of(subdivision.quads());
    const bool keeps_normals = input.smooth && !input.normals.empty();
    for (const std::span<const Vec3f> key : input.positions) {
        std::vector<Vec3f> normals;
        const bool wanted = input.smooth && !keeps_normals;
        out.positions.push_back(subdivision.positions(key, wanted ? &normals : nullptr));
        if (wanted) out.normals.push_back(std::move(normals));
    }
    if (keeps_normals)
        keep_normals(input, out);
    else if (input.smooth)
        out.normal_indices = out.indices;
    if (!input.cage.uv.empty()) {
        out.uvs = subdivision.uvs(input.uvs);
        out.uv_indices = triangles_of(subdivision.uv_quads());
    }
    out.face.reserve(2 * out.origin->face.size());
    for (const std::uint32_t face : out.origin->face)
        out.face.insert(out.face.end(), 2, input.polygon[face]);
    if (!input.shader_of_polygon.empty())
        for (const std::uint32_t polygon : out.face)
            out.shader_index.push_back(input.shader_of_polygon[polygon]);
    return out;
}

int levels_needed(const SubdivisionCage& cage, std::span<const Vec3f> positions,
                  const FinenessRule& rule, int most) {
    if (!(rule.error > 0)) return most;
    const auto seen = [&](Vec3f a, Vec3f b, float size) {
        if (rule.view == nullptr) return size;
        const Vec3f wa = rule.world_from_object.point(a), wb = rule.world_from_object.point(b);
        const float edge = length(b - a), scale = edge > 0 ? length(wb - wa) / edge : 0;
        return rule.view->pixels((wa + wb) * 0.5F, size * scale);
    };
    // Each level halves edges, and leaves a quarter of the distance to the limit surface.
    float size = 0, factor = 0.5F;
    if (rule.by_edges) {
        size = largest_over_edges(cage, [&](std::uint32_t a, std::uint32_t b) {
            return seen(positions[a], positions[b], length(positions[b] - positions[a]));
        });
    } else if (!cage.linear) {
        factor = 0.25F;
        const std::vector<float> bend = bends(cage, positions);
        size = largest_over_edges(cage, [&](std::uint32_t a, std::uint32_t b) {
            return seen(positions[a], positions[b], std::max(bend[a], bend[b]));
        });
    }
    int levels = 0;
    for (; levels < most && size > rule.error; ++levels)
        size *= factor;
    return levels;
}

}  // namespace lightsieve
