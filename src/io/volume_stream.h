// What `lightsieve_vdb_reader` (src/vdb_reader) says to the renderer: the one place that both sides include.
//
// Standard output: kVolumeStreamMagic, then for each grid a VolumeStreamGrid, the name, and a NanoVDB grid; last a
// VolumeStreamGrid of no channels. Standard error: one line `VDB:kind<tab>detail` if something is wrong. Both sides are built
// together and run on one machine, so structs travel as they lie in memory.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lightsieve {

/// The helper's file name; it lies beside the module or program that runs it.
inline constexpr std::string_view kVolumeReaderName = "lightsieve_vdb_reader";

inline constexpr std::array<char, 8> kVolumeStreamMagic = {'L', 'S', 'V', 'O', 'L', '0', '0', '1'};
/// Longer names of grids are refused [bytes].
inline constexpr std::uint64_t kMaxVolumeNameBytes = 4096;
/// NanoVDB grids begin at multiples of this [bytes].
inline constexpr std::size_t kVolumeGridAlignment = 32;

/// Points from voxels' numbers (a voxel's centre is its number) to object space: p = x*row0 + y*row1 + z*row2 + row3.
using VolumeTransform = std::array<std::array<double, 3>, 4>;

/// Precedes each grid.
struct VolumeStreamGrid {
    std::uint64_t channels =
        0;  ///< 1: NanoGrid<float>, 3: NanoGrid<Vec3f>, 0: there are no more grids
    std::uint64_t name_bytes = 0;
    std::uint64_t grid_bytes = 0;
    VolumeTransform object_from_index{};
};

// What standard error begins with; the detail depends on the kind.

/// The library objects to the file; detail: its message.
inline constexpr std::string_view kVolumeDamaged = "VDB:damaged\t";
/// A grid that was asked for is not there; detail: its name, a tab, the names of those that are, between tabs.
inline constexpr std::string_view kVolumeGridMissing = "VDB:missing\t";
/// A grid cannot be used; detail: its name, a tab, the reason.
inline constexpr std::string_view kVolumeGridUnusable = "VDB:unusable\t";
/// Memory ran out; no detail.
inline constexpr std::string_view kVolumeMemory = "VDB:memory\t";

}  // namespace lightsieve
