// Deep OpenEXR files: a list of samples in each pixel.
//
// The whole picture is handed over at once: OpenEXR takes deep rows from the top, and a row's lengths before its values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/exr_write.h"

namespace lightsieve {

/// Samples of all pixels of the data window, row by row.
struct DeepPixels {
    std::vector<std::uint32_t> counts;  ///< for each pixel
    std::vector<std::vector<float>>
        channels;  ///< for each channel of the part: a value for each sample
};

/// Writes a deep file, tiled or of scanlines, under a temporary name, then renames it.
///
/// spec    with one part; its compression is none, rle or zips
/// throws  InputError: the file cannot be created, the disk or OpenEXR refuses
void write_deep_exr(const std::string& path, const ExrWriteSpec& spec, const DeepPixels& pixels);

}  // namespace lightsieve
