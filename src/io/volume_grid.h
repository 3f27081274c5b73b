// Volume grids: the voxels of an OpenVDB file, ready for look-ups.
//
// The renderer never runs OpenVDB: a file that is damaged, or made to be, could crash or exhaust it. A helper program
// reads the file (io/vdb_reader) and hands over NanoVDB grids, flat blocks of memory that are checked before use.
// Scalars become floats and vectors triples of floats, whatever the file's type; values that are not finite become 0.
//
// Two questions are answered at any point and in any box of object space (the file's world space): the value, and a bound
// on values, from which free paths are drawn. Both are quick, take no memory, and may be asked by any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/name.h"
#include "core/vec.h"

namespace lightsieve {

/// How values between the centres of voxels are found. Tricubic: Catmull-Rom, through the voxels' values.
enum class VolumeInterpolation : std::uint8_t { Closest, Trilinear, Tricubic };

/// The grids of one OpenVDB file, ready for look-ups; immutable, shared by all threads.
class VolumeGrids {
  public:
    struct Info {
        Name name;
        bool vector = false;   ///< three channels; otherwise one, which look-ups repeat
        Box3f bounds;          ///< of the active voxels, half a voxel around [object space]
        float voxel_size = 0;  ///< the shortest edge of a voxel [object space]
    };

    VolumeGrids(const VolumeGrids&) = delete;
    VolumeGrids& operator=(const VolumeGrids&) = delete;
    ~VolumeGrids();

    /// What was read: in the order asked for, or by name.
    [[nodiscard]] std::span<const Info> grids() const;
    /// Number of a grid, or -1.
    [[nodiscard]] int find(Name name) const;
    /// Bounds of all active voxels of all grids [object space]; empty if there are none.
    [[nodiscard]] Box3f bounds() const;
    /// Value at a point; scalars in all three channels; the grid's background outside, and where the point is not finite.
    /// Values lie between those of the voxels around: tricubic interpolation is kept from overshooting.
    [[nodiscard]] Color sample(int grid, Vec3f object_position,
                               VolumeInterpolation interpolation) const noexcept;
    /// Not less than any value (of each component) that `sample` can return in the box, at any interpolation; for a box that
    /// is not finite or is empty, in all of space. Taken from the maxima of cells of 8^3 voxels (larger ones in grids that are
    /// nearly empty, or under large boxes), so it may be larger than the values; at most 64 cells are visited.
    [[nodiscard]] Color maximum(int grid, const Box3f& object_box) const noexcept;
    /// Memory of grids and bounds [bytes].
    [[nodiscard]] std::size_t memory() const;
    /// What reading the file took [s].
    [[nodiscard]] double load_seconds() const;

  private:
    struct State;
    explicit VolumeGrids(std::unique_ptr<State> state);
    friend struct VolumeLoader;
    std::unique_ptr<State> state_;
};

/// What one file may cost.
struct VolumeLimits {
    std::size_t max_bytes = std::size_t{8}
                            << 30;  ///< of the grids, and of the helper that reads them [bytes]
    double max_seconds = 300;       ///< wall-clock time of the helper [s]
};

/// Reads grids of an OpenVDB file. Not for the hot path; thread safe.
///
/// path    an existing file, after search paths
/// names   the grids wanted; empty: all that hold numbers
/// throws  InputError: file-not-found, file-unreadable, file-format, unknown-grid, volume-grid (of no use: its transform
///         or its type), limit-volume, volume-reader (the helper is missing or was stopped by a signal)
[[nodiscard]] std::shared_ptr<const VolumeGrids> load_volume(const std::string& path,
                                                             std::span<const std::string> names,
                                                             const VolumeLimits& limits = {});

}  // namespace lightsieve
