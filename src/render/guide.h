// Where light comes from, learned while rendering: broad lobes send part of their rays there.
//
// Space is a binary tree of boxes; each box (a cell) has a quadtree over the sphere of directions whose leaves hold how much
// light came from there. A direction is drawn by descending the quadtree, so sample points keep their good spread.
// Source: Mueller, Gross and Novak 2017, "Practical Path Guiding for Efficient Light-Transport Simulation". How it is
// learned: render/guide_training.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace lightsieve {

/// World direction to the unit square, areas kept: x is the height, y the angle around the axis.
[[nodiscard]] Vec2f square_from_direction(Vec3f direction);
[[nodiscard]] Vec3f direction_from_square(Vec2f p);

/// A density over the sphere, as a quadtree over the square of square_from_direction.
class DirectionTree {
  public:
    /// A density that is the same everywhere, of weight 0.
    DirectionTree() : nodes_(1) {}

    /// A density that is the same everywhere, of weight 0, with leaves fine enough to begin with.
    [[nodiscard]] static DirectionTree uniform();

    /// Whether any light came.
    [[nodiscard]] bool empty() const { return !(total() > 0); }
    /// Of all light that was added.
    [[nodiscard]] float total() const { return nodes_[0].total(); }

    /// A direction. u in [0,1)^2. Not for empty trees.
    [[nodiscard]] Vec3f sample(Vec2f u) const;
    /// Density of sample() per solid angle. Not for empty trees, nor between `add` and `take_roots`: nodes and what lies in them
    /// have been rounded apart.
    [[nodiscard]] float pdf(Vec3f direction) const;

    /// Adds light at a point of the square, spread over a box as large as the leaf that the point lies in: few samples make
    /// fewer spikes. Source: Mueller 2019, "Practical Path Guiding in Production", section 10.4.
    void add(Vec2f p, float weight);
    /// Makes of mean squares (times area) in leaves their roots.
    void take_roots() { (void)take_roots(0, 0.25F); }
    /// A tree of no weight, fine where this one has much of its weight and coarse where it has little.
    [[nodiscard]] DirectionTree refined() const;

    [[nodiscard]] std::size_t memory() const { return nodes_.capacity() * sizeof(Node); }

  private:
    struct Node {
        std::array<float, 4> weight{};         ///< by quadrant: x + 2 y
        std::array<std::uint32_t, 4> child{};  ///< 0: the quadrant is a leaf
        [[nodiscard]] float total() const {
            return (weight[0] + weight[1]) + (weight[2] + weight[3]);
        }
    };
    void refine(DirectionTree& out, std::uint32_t to, const Node* from,
                const std::array<float, 4>& weight, float all, int depth) const;

    float take_roots(std::uint32_t node, float area);
    float add_box(std::uint32_t node, Vec2f corner, float size, Vec2f low, Vec2f high,
                  float density);
    [[nodiscard]] float leaf_size(Vec2f p) const;
    std::vector<Node> nodes_;
};

/// Boxes of space, each with a density of directions.
class Guide {
  public:
    static constexpr std::size_t kMostCells = 1 << 14;

    struct Cell {
        DirectionTree tree;
        /// Of the rays of a broad lobe so many go where the tree says; the others go as the lobe says, so light from where
        /// nothing was learned is found, too. Below 1.
        float share = 0;
        std::uint64_t n_records = 0;  ///< that the tree was learned from
    };

    /// Six cells that know nothing: surfaces that face unlike ways share none.
    explicit Guide(const Box3f& bounds);

    /// The cell of a point on a surface; points outside of the bounds go to the nearest.
    [[nodiscard]] std::uint32_t cell_at(Vec3f position, Vec3f normal) const;
    [[nodiscard]] std::vector<Cell>& cells() { return cells_; }
    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
    /// Halves each cell until none was learned from more than `most` records, or there are kMostCells. The parts are taken for
    /// equal.
    void split(std::uint64_t most);
    /// Whether any cell guides rays.
    [[nodiscard]] bool guides() const;
    [[nodiscard]] std::size_t memory() const;

  private:
    struct Node {
        std::uint32_t children = 0;  ///< the first of two neighbours; 0: a leaf
        std::uint32_t cell = 0;
    };
    void split(std::uint32_t node, std::uint64_t most, unsigned depth);

    Box3f bounds_;  ///< a cube
    Vec3f per_extent_;
    std::vector<Node> nodes_;
    std::vector<Cell> cells_;
};

}  // namespace lightsieve
