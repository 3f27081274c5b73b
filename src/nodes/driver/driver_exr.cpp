// driver_exr: any number of layers in one OpenEXR file, rendering-space values unless told otherwise.
//
// Channel names and header attributes follow Arnold's, so that tools which read its files read these.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include "core/color.h"
#include "io/atomic_file.h"
#include "io/exr_read.h"
#include "io/exr_write.h"
#include "nodes/common/exr_canvas.h"
#include "nodes/common/exr_layers.h"
#include "scene/describe.h"
#include "scene/driver.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

/// In Arnold's order.
enum class Compression : std::int32_t { None, Rle, Zip, Zips, Piz, Pxr24, B44, B44a, Dwaa, Dwab };

struct DriverExr {
    Name filename;
    Compression compression = Compression::Zip;
    bool half_precision = false, tiled = true, preserve_layer_name = false, autocrop = false,
         append = false, multipart = false;
    Name color_space = "auto";
    Array<Name> custom_attributes;
    NodeRef input;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Driver> make_driver(NodeContext& context) const;
};

NodeType DriverExr::describe() {
    Describe<DriverExr> d("driver_exr", NodeKind::Driver, "Writes layers into an OpenEXR file.");
    d.param("filename", &DriverExr::filename,
            "The file; relative names are relative to where the command is run, or to -o.");
    d.param("compression", &DriverExr::compression,
            "How pixels are packed; pxr24 (floats), b44, b44a, dwaa and dwab lose precision.")
        .names({"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"});
    d.param("half_precision", &DriverExr::half_precision,
            "Stores 16-bit instead of 32-bit floats.");
    d.param("tiled", &DriverExr::tiled,
            "Tiles, written as they are rendered, instead of scanlines.");
    d.param("preserve_layer_name", &DriverExr::preserve_layer_name,
            "Keeps the layer's name in the channels of a file with one layer.");
    d.param("autocrop", &DriverExr::autocrop, "Cuts the file's data window to what is not 0.");
    d.param("append", &DriverExr::append,
            "Goes on with a file that is there, if it has the same layers: what is not rendered "
            "stays.");
    d.param("multipart", &DriverExr::multipart, "A part of its own for each layer.");
    d.param(
        "color_space", &DriverExr::color_space,
        "What the file's colours are converted to; auto and empty: nothing, they stay ACEScg.");
    d.param("custom_attributes", &DriverExr::custom_attributes,
            "Additional header attributes, each \"TYPE name value\" with TYPE one of INT, FLOAT, "
            "STRING, VECTOR2, VECTOR, MATRIX.");
    d.param("input", &DriverExr::input,
            "The last of a chain of imagers, which change colours before they are written.");
    return d.done();
}

bool is_uint(const ImageLayer& layer) {
    return layer.aov_type == "UINT" || layer.aov_type == "INT";
}

/// Numbers separated by blanks; empty if there is anything else or not `n` of them.
std::vector<float> read_floats(std::istream& in, std::size_t n) {
    std::vector<float> values;
    for (float v = 0; in >> v;)
        values.push_back(v);
    return in.eof() && values.size() == n ? values : std::vector<float>{};
}

/// Reads "TYPE name value". False if it is malformed.
bool read_attribute(const std::string& text, std::map<std::string, ExrAttribute>& attributes) {
    std::istringstream in(text);
    std::string type, name;
    in >> type >> name >> std::ws;
    if (name.empty()) return false;
    if (type == "STRING") {
        std::string value;
        std::getline(in, value);
        attributes[name] = value;
        return true;
    }
    if (type == "INT") {
        int value = 0;
        if (!(in >> value) || !(in >> std::ws).eof()) return false;
        attributes[name] = value;
        return true;
    }
    const std::size_t n = type == "FLOAT"     ? 1
                          : type == "VECTOR2" ? 2
                          : type == "VECTOR"  ? 3
                          : type == "MATRIX"  ? 16
                                              : 0;
    const std::vector<float> values = n > 0 ? read_floats(in, n) : std::vector<float>{};
    if (values.empty()) return false;
    attributes[name] = n == 1 ? ExrAttribute(values[0]) : ExrAttribute(values);
    return true;
}

/// The channel of an older file that holds what a channel of a new one will.
const ExrReadChannel* old_channel(const ExrFile& old, const ExrPart& part,
                                  const ExrChannel& channel) {
    const ExrReadChannel* found = old.find(channel.name);
    return found != nullptr ? found : old.find(part.name + "." + channel.name);
}

