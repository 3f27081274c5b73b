// Grids of an OpenVDB file as the two kinds that the renderer knows: floats and triples of floats.
//
// Doubles, integers, bools and masks become floats; double and integer vectors become vectors of floats. Points, texts and
// other kinds hold no numbers to look up and are left out, unless they are asked for.
#pragma once

#include <openvdb/openvdb.h>

#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "io/volume_stream.h"

namespace lightsieve {

/// Something wrong with the input; `what()` is the line for standard error.
struct VdbError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One grid, its transform taken off: what remains is in voxels.
struct VdbGrid {
    std::string name;
    std::variant<openvdb::FloatGrid::Ptr, openvdb::Vec3SGrid::Ptr> voxels;
    VolumeTransform object_from_index{};
};

class VdbFile {
  public:
    /// Opens a file and looks at its table of contents. throws VdbError and what OpenVDB throws
    explicit VdbFile(const std::string& path);
    ~VdbFile();
    VdbFile(const VdbFile&) = delete;
    VdbFile& operator=(const VdbFile&) = delete;

    /// Every grid of numbers, by name.
    [[nodiscard]] std::vector<std::string> names_of_numbers();
    /// throws VdbError unless all of `names` are there
    void check_names(const std::vector<std::string>& names) const;
    /// Reads one grid. throws VdbError: of no use; what OpenVDB throws
    [[nodiscard]] VdbGrid read(const std::string& name);

  private:
    openvdb::io::File file_;
    std::vector<std::string> names_;
};

}  // namespace lightsieve
