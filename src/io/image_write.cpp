#include "io/image_write.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"

namespace lightsieve {

namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw InputError(Error{Code::FileUnwritable,
                           "cannot write \"" + path + "\": " + why,
                           {},
                           "check the free space of the disk",
                           {},
                           Severity::Error});
}

const char* compression_name(TiffCompression compression) {
    switch (compression) {
        case TiffCompression::None: return "none";
        case TiffCompression::Lzw: return "lzw";
        case TiffCompression::Rle: return "packbits";
        case TiffCompression::Zip: return "zip";
    }
    return "lzw";
}

OIIO::TypeDesc oiio_type(PictureType type) {
    switch (type) {
        case PictureType::UInt8: return OIIO::TypeUInt8;
        case PictureType::UInt16: return OIIO::TypeUInt16;
        case PictureType::UInt32: return OIIO::TypeUInt32;
        case PictureType::Float: return OIIO::TypeFloat;
    }
    return OIIO::TypeUInt8;
}

/// Uniform in [0,1), a function of the value's position alone.
/// Source: "lowbias32", the xor-shift-multiply hash of C. Wellons (hash prospector, 2018).
float dither_noise(std::size_t index) {
    auto x = static_cast<std::uint32_t>(index ^ (index >> 32)) + 0x9e3779b9U;
    x = (x ^ (x >> 16)) * 0x7feb352dU;
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    x ^= x >> 16;
    return static_cast<float>(x >> 8) * 0x1p-24F;
}

std::uint8_t dithered(float value, std::size_t index) {
    const float scaled = std::isnan(value) ? 0 : std::clamp(value, 0.0F, 1.0F) * 255;
    return static_cast<std::uint8_t>(std::min(scaled + dither_noise(index), 255.0F));
}

template <class T>
std::vector<std::byte> as_integers(std::span<const float> pixels, bool dither) {
    std::vector<std::byte> bytes(pixels.size() * sizeof(T));
    auto* out = reinterpret_cast<T*>(bytes.data());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        out[i] = dither && sizeof(T) == 1
                     ? static_cast<T>(dithered(pixels[i], i))
                     : static_cast<T>(quantize(pixels[i], static_cast<T>(~T{0})));
    }
    return bytes;
}

std::vector<std::byte> stored_bytes(const PictureSpec& spec, std::span<const float> pixels) {
    switch (spec.type) {
        case PictureType::UInt8: return as_integers<std::uint8_t>(pixels, spec.dither);
        case PictureType::UInt16: return as_integers<std::uint16_t>(pixels, false);
        case PictureType::UInt32: return as_integers<std::uint32_t>(pixels, false);
        case PictureType::Float: break;
    }
    const auto raw = std::as_bytes(pixels);
    return {raw.begin(), raw.end()};
}

const char* format_name(PictureFormat format) {
    switch (format) {
        case PictureFormat::Png: return "png";
        case PictureFormat::Tiff: return "tiff";
        case PictureFormat::Jpeg: return "jpeg";
    }
    return "tiff";
}

OIIO::ImageSpec oiio_spec(const PictureSpec& spec) {
    OIIO::ImageSpec out(spec.width, spec.height, spec.n_channels, oiio_type(spec.type));
    if (spec.n_channels == 4) out.alpha_channel = 3;
    // PNG has no premultiplied form and OpenImageIO would divide by alpha: what is handed over is to be stored.
    if (spec.unassociated_alpha || spec.format == PictureFormat::Png)
        out.attribute("oiio:UnassociatedAlpha", 1);
    if (spec.format == PictureFormat::Tiff) {
        out.attribute("compression", compression_name(spec.compression));
        out.tile_width = out.tile_height = spec.tile_size;
        out.tile_depth = spec.tile_size > 0 ? 1 : 0;
    }
    if (spec.format == PictureFormat::Jpeg) {
        out.attribute("CompressionQuality", std::clamp(spec.quality, 1, 100));
        out.attribute("jpeg:subsampling", "4:4:4");
    }
    if (spec.pixel_aspect_ratio != 1) out.attribute("PixelAspectRatio", spec.pixel_aspect_ratio);
    for (const auto& [name, text] : spec.metadata)
        out.attribute(name, text);
    return out;
}

}  // namespace

std::uint32_t quantize(float value, std::uint32_t max) {
    if (std::isnan(value)) return 0;
    // Double: 32-bit integers do not fit into a float.
    return static_cast<std::uint32_t>(std::clamp(static_cast<double>(value), 0.0, 1.0) * max +
                                      0.5);
}

void write_picture(const std::string& path, const PictureSpec& spec,
                   std::span<const float> pixels) {
    const std::size_t n = static_cast<std::size_t>(spec.width) *
                          static_cast<std::size_t>(spec.height) *
                          static_cast<std::size_t>(spec.n_channels);
    LIGHTSIEVE_ASSERT(pixels.size() == n, std::to_string(pixels.size()) +
                                              " values for a picture of " + std::to_string(n));
    AtomicFile file(path);
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(format_name(spec.format));
    if (!output) refuse(path, OIIO::geterror());
    if (!output->open(file.temporary(), oiio_spec(spec))) refuse(path, output->geterror());
    const std::vector<std::byte> bytes = stored_bytes(spec, pixels);
    if (!output->write_image(oiio_type(spec.type), bytes.data())) refuse(path, output->geterror());
    if (!output->close()) refuse(path, output->geterror());
    file.commit();
}

}  // namespace lightsieve
