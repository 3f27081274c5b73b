// Subdivision surfaces. OpenSubdiv is used here and nowhere else.
//
// A mesh is refined evenly, so many levels deep, and its vertices are then moved to where they would come to lie after
// infinitely many, with the normals of that surface. Even refinement instead of one that adapts from patch to patch has no
// cracks to close, and neighbouring quads are of similar size for displacement; how many levels an object needs is
// decided by who calls (nodes/shape/polymesh.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/vec.h"
#include "scene/shape.h"

namespace lightsieve {

/// How texture coordinates are subdivided where their seams and borders are.
enum class UvSmoothing : std::int32_t { PinCorners, PinBorders, Linear, Smooth };

/// A mesh that is to be refined. Indices must be valid; faces have three corners or more.
struct SubdivisionCage {
    std::vector<std::uint32_t> first_corner;  ///< of each face in the next ones, and the end
    std::vector<std::uint32_t>
        corner;  ///< number of each face corner in the node: position in vidxs
    std::vector<std::uint32_t> vertex;  ///< of each face corner
    std::vector<std::uint32_t> uv;      ///< of each face corner; empty: no uv
    std::size_t n_vertices = 0, n_uvs = 0;
    struct Crease {
        std::uint32_t first = 0, second = 0;  ///< vertices; the same one twice: a pointed vertex
        float sharpness = 0;
    };
    std::vector<Crease> creases;  ///< those along no edge are left out
    bool linear = false;          ///< new vertices in the middle of edges and faces, nothing moves
    UvSmoothing uv_smoothing = UvSmoothing::PinCorners;
    int levels = 1;  ///< at least 1
};

/// Number of quads after `levels` levels; exact, and of any size.
[[nodiscard]] double n_refined_quads(std::span<const std::uint32_t> first_corner, int levels);

class Subdivision {
  public:
    /// Throws std::bad_alloc if it does not fit into memory.
    explicit Subdivision(const SubdivisionCage& cage);
    ~Subdivision();
    Subdivision(const Subdivision&) = delete;
    Subdivision& operator=(const Subdivision&) = delete;

    /// False if the library refuses the mesh; then nothing else may be asked.
    [[nodiscard]] bool valid() const;
    /// Vertices on the limit surface; `normals`, if not null, gets unit normals there.
    ///
    /// cage  of the vertices of the mesh, at one motion key
    [[nodiscard]] std::vector<Vec3f> positions(std::span<const Vec3f> cage,
                                               std::vector<Vec3f>* normals) const;
    /// Texture coordinates; `cage` those of the mesh.
    [[nodiscard]] std::vector<Vec2f> uvs(std::span<const Vec2f> cage) const;
    /// Vertex of each corner of each quad, four a quad.
    [[nodiscard]] std::vector<std::uint32_t> quads() const;
    /// The same of texture coordinates.
    [[nodiscard]] std::vector<std::uint32_t> uv_quads() const;
    /// Where the quads lie in the faces.
    [[nodiscard]] std::shared_ptr<const MeshOrigin> origin() const { return origin_; }

  private:
    struct Refined;
    std::unique_ptr<Refined> refined_;
    std::shared_ptr<const MeshOrigin> origin_;
};

}  // namespace lightsieve
