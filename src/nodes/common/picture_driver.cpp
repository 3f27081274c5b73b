#include "nodes/common/picture_driver.h"

#include <algorithm>
#include <filesystem>

#include "core/memory.h"
#include "io/atomic_file.h"
#include "io/image_read.h"

namespace lightsieve {

namespace {

/// TIFF tiles are multiples of 16.
constexpr int kTileSize = 64;

/// 8-bit pictures are for display; others keep the rendering space.
ColorSpace automatic_space(const PictureOptions& options, const ColorSpaces& spaces) {
    return options.type == PictureType::UInt8 ? spaces.integers() : spaces.rendering();
}

bool is_integer(const ImageLayer& layer) {
    return layer.aov_type == "UINT" || layer.aov_type == "INT";
}

}  // namespace

PictureDriver::PictureDriver(Name filename, Name color_space, const PictureOptions& options,
                             NodeContext& context)
    : path_(filename.str()),
      where_(context.where("filename")),
      options_(options),
      conversion_(context.color_spaces().rendering(),
                  context.color_spaces().resolve(
                      color_space.view(), automatic_space(options, context.color_spaces()),
                      context.diagnostics(), context.where("color_space"))) {}

bool PictureDriver::fits(const ImageHeader& header, Diagnostics& diagnostics) const {
    if (header.layers.size() != 1) {
        std::string names;
        for (const ImageLayer& layer : header.layers)
            names += (names.empty() ? "\"" : ", \"") + layer.name + "\"";
        diagnostics.error(Code::OutputLayers,
                          "\"" + path_ + "\" can hold one layer, not " +
                              std::to_string(header.layers.size()) +
                              (names.empty() ? "" : ": " + names),
                          where_, "use driver_exr, or a driver for each output");
        return false;
    }
    if (is_integer(header.layers[0])) {
        diagnostics.error(Code::OutputLayers,
                          "\"" + path_ + "\" cannot hold the numbers of layer \"" +
                              header.layers[0].name + "\" of type " + header.layers[0].aov_type,
                          where_, "use driver_exr");
        return false;
    }
    return true;
}

namespace {

/// Of one value in the file.
std::size_t bytes_of(PictureType type) {
    switch (type) {
        case PictureType::UInt8: return 1;
        case PictureType::UInt16: return 2;
        case PictureType::UInt32:
        case PictureType::Float: break;
    }
    return 4;
}

}  // namespace

OutputForecast PictureDriver::forecast(const ImageHeader& header) const {
    const bool padded = options_.output_padded;
    const std::size_t n_channels = header.layers.empty() ? 0 : header.layers[0].n_channels,
                      n_stored =
                          options_.skip_alpha ? std::min<std::size_t>(n_channels, 3) : n_channels;
    const std::size_t n_values =
        static_cast<std::size_t>(padded ? header.width : header.data_width) *
        static_cast<std::size_t>(padded ? header.height : header.data_height) *
        (n_stored == 2 ? 3 : n_stored);
    return {n_values * sizeof(float), n_values * bytes_of(options_.type)};
}

bool PictureDriver::open(const ImageHeader& header, Diagnostics& diagnostics) {
    if (!fits(header, diagnostics)) return false;
    layer_ = header.layers[0];
    const bool padded = options_.output_padded;
    left_ = padded ? 0 : header.data_x;
    top_ = padded ? 0 : header.data_y;
    spec_.width = padded ? header.width : header.data_width;
    spec_.height = padded ? header.height : header.data_height;
    // Two channels (VECTOR2) become three: in these formats two would be grey and alpha.
    const std::size_t n_stored =
        options_.skip_alpha ? std::min<std::size_t>(layer_.n_channels, 3) : layer_.n_channels;
    spec_.n_channels = n_stored == 2 ? 3 : static_cast<int>(n_stored);
    spec_.format = options_.format;
    spec_.type = options_.type;
    spec_.compression = options_.compression;
    spec_.tile_size = options_.tiled ? kTileSize : 0;
    spec_.quality = options_.quality;
    spec_.dither = options_.dither && layer_.is_color;
    spec_.unassociated_alpha = options_.unpremult_alpha && options_.type == PictureType::UInt8;
    spec_.pixel_aspect_ratio = header.pixel_aspect_ratio;
    if (const auto it = header.metadata.find("lightsieve/version");
        it != header.metadata.end() && std::holds_alternative<std::string>(it->second)) {
        spec_.metadata["Software"] = "Lightsieve " + std::get<std::string>(it->second);
    }
    const std::size_t n_values = static_cast<std::size_t>(spec_.width) *
                                 static_cast<std::size_t>(spec_.height) *
                                 static_cast<std::size_t>(spec_.n_channels);
    if (n_values > available_memory() / sizeof(float)) {
        diagnostics.error(Code::LimitMemory,
                          "\"" + path_ + "\" needs " +
                              std::to_string((n_values * sizeof(float)) >> 20U) +
                              " MiB of memory, more than there is",
                          where_, "driver_exr with tiles needs none of that");
        return false;
    }
    pixels_.assign(n_values, 0.0F);
    if (options_.append) take_over(diagnostics);
    try {
        const AtomicFile writable(path_);  // found out before the first ray; removed at once
    } catch (const InputError& e) {
        diagnostics.add(e, where_);
        return false;
    }
    return true;
}

void PictureDriver::take_over(Diagnostics& diagnostics) {
    std::error_code ignored;
    if (!std::filesystem::exists(path_, ignored)) return;
    try {
        StoredImage old = read_stored_image(path_);
        if (old.width == spec_.width && old.height == spec_.height &&
            old.n_channels == spec_.n_channels) {
            pixels_ = std::move(old.values);
            return;
        }
        diagnostics.warning(Code::InvalidValue,
                            "\"" + path_ +
                                "\" is written anew: it has another size or other "
                                "channels, so there is nothing to go on with",
                            where_, "with output_padded a file has the size of the frame");
    } catch (const InputError& e) {
        diagnostics.warning(Code::InvalidValue,
                            "\"" + path_ + "\" is written anew: " + e.errors()[0].message, where_);
    }
}

void PictureDriver::store(const float* pixel, float* out) const {
    const std::size_t n = layer_.n_channels;
    std::copy_n(pixel, std::min(n, static_cast<std::size_t>(spec_.n_channels)), out);
    if (!layer_.is_color) return;
    if (n < 3) {
        out[0] = conversion_.grey(pixel[0]);
        return;
    }
    Color c{pixel[0], pixel[1], pixel[2]};
    // Conversion acts on what is stored: multiplied colours, unless they are divided first.
    if (spec_.unassociated_alpha && n == 4 && pixel[3] > 0) c = c * (1 / pixel[3]);
    c = conversion_(c);
    for (int k = 0; k < 3; ++k)
        out[k] = c[k];
}

void PictureDriver::write(const Bucket& bucket) {
    const std::size_t n = layer_.n_channels;
    for (int y = 0; y < bucket.height; ++y) {
        for (int x = 0; x < bucket.width; ++x) {
            const int to_x = bucket.x + x - left_, to_y = bucket.y + y - top_;
            if (to_x < 0 || to_y < 0 || to_x >= spec_.width || to_y >= spec_.height) continue;
            const std::size_t from =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(bucket.width) +
                static_cast<std::size_t>(x);
            const std::size_t to =
                static_cast<std::size_t>(to_y) * static_cast<std::size_t>(spec_.width) +
                static_cast<std::size_t>(to_x);
            store(bucket.layers[0].data() + from * n,
                  pixels_.data() + to * static_cast<std::size_t>(spec_.n_channels));
        }
    }
}

bool PictureDriver::close(Diagnostics& diagnostics) {
    if (pixels_.empty()) return false;
    try {
        write_picture(path_, spec_, pixels_);
    } catch (const InputError& e) {
        diagnostics.add(e, where_);
        return false;
    }
    return true;
}

}  // namespace lightsieve