/// Widens the data window to hold an older one, too.
void widen(ExrWriteSpec& spec, const ExrFile& old) {
    const int right = std::max(spec.data_x + spec.data_width, old.data_x + old.data_width),
              bottom = std::max(spec.data_y + spec.data_height, old.data_y + old.data_height);
    spec.data_x = std::min(spec.data_x, old.data_x);
    spec.data_y = std::min(spec.data_y, old.data_y);
    spec.data_width = right - spec.data_x;
    spec.data_height = bottom - spec.data_y;
}

class ExrDriver final : public Driver {
  public:
    ExrDriver(const DriverExr& node, NodeContext& context)
        : node_(node),
          path_(node.filename.str()),
          where_(context.where("filename")),
          compression_where_(context.where("compression")),
          space_(context.color_spaces().resolve(
              node.color_space.view(), context.color_spaces().rendering(), context.diagnostics(),
              context.where("color_space"))),
          conversion_(context.color_spaces().rendering(), space_) {
        for (const Name& attribute : node.custom_attributes.first_key()) {
            if (read_attribute(attribute.str(), attributes_)) continue;
            context.diagnostics().warning(
                Code::InvalidValue,
                "the attribute \"" + attribute.str() + "\" cannot be read and is left out",
                context.where("custom_attributes"),
                "write \"TYPE name value\" with TYPE one of INT, FLOAT, STRING, VECTOR2, VECTOR, "
                "MATRIX");
        }
    }

    [[nodiscard]] std::string path() const override { return path_; }
    [[nodiscard]] OutputForecast forecast(const ImageHeader& header) const override;
    [[nodiscard]] bool open(const ImageHeader& header, Diagnostics& diagnostics) override;
    void write(const Bucket& bucket) override;
    [[nodiscard]] bool close(Diagnostics& diagnostics) override;

  private:
    /// The beauty, and a colour layer that is alone, have bare R, G, B, A.
    [[nodiscard]] std::vector<std::string> names_of(const ImageLayer& layer,
                                                    const ImageHeader& header) const {
        const bool alone = header.layers.size() == 1 && !node_.preserve_layer_name;
        return channel_names(layer, alone || is_beauty(layer));
    }
    [[nodiscard]] ExrWriteSpec make_spec(const ImageHeader& header) const;
    [[nodiscard]] bool names_are_distinct(const ImageHeader& header,
                                          Diagnostics& diagnostics) const;
    /// The layer's pixels as they are to be stored; points into `converted_` if they had to be converted.
    [[nodiscard]] const float* stored_pixels(const ImageLayer& layer,
                                             std::span<const float> pixels,
                                             std::vector<float>& converted) const;
    /// The file that is there, if its pixels can be gone on with.
    [[nodiscard]] std::optional<ExrFile> old_file(const ExrWriteSpec& spec,
                                                  Diagnostics& diagnostics) const;
    void write_around(const ImageHeader& header, const ExrWriteSpec& spec, const ExrFile& old);
    void write_planes(int x, int y, int width, int height, std::span<const ExrPlane> planes);
    void keep_exact(const ImageHeader& header, Diagnostics& diagnostics);

    DriverExr node_;
    std::string path_;
    SourceSpan where_, compression_where_;
    ColorSpace space_;
    ColorConversion conversion_;
    std::map<std::string, ExrAttribute> attributes_;
    std::vector<ImageLayer> layers_;
    std::vector<std::vector<float>> converted_;  ///< one a layer, kept for its memory
    std::unique_ptr<ExrWriter> writer_;
    std::unique_ptr<ExrCanvas> canvas_;    ///< in place of a writer, with autocrop
    std::unique_ptr<InputError> failure_;  ///< of a write; reported when the file is closed
};

ExrWriteSpec ExrDriver::make_spec(const ImageHeader& header) const {
    ExrWriteSpec spec = exr_spec(header, node_.tiled, space_.primaries);
    spec.compression = static_cast<ExrCompression>(node_.compression);
    // What the scene says wins over what we say.
    for (const auto& [name, value] : attributes_)
        spec.attributes[name] = value;
    for (const ImageLayer& layer : header.layers) {
        const bool half = (node_.half_precision || layer.half) && !layer.exact;
        const ExrPixelType type = is_uint(layer) ? ExrPixelType::UInt
                                  : half         ? ExrPixelType::Half
                                                 : ExrPixelType::Float;
        if (spec.parts.empty() || node_.multipart) spec.parts.push_back({layer.name, {}});
        for (std::string& name : names_of(layer, header))
            spec.parts.back().channels.push_back({std::move(name), type});
        describe_exr_layer(layer, spec.attributes);
    }
    return spec;
}

