#include "vdb_reader/vdb_file.h"

#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/Stream.h>

#include <algorithm>
#include <fstream>

namespace lightsieve {

namespace {

/// A name in a line of fields, without bytes that would end one.
std::string printable(std::string text) {
    std::replace(text.begin(), text.end(), '\t', '?');
    return text;
}

[[noreturn]] void unusable(const std::string& name, const std::string& why) {
    throw VdbError(std::string(kVolumeGridUnusable) + printable(name) + "\t" + why);
}

using Voxels = decltype(VdbGrid::voxels);

/// The same tree with values of another type. The library's own copy refuses to shorten vectors of doubles.
template <class Target, class Source>
typename Target::TreeType::Ptr converted(const typename Source::TreeType& source) {
    using Value = typename Target::ValueType;
    using Tree = typename Target::TreeType;
    // A mask has no values: what is active counts as 1.
    if constexpr (std::is_same_v<Source, openvdb::MaskGrid>)
        return typename Tree::Ptr(new Tree(source, Value(0), Value(1), openvdb::TopologyCopy()));
    const typename Tree::Ptr target(
        new Tree(source, Value(source.background()), openvdb::TopologyCopy()));
    auto to = target->beginValueAll();
    for (auto from = source.cbeginValueAll(); from; ++from, ++to)
        to.setValue(Value(from.getValue()));
    return target;
}

template <class Target, class Source>
bool convert(const openvdb::GridBase::Ptr& grid, Voxels& voxels) {
    const auto source = openvdb::gridPtrCast<Source>(grid);
    if (!source) return false;
    if constexpr (std::is_same_v<Source, Target>)
        voxels = source;
    else
        voxels = Target::create(converted<Target, Source>(source->constTree()));
    return true;
}

/// False if the grid holds no numbers.
bool convert_any(const openvdb::GridBase::Ptr& grid, Voxels& voxels) {
    using openvdb::FloatGrid;
    using openvdb::Vec3SGrid;
    return convert<FloatGrid, FloatGrid>(grid, voxels) ||
           convert<FloatGrid, openvdb::DoubleGrid>(grid, voxels) ||
           convert<FloatGrid, openvdb::Int32Grid>(grid, voxels) ||
           convert<FloatGrid, openvdb::Int64Grid>(grid, voxels) ||
           convert<FloatGrid, openvdb::BoolGrid>(grid, voxels) ||
           convert<FloatGrid, openvdb::MaskGrid>(grid, voxels) ||
           convert<Vec3SGrid, Vec3SGrid>(grid, voxels) ||
           convert<Vec3SGrid, openvdb::Vec3DGrid>(grid, voxels) ||
           convert<Vec3SGrid, openvdb::Vec3IGrid>(grid, voxels);
}

bool holds_numbers(const openvdb::GridBase& grid) {
    return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>() ||
           grid.isType<openvdb::Int32Grid>() || grid.isType<openvdb::Int64Grid>() ||
           grid.isType<openvdb::BoolGrid>() || grid.isType<openvdb::MaskGrid>() ||
           grid.isType<openvdb::Vec3SGrid>() || grid.isType<openvdb::Vec3DGrid>() ||
           grid.isType<openvdb::Vec3IGrid>();
}

/// What is wrong with a transform turns up while it is read or inverted.
template <class Read>
auto guarded(const std::string& name, const Read& read) {
    try {
        return read();
    } catch (const openvdb::ArithmeticError& error) {
        unusable(name, error.what());
    }
}

/// A file's head and its table of contents, read with a stream that says when there is nothing more to read: the library does
/// not ask, and takes what is missing for zeros.
class Contents : public openvdb::io::Archive {
  public:
    void check(const std::string& path) {
        std::ifstream in(path, std::ios::binary | std::ios::ate);
        const std::int64_t size = in.tellg();
        in.seekg(0);
        in.exceptions(std::ios::failbit | std::ios::badbit);
        readHeader(in);
        setFormatVersion(in);
        setLibraryVersion(in);
        openvdb::MetaMap().readMeta(in);
        if (!inputHasGridOffsets()) return check_stream(in);
        const int n = readGridCount(in);
        for (int i = 0; i < n; ++i) {
            openvdb::io::GridDescriptor grid;
            (void)grid.read(in);
            if (grid.getEndPos() > size) throw std::runtime_error("it ends too early");
            grid.seekToEnd(in);
        }
    }

  private:
    /// Without offsets only reading all of it tells.
    static void check_stream(std::ifstream& in) {
        in.seekg(0);
        (void)openvdb::io::Stream(in, false).getGrids();
    }
};

VolumeTransform affine_transform(const openvdb::GridBase& grid, const std::string& name) {
    const auto map = grid.transform().baseMap();
    if (!map->isLinear()) unusable(name, "its transform is not linear");
    const openvdb::Mat4R matrix = map->getAffineMap()->getMat4();
    VolumeTransform out;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 3; ++column)
            out[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
                matrix(row, column);
    return out;
}

}  // namespace

VdbFile::VdbFile(const std::string& path) : file_(path) {
    try {
        Contents().check(path);
    } catch (const std::ios_base::failure&) {
        throw std::runtime_error("it ends too early");
    }
    // All at once: voxels that are read later would be read behind the back of whoever handles errors.
    file_.open(false);
    for (auto it = file_.beginName(); it != file_.endName(); ++it)
        names_.push_back(it.gridName());
}

VdbFile::~VdbFile() { file_.close(); }

std::vector<std::string> VdbFile::names_of_numbers() {
    std::vector<std::string> numbers;
    for (const std::string& name : names_)
        if (holds_numbers(*guarded(name, [&] { return file_.readGridMetadata(name); })))
            numbers.push_back(name);
    return numbers;
}

void VdbFile::check_names(const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
        if (file_.hasGrid(name)) continue;
        std::string line = std::string(kVolumeGridMissing) + printable(name);
        for (const std::string& there : names_)
            line += "\t" + printable(there);
        throw VdbError(line);
    }
}

VdbGrid VdbFile::read(const std::string& name) {
    const openvdb::GridBase::Ptr grid = guarded(name, [&] { return file_.readGrid(name); });
    VdbGrid out;
    out.name = name;
    if (!convert_any(grid, out.voxels)) unusable(name, "it holds no numbers: " + grid->type());
    out.object_from_index = guarded(name, [&] { return affine_transform(*grid, name); });
    return out;
}

}  // namespace lightsieve
