// Writes the OpenVDB files that tests read (io/volume_*_test.cpp), good ones and odd ones. Only built when asked for: every
// type of grid takes seconds to compile.
//
//   cmake --build build/release --target write_test_volumes && build/release/src/write_test_volumes tests/data/volumes

#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "io/testing/test_volumes.h"

namespace lightsieve {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::GridPtrVec;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

openvdb::math::Transform::Ptr transform_of(const VolumeTransform& m) {
    openvdb::Mat4R matrix = openvdb::Mat4R::identity();
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 3; ++column)
            matrix(row, column) =
                m[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    return openvdb::math::Transform::createLinearTransform(matrix);
}

template <class Value>
Value value_at(const TestVoxel& voxel, std::uint32_t seed) {
    const auto channel = [&](std::uint32_t i) { return test_value(voxel, seed + i); };
    if constexpr (openvdb::VecTraits<Value>::IsVec) {
        using Element = typename Value::value_type;
        return {static_cast<Element>(channel(0)), static_cast<Element>(channel(1)),
                static_cast<Element>(channel(2))};
    } else if constexpr (std::is_same_v<Value, bool>) {
        return channel(0) > 2;
    } else {
        return static_cast<Value>(channel(0));
    }
}

/// The test's voxels as a grid of any type.
template <class Grid>
typename Grid::Ptr test_grid(const std::string& name, std::uint32_t seed) {
    using Value = typename Grid::ValueType;
    // A voxel that is not active has the background's value.
    const typename Grid::Ptr grid = Grid::create(value_at<Value>({1 << 20, 0, 0}, seed));
    grid->setName(name);
    grid->setTransform(transform_of(kTestTransform));
    auto accessor = grid->getAccessor();
    for (int x = kTestLower[0]; x <= kTestUpper[0]; ++x)
        for (int y = kTestLower[1]; y <= kTestUpper[1]; ++y)
            for (int z = kTestLower[2]; z <= kTestUpper[2]; ++z)
                if (test_active({x, y, z}))
                    accessor.setValue(Coord(x, y, z), value_at<Value>({x, y, z}, seed));
    return grid;
}

openvdb::MaskGrid::Ptr test_mask(const std::string& name) {
    const auto grid = openvdb::MaskGrid::create();
    grid->setName(name);
    grid->setTransform(transform_of(kTestTransform));
    grid->topologyUnion(*test_grid<openvdb::BoolGrid>("", 0));
    return grid;
}

openvdb::FloatGrid::Ptr float_grid(const std::string& name, float background) {
    const auto grid = openvdb::FloatGrid::create(background);
    grid->setName(name);
    return grid;
}

GridPtrVec every_type() {
    auto half = test_grid<openvdb::FloatGrid>("half", 1);
    half->setSaveFloatAsHalf(true);
    const auto points = openvdb::points::PointDataGrid::create();
    points->setName("points");
    return {half,
            points,
            test_grid<openvdb::FloatGrid>("density", 1),
            test_grid<openvdb::DoubleGrid>("double", 2),
            test_grid<openvdb::Int32Grid>("int32", 3),
            test_grid<openvdb::Int64Grid>("int64", 4),
            test_grid<openvdb::BoolGrid>("bool", 5),
            test_mask("mask"),
            test_grid<openvdb::Vec3SGrid>("color", 6),
            test_grid<openvdb::Vec3DGrid>("vec3d", 9),
            test_grid<openvdb::Vec3IGrid>("vec3i", 12)};
}

/// A billion voxels in tiles, a few of their own, and a tile of the largest kind.
GridPtrVec tiles() {
    const auto grid = float_grid("density", 0);
    grid->setTransform(transform_of(kTestTransform));
    grid->sparseFill(CoordBBox(Coord(-512), Coord(511)), 2.0F);
    grid->tree().setValue(Coord(3, 4, 5), 7.0F);
    grid->tree().setValue(Coord(-400, 4, 5), 0.5F);
    grid->tree().addTile(3, Coord(8192, 0, 0), 3.0F, true);
    // Not active, and yet not the background.
    grid->tree().addTile(3, Coord(-8192, 0, 0), 5.0F, false);
    return {grid};
}

GridPtrVec not_finite() {
    const auto grid = float_grid("density", kNaN);
    grid->tree().setValue(Coord(0, 0, 0), 1.0F);
    grid->tree().setValue(Coord(1, 0, 0), kNaN);
    grid->tree().setValue(Coord(2, 0, 0), kInf);
    grid->tree().setValue(Coord(3, 0, 0), -kInf);
    grid->tree().setValue(Coord(4, 0, 0), 3e38F);
    const auto color = openvdb::Vec3SGrid::create();
    color->setName("color");
    color->tree().setValue(Coord(0, 0, 0), openvdb::Vec3s(1, kNaN, 2));
    const auto wide = openvdb::DoubleGrid::create();
    wide->setName("wide");
    wide->tree().setValue(Coord(0, 0, 0), 1e300);
    return {grid, color, wide};
}

openvdb::GridBase::Ptr one_voxel(const std::string& name, const VolumeTransform& transform) {
    const auto grid = float_grid(name, 0);
    grid->tree().setValue(Coord(1, 2, 3), 1.0F);
    grid->setTransform(transform_of(transform));
    return grid;
}

GridPtrVec odd_transforms() {
    const auto frustum = float_grid("frustum", 0);
    frustum->tree().setValue(Coord(1, 2, 3), 1.0F);
    frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 2.0));
    return {frustum, one_voxel("flat", {{{1, 0, 0}, {1, 1e-11, 0}, {0, 0, 1}, {0, 0, 0}}}),
            one_voxel("huge", {{{1e33, 0, 0}, {0, 1e33, 0}, {0, 0, 1e33}, {0, 0, 0}}}),
            one_voxel("beyond", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {kNaN, 0, 0}}}),
            one_voxel("good", {{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {0, 0, 0}}})};
}