OutputForecast ExrDriver::forecast(const ImageHeader& header) const {
    const ExrWriteSpec spec = make_spec(header);
    const auto width = static_cast<std::size_t>(spec.data_width),
               height = static_cast<std::size_t>(spec.data_height),
               side = static_cast<std::size_t>(spec.tile_size);
    std::size_t n_channels = 0, bytes = 0;
    for (const ExrPart& part : spec.parts)
        for (const ExrChannel& channel : part.channels) {
            ++n_channels;
            bytes += channel.type == ExrPixelType::Half ? 2 : 4;
        }
    OutputForecast out{0, width * height * bytes};
    if (node_.autocrop)
        out.memory = width * height * n_channels * sizeof(float);
    else if (spec.tiled && spec.tile_size == header.bucket_size)
        out.memory = side * side * bytes;
    else  // Bands of rows that are not complete yet.
        out.memory =
            2 * width * std::min(std::max(side, std::size_t(header.bucket_size)), height) * bytes;
    std::error_code ignored;
    if (node_.append && std::filesystem::exists(path_, ignored))
        out.memory += width * height * n_channels * sizeof(float);
    return out;
}

bool ExrDriver::names_are_distinct(const ImageHeader& header, Diagnostics& diagnostics) const {
    std::map<std::string, std::string> owner;
    for (const ImageLayer& layer : header.layers) {
        for (const std::string& name : names_of(layer, header)) {
            const auto [it, added] = owner.emplace(name, layer.name);
            if (added) continue;
            diagnostics.error(Code::OutputLayers,
                              "layers \"" + it->second + "\" and \"" + layer.name + "\" of \"" +
                                  path_ + "\" both have the channel \"" + name + "\"",
                              where_, "give one of the outputs a layer name, or remove it");
            return false;
        }
    }
    return true;
}

/// Ids would become others if packing them lost a bit.
void ExrDriver::keep_exact(const ImageHeader& header, Diagnostics& diagnostics) {
    const bool loses = node_.compression == Compression::Pxr24 ||
                       node_.compression == Compression::Dwaa ||
                       node_.compression == Compression::Dwab;
    const auto exact = std::find_if(header.layers.begin(), header.layers.end(),
                                    [](const ImageLayer& layer) { return layer.exact; });
    if (!loses || exact == header.layers.end()) return;
    diagnostics.warning(Code::InvalidValue,
                        "\"" + path_ + "\" is packed by zip: the ids of \"" + exact->name +
                            "\" would not survive a compression with losses",
                        compression_where_, "choose zip, or give the mattes a file of their own");
    node_.compression = Compression::Zip;
}

bool ExrDriver::open(const ImageHeader& header, Diagnostics& diagnostics) {
    if (!names_are_distinct(header, diagnostics)) return false;
    keep_exact(header, diagnostics);
    layers_ = header.layers;
    converted_.assign(layers_.size(), {});
    ExrWriteSpec spec = make_spec(header);
    const std::optional<ExrFile> old = node_.append ? old_file(spec, diagnostics) : std::nullopt;
    if (old) widen(spec, *old);
    try {
        if (node_.autocrop) {
            const AtomicFile writable(path_);  // found out before the first ray; removed at once
            canvas_ = std::make_unique<ExrCanvas>(spec);
        } else {
            writer_ = std::make_unique<ExrWriter>(path_, spec);
        }
        if (old) write_around(header, spec, *old);
    } catch (const InputError& e) {
        diagnostics.add(e, where_);
        return false;
    }
    return true;
}

