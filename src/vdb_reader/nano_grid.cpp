#include "vdb_reader/nano_grid.h"

#include <nanovdb/util/OpenToNanoVDB.h>

#include <cstdint>
#include <memory>
#include <new>

namespace lightsieve {

namespace {

/// Memory for the converter, which says so when there is none.
class Block {
  public:
    static Block create(std::uint64_t size, const Block* /*pool*/ = nullptr) {
        Block block;
        block.bytes_.reset(static_cast<std::uint8_t*>(
            ::operator new(size, std::align_val_t{kVolumeGridAlignment})));
        block.size_ = size;
        return block;
    }
    [[nodiscard]] std::uint8_t* data() { return bytes_.get(); }
    [[nodiscard]] const std::uint8_t* data() const { return bytes_.get(); }
    [[nodiscard]] std::uint64_t size() const { return size_; }
    void clear() { bytes_.reset(); }

  private:
    struct Delete {
        void operator()(std::uint8_t* bytes) const {
            ::operator delete(bytes, std::align_val_t{kVolumeGridAlignment});
        }
    };
    std::unique_ptr<std::uint8_t, Delete> bytes_;
    std::uint64_t size_ = 0;
};

template <class Build, class Pointer>
nanovdb::GridHandle<Block> convert(Pointer& voxels) {
    // The renderer finds bounds and maxima itself, and is given the transform apart.
    using Source = typename Pointer::element_type::ValueType;
    nanovdb::OpenToNanoVDB<Source, Build, nanovdb::AbsDiff, Block> converter;
    converter.setStats(nanovdb::StatsMode::Disable);
    converter.setChecksum(nanovdb::ChecksumMode::Disable);
    voxels->setTransform(openvdb::math::Transform::createLinearTransform());
    voxels->setGridClass(openvdb::GRID_UNKNOWN);
    voxels->setName("");
    nanovdb::GridHandle<Block> handle = converter(*voxels);
    voxels.reset();
    return handle;
}

}  // namespace

void with_nano_grid(VdbGrid&& grid,
                    const std::function<void(std::span<const std::byte> block)>& take) {
    const bool scalar = std::holds_alternative<openvdb::FloatGrid::Ptr>(grid.voxels);
    const nanovdb::GridHandle<Block> handle =
        scalar ? convert<float>(std::get<openvdb::FloatGrid::Ptr>(grid.voxels))
               : convert<nanovdb::Vec3f>(std::get<openvdb::Vec3SGrid::Ptr>(grid.voxels));
    take({reinterpret_cast<const std::byte*>(handle.data()), handle.size()});
}

}  // namespace lightsieve
