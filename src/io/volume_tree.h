// One grid's voxels: a NanoVDB block that has been checked, look-ups in it, and bounds on its values.
//
// Coordinates are numbers of voxels; a voxel's centre is its number. A NanoVDB tree has four levels: a table at the root,
// nodes of 4096^3 and of 128^3 voxels, leaves of 8^3; parts of one value are tiles of any of these sizes. Look-ups go
// through the levels once for each leaf that they touch. The table is searched by halving, not from its beginning as the
// library does: there may be very many entries.
//
// Blocks come from another process that a damaged file may have led astray. Every offset is followed once, within the
// block; values that are not finite are set to 0. Afterwards nothing needs to be checked.
#pragma once

#include <nanovdb/NanoVDB.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.h"
#include "io/volume_grid.h"
#include "io/volume_reader.h"

namespace lightsieve {

/// Numbers of voxels, both inclusive.
struct VoxelBox {
    std::array<std::int64_t, 3> lower{INT64_MAX, INT64_MAX, INT64_MAX};
    std::array<std::int64_t, 3> upper{INT64_MIN, INT64_MIN, INT64_MIN};
    [[nodiscard]] bool empty() const { return lower[0] > upper[0]; }
    void grow(const VoxelBox& box);
    [[nodiscard]] bool contains(const VoxelBox& box) const;
};

/// Voxels further from the first than this have the background's value: coordinates stay far below the range of an int.
inline constexpr std::int64_t kMaxVoxel = std::int64_t{1} << 30;

/// Maxima over cells of 8^3 voxels and over cells of twice, four times, .. the width, so that a box of any size takes
/// few of them. Grids that are nearly empty begin with larger cells, so that memory stays in proportion to the voxels'.
template <class Value>
class MaximumPyramid {
  public:
    /// box         all voxels that may differ from the background
    /// max_cells   bound on the cells of the finest level
    MaximumPyramid(const VoxelBox& box, const Value& background, std::size_t max_cells);
    /// Raises the cells that touch the box, which is within that of the constructor.
    void raise(const VoxelBox& box, const Value& value);
    /// To be called once, after the last `raise`.
    void build_levels();
    /// Maximum over the voxels of the box and maybe some more.
    [[nodiscard]] Value maximum(const VoxelBox& box) const noexcept;
    [[nodiscard]] std::size_t memory() const;

  private:
    struct Level {
        std::array<std::int64_t, 3> size{};  ///< cells
        std::vector<Value> cells;            ///< x is the slowest
        [[nodiscard]] std::size_t at(const std::array<std::int64_t, 3>& cell) const {
            return static_cast<std::size_t>((cell[0] * size[1] + cell[1]) * size[2] + cell[2]);
        }
    };
    [[nodiscard]] VoxelBox cells_of(const VoxelBox& box, int level) const noexcept;

    VoxelBox box_;
    Value background_;
    int cell_log2_ = 3;                     ///< of the finest level's width [voxels]
    std::array<std::int64_t, 3> origin_{};  ///< the first cell of the finest level, in cells
    std::vector<Level> levels_;             ///< the finest first; none for an empty box
};

/// Build: float or nanovdb::Vec3f, as in NanoGrid<Build>.
template <class Build>
class VolumeTree {
  public:
    /// One voxel.
    using Value = std::conditional_t<std::is_same_v<Build, float>, float, Color>;

    /// Checks a block and takes it over. Empty with `problem` set if it is no sound grid.
    [[nodiscard]] static std::optional<VolumeTree> take(VolumeBlock&& block, std::string& problem);

    /// The voxels that are active.
    [[nodiscard]] const VoxelBox& active() const { return active_; }
    [[nodiscard]] Value background() const { return background_; }
    /// Value at a point within kMaxVoxel.
    [[nodiscard]] Value sample(const std::array<double, 3>& index,
                               VolumeInterpolation interpolation) const noexcept;
    /// Not less than the value of any voxel in the box.
    [[nodiscard]] Value maximum(const VoxelBox& box) const noexcept {
        return pyramid_->maximum(box);
    }
    [[nodiscard]] std::size_t memory() const;

  private:
    using Upper = nanovdb::NanoUpper<Build>;

    /// 8^3 voxels: each its own value, or all of one.
    struct Block {
        const Build* values = nullptr;  ///< 512, z the fastest; null: all are `constant`
        Value constant{};
    };
    /// An entry of the table.
    struct Entry {
        std::uint64_t key = 0;
        const Upper* node = nullptr;  ///< null: a tile
        Value value{};
    };

    VolumeTree() = default;
    /// Fills `table_` from a block whose nodes have been checked. False: two entries for one place.
    [[nodiscard]] bool make_table();
    [[nodiscard]] Block block_at(int x, int y, int z) const noexcept;
    template <int N>
    void gather(const std::array<int, 3>& base, Value* out) const noexcept;
    [[nodiscard]] Value trilinear(const std::array<double, 3>& index) const noexcept;
    [[nodiscard]] Value tricubic(const std::array<double, 3>& index) const noexcept;

    VolumeBlock block_;
    std::vector<Entry> table_;  ///< by key
    Value background_{};
    VoxelBox active_;
    std::optional<MaximumPyramid<Value>> pyramid_;
};

extern template class VolumeTree<float>;
extern template class VolumeTree<nanovdb::Vec3f>;

}  // namespace lightsieve