std::optional<ExrFile> ExrDriver::old_file(const ExrWriteSpec& spec,
                                           Diagnostics& diagnostics) const {
    std::error_code ignored;
    if (!std::filesystem::exists(path_, ignored)) return std::nullopt;
    std::string why = "its frame or its layers are others";
    try {
        ExrFile old = read_exr(path_);
        bool same = old.width == spec.width && old.height == spec.height;
        std::size_t n = 0;
        for (const ExrPart& part : spec.parts)
            for (const ExrChannel& channel : part.channels) {
                const ExrReadChannel* found = old_channel(old, part, channel);
                same = same && found != nullptr && found->type == channel.type;
                ++n;
            }
        if (same && n == old.channels.size()) return old;
    } catch (const InputError& e) {
        why = e.errors()[0].message;
    }
    diagnostics.warning(Code::InvalidValue, "\"" + path_ + "\" is written anew: " + why, where_,
                        "append goes on with files of the same driver and outputs");
    return std::nullopt;
}

/// Hands over the old pixels above, below, left and right of what will be rendered.
void ExrDriver::write_around(const ImageHeader& header, const ExrWriteSpec& spec,
                             const ExrFile& old) {
    const int x0 = old.data_x, y0 = old.data_y, x1 = x0 + old.data_width,
              y1 = y0 + old.data_height;
    const int left = std::clamp(header.data_x, x0, x1), top = std::clamp(header.data_y, y0, y1);
    const int right = std::clamp(header.data_x + header.data_width, left, x1);
    const int bottom = std::clamp(header.data_y + header.data_height, top, y1);
    const auto hand_over = [&](int ax, int ay, int bx, int by) {
        if (ax >= bx || ay >= by) return;
        std::vector<ExrPlane> planes;
        for (const ExrPart& part : spec.parts)
            for (const ExrChannel& channel : part.channels)
                planes.push_back({old_channel(old, part, channel)->pixels.data() +
                                      static_cast<std::ptrdiff_t>(ay - y0) * old.data_width +
                                      (ax - x0),
                                  1, old.data_width});
        write_planes(ax, ay, bx - ax, by - ay, planes);
    };
    hand_over(x0, y0, x1, top);
    hand_over(x0, bottom, x1, y1);
    hand_over(x0, top, left, bottom);
    hand_over(right, top, x1, bottom);
}

void ExrDriver::write_planes(int x, int y, int width, int height,
                             std::span<const ExrPlane> planes) {
    if (canvas_)
        canvas_->write(x, y, width, height, planes);
    else
        writer_->write(x, y, width, height, planes);
}

const float* ExrDriver::stored_pixels(const ImageLayer& layer, std::span<const float> pixels,
                                      std::vector<float>& converted) const {
    if (conversion_.identity() || !layer.is_color || is_uint(layer)) return pixels.data();
    converted.assign(pixels.begin(), pixels.end());
    const std::size_t n = layer.n_channels;
    for (std::size_t i = 0; i + n <= converted.size(); i += n) {
        if (n < 3) {
            converted[i] = conversion_.grey(converted[i]);
            continue;
        }
        const Color c = conversion_({converted[i], converted[i + 1], converted[i + 2]});
        for (int k = 0; k < 3; ++k)
            converted[i + static_cast<std::size_t>(k)] = c[k];
    }
    return converted.data();
}

void ExrDriver::write(const Bucket& bucket) {
    if ((!writer_ && !canvas_) || failure_) return;
    std::vector<ExrPlane> planes;
    for (std::size_t l = 0; l < layers_.size(); ++l) {
        const auto n = static_cast<std::ptrdiff_t>(layers_[l].n_channels);
        const float* pixels = stored_pixels(layers_[l], bucket.layers[l], converted_[l]);
        for (std::ptrdiff_t c = 0; c < n; ++c)
            planes.push_back({pixels + c, n, n * bucket.width});
    }
    try {
        write_planes(bucket.x, bucket.y, bucket.width, bucket.height, planes);
    } catch (const InputError& e) {
        failure_ = std::make_unique<InputError>(e);
        writer_.reset();
    }
}

bool ExrDriver::close(Diagnostics& diagnostics) {
    if (failure_) {
        diagnostics.add(*failure_, where_);
        return false;
    }
    if (!writer_ && !canvas_) return false;
    try {
        if (canvas_)
            canvas_->save(path_);
        else
            writer_->close();
    } catch (const InputError& e) {
        writer_.reset();
        diagnostics.add(e, where_);
        return false;
    }
    writer_.reset();
    return true;
}

std::unique_ptr<Driver> DriverExr::make_driver(NodeContext& context) const {
    return std::make_unique<ExrDriver>(*this, context);
}

}  // namespace

NodeType node_driver_exr() { return DriverExr::describe(); }

}  // namespace lightsieve
