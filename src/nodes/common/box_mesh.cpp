#include <array>

#include "nodes/shape/shape_common.h"

namespace lightsieve {

TriangleMesh box_mesh(const Box3f& box) {
    TriangleMesh mesh;
    // Corner i takes x, y and z from the upper end where bits 0, 1 and 2 of i are set.
    std::vector<Vec3f>& corners = mesh.positions.emplace_back();
    for (unsigned i = 0; i < 8; ++i)
        corners.push_back({(i & 1U) != 0 ? box.upper.x : box.lower.x,
                           (i & 2U) != 0 ? box.upper.y : box.lower.y,
                           (i & 4U) != 0 ? box.upper.z : box.lower.z});
    // Counter-clockwise as seen from outside.
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    std::uint32_t face = 0;
    for (const auto& f : kFaces) {
        mesh.indices.insert(mesh.indices.end(), {f[0], f[1], f[2], f[0], f[2], f[3]});
        mesh.face.insert(mesh.face.end(), 2, face++);
    }
    return mesh;
}

}  // namespace lightsieve
