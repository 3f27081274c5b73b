// From a polymesh's parameters to the triangles of its subdivision surface.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/matrix.h"
#include "nodes/common/dicing.h"
#include "nodes/common/subdivision.h"
#include "scene/shape.h"

namespace lightsieve {

/// Quads of one mesh: about 2.5 GB (500 bytes each) while it is made and for what rays need. Arnold has no limit but memory.
inline constexpr double kMaxRefinedQuads = 5e6;

/// What is refined beside the cage.
struct RefinedMeshInput {
    SubdivisionCage cage;
    std::vector<std::uint32_t> polygon;  ///< of each face of the cage: number in the node
    std::vector<std::span<const Vec3f>> positions;  ///< one list a motion key
    std::span<const Vec2f> uvs;
    /// Normals at the corners: the node's own, which linear subdivision keeps. Empty: those of the surface.
    std::vector<std::span<const Vec3f>> normals;
    std::span<const std::uint32_t> normal_of_corner;  ///< by position in vidxs
    bool smooth = false;                              ///< with normals at all
    std::span<const std::uint8_t> shader_of_polygon;  ///< empty: all 0
};

/// The refined mesh; nothing if OpenSubdiv refuses it (faces or vertices with more than 65535 edges).
[[nodiscard]] std::optional<TriangleMesh> refined_mesh(const RefinedMeshInput& input);

/// When is a mesh fine enough?
struct FinenessRule {
    float error = 0;  ///< in pixels or object space units
    bool by_edges =
        false;  ///< the longest edge must be shorter; else the distance to the limit surface
    const DicingView* view = nullptr;  ///< null: in object space
    Mat4f world_from_object;
};

/// The smallest number of levels that satisfies the rule, up to `most`.
[[nodiscard]] int levels_needed(const SubdivisionCage& cage, std::span<const Vec3f> positions,
                                const FinenessRule& rule, int most);

}  // namespace lightsieve