GridPtrVec far_away() {
    const auto grid = float_grid("density", 0);
    grid->tree().setValue(Coord(std::numeric_limits<int>::max() - 5, 0, 0), 1.0F);
    return {grid};
}

/// Two leaves at opposite ends of a wide space.
GridPtrVec sparse() {
    const auto grid = float_grid("density", 0);
    grid->tree().setValue(Coord(-100'000'000, 3, 0), 1.0F);
    grid->tree().setValue(Coord(100'000'000, 0, 70'000'000), 2.0F);
    return {grid};
}

/// Small enough that a flipped bit has a good chance to matter.
GridPtrVec small() {
    const auto grid = float_grid("density", 0);
    const auto color = openvdb::Vec3SGrid::create();
    color->setName("color");
    for (int i = 1; i < 13; ++i) {
        grid->tree().setValue(Coord(i, i / 2, 13 - i), static_cast<float>(i));
        color->tree().setValue(Coord(i, i, i), openvdb::Vec3s(static_cast<float>(i)));
    }
    return {grid, color};
}

int write_all(const std::string& folder) {
    openvdb::initialize();
    const auto write = [&](const std::string& name, const GridPtrVec& grids,
                           std::uint32_t compression) {
        openvdb::io::File file(folder + "/" + name);
        file.setCompression(compression);
        file.write(grids);
        file.close();
    };
    using namespace openvdb::io;
    constexpr auto kZip = COMPRESS_ZIP | COMPRESS_ACTIVE_MASK;
    write("every_type.vdb", every_type(), kZip);
    write("tiles.vdb", tiles(), kZip);
    write("not_finite.vdb", not_finite(), kZip);
    write("odd_transforms.vdb", odd_transforms(), kZip);
    write("far_away.vdb", far_away(), kZip);
    write("sparse.vdb", sparse(), kZip);
    write("small.vdb", small(), COMPRESS_NONE | COMPRESS_ACTIVE_MASK);
    write("small_zip.vdb", small(), kZip);
    write("small_blosc.vdb", small(), COMPRESS_BLOSC | COMPRESS_ACTIVE_MASK);
    write("no_grids.vdb", {}, kZip);
    write("no_voxels.vdb", {float_grid("density", 2.0F)}, kZip);
    write("twins.vdb", {float_grid("density", 1.0F), float_grid("density", 2.0F)}, kZip);
    return 0;
}

}  // namespace

}  // namespace lightsieve

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
        return 2;
    }
    return lightsieve::write_all(argv[1]);
}
