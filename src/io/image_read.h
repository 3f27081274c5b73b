// Whole pictures in memory, in the rendering space: environment maps, comparisons.
//
// Reads whatever OpenImageIO reads. For textures that are looked up at random see texture.h.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/color.h"
#include "core/diagnostics.h"

namespace lightsieve {

/// A colour picture; row 0 is the top.
struct ColorImage {
    int width = 0, height = 0;
    std::vector<Color> pixels;  ///< height * width, linear in the rendering space
    [[nodiscard]] Color at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

/// Pictures above this are refused: 32768 x 16384.
inline constexpr std::size_t kMaxImagePixels = std::size_t{1} << 29;

/// Reads the first picture of a file. Files without colour give grey.
///
/// color_space  as for textures: "auto", "" raw, or a name
/// throws       InputError: missing, damaged, deep or too large
[[nodiscard]] ColorImage read_color_image(const std::string& path, std::string_view color_space,
                                          Diagnostics& diagnostics, const SourceSpan& where = {},
                                          std::size_t max_pixels = kMaxImagePixels);

/// A picture's values as they are stored: integers as parts of their greatest value, nothing converted.
struct StoredImage {
    int width = 0, height = 0, n_channels = 0;
    std::vector<float> values;  ///< height * width * n_channels, row 0 at the top
};
/// Reads the first picture of a file that `write_picture` wrote, to write it again: integers survive that, also with dither.
/// throws  InputError as read_color_image
[[nodiscard]] StoredImage read_stored_image(const std::string& path,
                                            std::size_t max_pixels = kMaxImagePixels);

}  // namespace lightsieve
