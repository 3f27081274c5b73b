// Copies of OpenEXR files in which some channels have other pixels.
//
// What is done to a finished picture (denoising) must not touch what it is not about: parts, their order, windows, tiles,
// attributes of any type, and the bits of all other channels stay. Parts without a changed channel are copied as they are
// stored. A part with one is packed again, channels in their own types; where that would lose something (`loses_precision`), it becomes zip. Files are not trusted: read them with read_exr first, which checks them.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "io/exr_read.h"
#include "io/exr_write.h"

namespace lightsieve {

/// What is to differ.
struct ExrChanges {
    std::map<std::size_t, ExrPlane>
        channels;  ///< by index into ExrFile::channels: pixels of the data window
    std::map<std::string, ExrAttribute>
        attributes;  ///< added to every part's header, or replaced there
};

/// Writes a copy of `path` to `output`, which may be the same name, under a temporary name, then renames it.
///
/// throws  InputError: the file is missing, deep or has several levels of tiles; the disk or OpenEXR refuses
void rewrite_exr(const std::string& path, const std::string& output, const ExrChanges& changes);

}  // namespace lightsieve
