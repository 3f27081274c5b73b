// Drivers: where finished pixels go. One class a driver node.
//
// The renderer opens every driver before the first ray (so that an unwritable folder costs nothing), hands over
// finished buckets in any order from one thread at a time, and closes. Files appear under their name only at the end.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnostics.h"
#include "core/vec.h"

namespace lightsieve {

enum class PixelType : std::uint8_t { Half, Float, UInt };

/// One channel of a file.
struct ImageChannel {
    std::string name;  ///< as in the file: "R", "diffuse.R", "Z"
    PixelType type = PixelType::Float;
};

/// One layer: a run of channels that belong together.
struct ImageLayer {
    std::string name;            ///< as asked for: "RGBA", "diffuse_key"
    std::string aov;             ///< the AOV, before renaming
    std::string aov_type;        ///< "RGBA", "RGB", "FLOAT", "VECTOR", ...
    std::string expression;      ///< empty if it is no light path expression
    std::string light_group;     ///< empty if it is not restricted to one
    std::string filter;          ///< filter node type
    float filter_width = 0;      ///< [pixels]
    bool half = false;           ///< HALF was asked for this output
    bool is_color = true;        ///< colour-managed; false for N, P, Z, ...
    bool exact = false;          ///< every bit counts: 32-bit floats, packed without loss
    std::size_t n_channels = 0;  ///< 1 to 4, in the order of the buffers
};

/// Names of a layer's channels in its file: "diffuse.R", "N.X", "Z".
///
/// bare  without the layer's name: "R"; layers of one channel and of other types than colours keep it
[[nodiscard]] std::vector<std::string> channel_names(const ImageLayer& layer, bool bare);
/// Whether a layer is a beauty, whose channels are bare in every file.
[[nodiscard]] bool is_beauty(const ImageLayer& layer);

using MetadataValue = std::variant<int, float, std::string, std::vector<float>>;

/// Everything a driver needs to know before the first pixel.
struct ImageHeader {
    int width = 0, height = 0;                                    ///< full frame [pixels]
    int data_x = 0, data_y = 0, data_width = 0, data_height = 0;  ///< the part that is rendered
    float pixel_aspect_ratio = 1;
    int bucket_size =
        64;  ///< buckets are squares of this size on a grid that starts at data_x, data_y
    std::vector<ImageLayer> layers;
    std::map<std::string, MetadataValue>
        metadata;  ///< "arnold/..." and "lightsieve/..." attributes
};

/// A finished rectangle. UINT values travel as the bits of a float (std::bit_cast).
struct Bucket {
    int x = 0, y = 0, width = 0, height = 0;  ///< in frame pixels
    std::vector<std::span<const float>>
        layers;  ///< per layer: height * width * n_channels, row by row
};

/// The deep pixels of a finished rectangle: what each surface, or point in a medium, adds to its pixel. What is nearer does
/// not hide what is behind yet: opacities of a pixel add up to its alpha, and values to its flat colour.
struct DeepBucket {
    int x = 0, y = 0, width = 0, height = 0;  ///< in frame pixels
    std::vector<std::size_t> ends;  ///< for each pixel, row by row: one past its last sample
    std::vector<float> depths;      ///< for each sample: along the viewing axis
    std::vector<Color> opacities;   ///< for each sample
    std::vector<float>
        values;  ///< for each sample: the channels of all layers but alpha, layer after layer
};

/// What a driver will take [bytes].
struct OutputForecast {
    std::size_t memory = 0;      ///< pixels that wait until they can be written, at most
    std::size_t file_bytes = 0;  ///< pixels in the file, before compression
};

class Driver {
  public:
    virtual ~Driver() = default;
    /// What writing this will take; the file is not touched.
    [[nodiscard]] virtual OutputForecast forecast(const ImageHeader& header) const = 0;
    /// Wants deep pixels (write_deep) in place of flat ones (write).
    [[nodiscard]] virtual bool deep() const { return false; }
    /// As write.
    virtual void write_deep(const DeepBucket& /*bucket*/) {}
    /// The file that will be written, after -o and searching; for messages.
    [[nodiscard]] virtual std::string path() const = 0;
    /// Opens the temporary file. Reports and returns false if that is impossible.
    [[nodiscard]] virtual bool open(const ImageHeader& header, Diagnostics& diagnostics) = 0;
    /// Not thread safe: the renderer calls it from one thread at a time. Each bucket once.
    virtual void write(const Bucket& bucket) = 0;
    /// Writes what is missing as zero, closes, renames to the final name. False with a report if the disk refuses.
    [[nodiscard]] virtual bool close(Diagnostics& diagnostics) = 0;
};

}  // namespace lightsieve
