// Upper bounds of a medium's extinction, cell by cell, and the walk of a ray through the cells.
//
// Free paths are drawn as if the extinction were the bound everywhere; collisions with what is not there ("null collisions")
// are told apart afterwards. The tighter the bounds, the fewer of those.
// Source: Woodcock et al. 1965; cells and the walk as in Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th ed.,
// section 11.4.4.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/vec.h"

namespace lightsieve {

/// Bounds over a box [1/scene unit].
class MajorantGrid {
  public:
    MajorantGrid() : MajorantGrid({}, {1, 1, 1}) {}
    /// box   object space
    /// size  cells along each axis, at least 1
    MajorantGrid(const Box3f& box, std::array<int, 3> size);

    [[nodiscard]] const Box3f& box() const { return box_; }
    [[nodiscard]] std::array<int, 3> size() const { return size_; }
    [[nodiscard]] float& at(int x, int y, int z) { return cells_[index(x, y, z)]; }
    [[nodiscard]] float at(int x, int y, int z) const { return cells_[index(x, y, z)]; }
    [[nodiscard]] std::size_t memory() const { return cells_.capacity() * sizeof(float); }
    /// Object space.
    [[nodiscard]] Box3f cell(int x, int y, int z) const;

  private:
    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_[1]) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(size_[0]) +
               static_cast<std::size_t>(x);
    }
    Box3f box_;
    std::array<int, 3> size_;
    std::vector<float> cells_;
};

/// The cells along a ray, one after the other.
class MajorantWalk {
  public:
    MajorantWalk() = default;
    /// origin, direction  object space; the direction keeps the ray's parameter (it need not be unit)
    /// t0, t1             the part of the ray that lies in the box; what rounding leaves outside belongs to the nearest cell
    MajorantWalk(const MajorantGrid& grid, Vec3f origin, Vec3f direction, float t0, float t1);

    /// Goes on to the next cell; false at the end.
    bool next();
    [[nodiscard]] float majorant() const { return majorant_; }  ///< of the cell
    [[nodiscard]] float begin() const { return t_; }            ///< where the ray enters the cell
    [[nodiscard]] float end() const { return t_end_; }          ///< and leaves it

  private:
    const MajorantGrid* grid_ = nullptr;
    float t_ = 0, t_end_ = 0, t_last_ = 0;
    float majorant_ = 0;
    std::array<int, 3> cell_{}, step_{}, limit_{};
    std::array<float, 3> next_crossing_{}, delta_{};
    bool started_ = false;
};

}  // namespace lightsieve
