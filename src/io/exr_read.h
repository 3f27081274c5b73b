// Reads whole OpenEXR files: every channel of every part, and the header.
//
// For the exr tools and tests, not for textures. Files are not trusted: sizes are checked before memory is taken,
// and whatever OpenEXR objects to becomes an InputError.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "io/exr_write.h"

namespace lightsieve {

/// One channel with its pixels.
struct ExrReadChannel {
    std::string
        name;  ///< full name; "part.channel" where a part's channels do not begin with its name
    ExrPixelType type = ExrPixelType::Float;
    std::vector<float>
        pixels;  ///< data_height * data_width, row 0 at the top; UInt as the bits of a float; empty after read_exr_header
};

/// Whether a compression changes values of this type by more than sums of layers may be off.
[[nodiscard]] bool loses_precision(ExrCompression compression, ExrPixelType type);

struct ExrFile {
    int width = 0, height = 0;  ///< display window [pixels]
    int data_x = 0, data_y = 0, data_width = 0,
        data_height = 0;  ///< data window, relative to the display window
    float pixel_aspect_ratio = 1;
    bool tiled = false;
    int n_parts = 1;
    ExrCompression compression = ExrCompression::None;
    std::vector<ExrReadChannel> channels;  ///< of all parts
    std::map<std::string, ExrAttribute>
        attributes;  ///< ints, floats, strings, float arrays and matrices of the first part
    /// The channel of that full name, or null.
    [[nodiscard]] const ExrReadChannel* find(const std::string& name) const;
};

/// Pixels of all channels together above this are refused [bytes].
inline constexpr std::size_t kMaxExrBytes = std::size_t{8} << 30;

/// Only the header. throws InputError: missing, damaged, deep
[[nodiscard]] ExrFile read_exr_header(const std::string& path);
/// Header and pixels. throws InputError: missing, damaged or incomplete, deep, too large (limit-image-size)
[[nodiscard]] ExrFile read_exr(const std::string& path, std::size_t max_bytes = kMaxExrBytes);

}  // namespace lightsieve
