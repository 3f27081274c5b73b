// PNG, TIFF and JPEG pictures: quantisation, dithering and the file, nothing about colour.
//
// Values arrive as they are to be stored (already converted to the picture's colour space). Integers are clamped to
// [0,1] and rounded, NaN becomes 0. A file appears under its name only when it is complete (atomic_file.h).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace lightsieve {

enum class PictureFormat : std::uint8_t { Png, Tiff, Jpeg };
/// How one value is stored.
enum class PictureType : std::uint8_t { UInt8, UInt16, UInt32, Float };
enum class TiffCompression : std::uint8_t { None, Lzw, Rle, Zip };

struct PictureSpec {
    int width = 0, height = 0;
    int n_channels = 0;  ///< 1, 3 or 4 (the fourth is alpha; JPEG has none)
    PictureFormat format = PictureFormat::Png;
    PictureType type = PictureType::UInt8;
    TiffCompression compression = TiffCompression::Lzw;
    int quality = 100;  ///< JPEG: 1 to 100
    int tile_size = 0;  ///< TIFF: multiple of 16, or 0 for scanlines
    bool dither =
        false;  ///< UInt8 only: noise of one step, the same for every run, keeps the mean
    bool unassociated_alpha =
        false;  ///< colours are not multiplied by alpha; TIFF says so in its header
    float pixel_aspect_ratio = 1;
    std::map<std::string, std::string> metadata;  ///< text only
};

/// Value in [0,1] as an integer of 0..max, rounded; NaN gives 0.
[[nodiscard]] std::uint32_t quantize(float value, std::uint32_t max);

/// Writes a picture. pixels: height * width * n_channels, row 0 at the top.
/// throws  InputError: the folder or the disk refuses
void write_picture(const std::string& path, const PictureSpec& spec,
                   std::span<const float> pixels);

}  // namespace lightsieve
