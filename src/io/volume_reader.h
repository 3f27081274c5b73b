// Runs the program that reads OpenVDB files (src/vdb_reader) and gathers what it says, or what went wrong.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/volume_grid.h"
#include "io/volume_stream.h"

namespace lightsieve {

/// Memory at the alignment that NanoVDB needs, not set to anything.
class VolumeBlock {
  public:
    VolumeBlock() = default;
    /// throws std::bad_alloc
    explicit VolumeBlock(std::size_t size);
    [[nodiscard]] std::span<std::byte> bytes() const { return {bytes_.get(), size_}; }

  private:
    struct Delete {
        void operator()(std::byte* bytes) const;
    };
    std::unique_ptr<std::byte, Delete> bytes_;
    std::size_t size_ = 0;
};

/// One grid as the reader gave it: nothing of it is to be trusted.
struct RawVolumeGrid {
    std::string name;
    int n_channels = 0;  ///< 1 or 3
    VolumeTransform object_from_index{};
    VolumeBlock block;
};

/// Where the reader is: beside the module or program that this code is in.
[[nodiscard]] std::string volume_reader_path();

/// Grids of `path`, as for load_volume. throws InputError
[[nodiscard]] std::vector<RawVolumeGrid> run_volume_reader(const std::string& reader,
                                                           const std::string& path,
                                                           std::span<const std::string> names,
                                                           const VolumeLimits& limits);

/// load_volume with a reader of one's own, for tests.
[[nodiscard]] std::shared_ptr<const VolumeGrids> load_volume_with(
    const std::string& reader, const std::string& path, std::span<const std::string> names,
    const VolumeLimits& limits);

}  // namespace lightsieve
