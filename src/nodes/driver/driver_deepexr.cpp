// driver_deepexr: every surface along the camera's rays by its depth, for compositing with depth.
//
// The file has A, Z and ZBack, and the channels of its layers of light. Flattened it is what driver_exr writes, but for
// what tolerances allow.
#include <algorithm>
#include <optional>

#include "io/atomic_file.h"
#include "io/exr_deep.h"
#include "nodes/common/deep_merge.h"
#include "nodes/common/exr_layers.h"
#include "scene/describe.h"
#include "scene/driver.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct DriverDeepExr {
    Name filename = "deep.exr";
    bool tiled = false, append = false, subpixel_merge = true, use_rgb_opacity = false;
    float alpha_tolerance = 0.01F, depth_tolerance = 0.01F;
    bool alpha_half_precision = false, depth_half_precision = false;
    Array<float> layer_tolerance;
    Array<bool> layer_enable_filtering, layer_half_precision;
    NodeRef input;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Driver> make_driver(NodeContext& context) const;
};

NodeType DriverDeepExr::describe() {
    using Node = DriverDeepExr;
    Describe<Node> d("driver_deepexr", NodeKind::Driver,
                     "Writes layers of light into a deep OpenEXR file.");
    d.param("filename", &Node::filename,
            "The file; relative names are relative to where the command is run, or to -o.");
    d.param("tiled", &Node::tiled, "Tiles instead of scanlines.");
    d.param("append", &Node::append, "Goes on with a file that is there.").pending();
    d.param("subpixel_merge", &Node::subpixel_merge,
            "Samples of a pixel are merged as far as the tolerances allow.");
    d.param("use_RGB_opacity", &Node::use_rgb_opacity, "An opacity for each colour.").pending();
    d.param("alpha_tolerance", &Node::alpha_tolerance,
            "What the opacity in front of a point may be off by; below 0: only depth counts.");
    d.param("depth_tolerance", &Node::depth_tolerance, "Samples that lie within it are one.")
        .unit("scene units");
    d.param("alpha_half_precision", &Node::alpha_half_precision,
            "Stores alpha as 16-bit instead of 32-bit floats.");
    d.param("depth_half_precision", &Node::depth_half_precision, "The same for depths.");
    d.param(
        "layer_tolerance", &Node::layer_tolerance,
        "For each output: what the light in front of a point may be off by; the last one holds "
        "for all that follow.");
    d.param("layer_enable_filtering", &Node::layer_enable_filtering,
            "Whether a layer is filtered; here all are.")
        .ignored();
    d.param("layer_half_precision", &Node::layer_half_precision,
            "For each output: stores 16-bit instead of 32-bit floats; the last one holds for all "
            "that follow.");
    d.param("input", &Node::input,
            "The last of a chain of imagers; the picture is written without their changes.")
        .pending();
    return d.done();
}

class DeepExrDriver final : public Driver {
  public:
    DeepExrDriver(const DriverDeepExr& node, NodeContext& context)
        : node_(node),
          path_(node.filename.str()),
          where_(context.where("filename")),
          primaries_(context.color_spaces().rendering().primaries) {}

    [[nodiscard]] bool deep() const override { return true; }
    [[nodiscard]] std::string path() const override { return path_; }
    /// As if every pixel held one sample: nobody knows how many there will be.
    [[nodiscard]] OutputForecast forecast(const ImageHeader& header) const override;
    [[nodiscard]] bool open(const ImageHeader& header, Diagnostics& diagnostics) override;
    void write(const Bucket&) override {}
    void write_deep(const DeepBucket& bucket) override;
    [[nodiscard]] bool close(Diagnostics& diagnostics) override;

  private:
    template <class T>
    [[nodiscard]] T of_layer(const Array<T>& values, std::size_t layer, T none) const {
        return values.empty() ? none : values[std::min<std::size_t>(layer, values.n - 1)];
    }
    void add_layer(const ImageLayer& layer, std::size_t index);

    DriverDeepExr node_;
    std::string path_;
    SourceSpan where_;
    Primaries primaries_;  ///< of the rendering space
    std::optional<ExrWriteSpec> spec_;
    std::size_t n_values_ = 0;
    std::vector<float> value_tolerance_;  ///< by value
    std::vector<DeepRun> pixels_;         ///< of the data window, row by row
};

/// The layer's channels but alpha, which all layers share.
void DeepExrDriver::add_layer(const ImageLayer& layer, std::size_t index) {
    const bool half = layer.half || of_layer(node_.layer_half_precision, index, false);
    const ExrPixelType type = half ? ExrPixelType::Half : ExrPixelType::Float;
    const std::size_t n = std::min<std::size_t>(layer.n_channels, 3);
    const bool bare = n == 3 && (layer.name == "RGBA" || layer.name == "RGB");
    for (std::size_t c = 0; c < n; ++c) {
        const std::string letter(1, "RGB"[c]);
        spec_->parts[0].channels.push_back({n == 1 ? layer.name
                                            : bare ? letter
                                                   : layer.name + "." + letter,
                                            type});
        value_tolerance_.push_back(of_layer(node_.layer_tolerance, index, -1.0F));
    }
    n_values_ += n;
    describe_exr_layer(layer, spec_->attributes);
}

OutputForecast DeepExrDriver::forecast(const ImageHeader& header) const {
    std::size_t n_values = 3;  // alpha and two depths
    for (const ImageLayer& layer : header.layers)
        n_values += std::min<std::size_t>(layer.n_channels, 3);
    const std::size_t n_pixels = static_cast<std::size_t>(header.data_width) *
                                 static_cast<std::size_t>(header.data_height),
                      pixels = n_pixels * n_values * sizeof(float);
    // Runs by pixel, and in the end all channels once more.
    return {n_pixels * sizeof(DeepRun) + 2 * pixels, pixels};
}

bool DeepExrDriver::open(const ImageHeader& header, Diagnostics& diagnostics) {
    ExrWriteSpec& spec = spec_.emplace(exr_spec(header, node_.tiled, primaries_));
    spec.compression = ExrCompression::Zips;
    // Sums of layers are proved for flat files.
    spec.attributes.erase("lightsieve/partitions");
    const auto type = [](bool half) { return half ? ExrPixelType::Half : ExrPixelType::Float; };
    spec.parts.push_back({"deep",
                          {{"A", type(node_.alpha_half_precision)},
                           {"Z", type(node_.depth_half_precision)},
                           {"ZBack", type(node_.depth_half_precision)}}});
    n_values_ = 0;
    value_tolerance_.clear();
    for (std::size_t i = 0; i < header.layers.size(); ++i)
        add_layer(header.layers[i], i);
    pixels_.assign(
        static_cast<std::size_t>(spec.data_width) * static_cast<std::size_t>(spec.data_height),
        {});
    try {
        const AtomicFile writable(path_);  // found out before the first ray; removed at once
    } catch (const InputError& e) {
        spec_.reset();
        diagnostics.add(e, where_);
        return false;
    }
    return true;
}

void DeepExrDriver::write_deep(const DeepBucket& bucket) {
    if (!spec_) return;
    const DeepTolerance tolerance{node_.subpixel_merge, node_.depth_tolerance,
                                  node_.alpha_tolerance, value_tolerance_};
    std::size_t begin = 0;
    for (int y = 0; y < bucket.height; ++y)
        for (int x = 0; x < bucket.width; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(bucket.width) +
                static_cast<std::size_t>(x);
            const std::size_t n = bucket.ends[pixel] - begin;
            const std::size_t to = static_cast<std::size_t>(bucket.y + y - spec_->data_y) *
                                       static_cast<std::size_t>(spec_->data_width) +
                                   static_cast<std::size_t>(bucket.x + x - spec_->data_x);
            pixels_[to] =
                merge_deep(std::span(bucket.depths).subspan(begin, n),
                           std::span(bucket.opacities).subspan(begin, n),
                           std::span(bucket.values).subspan(begin * n_values_, n * n_values_),
                           n_values_, tolerance);
            begin = bucket.ends[pixel];
        }
}

bool DeepExrDriver::close(Diagnostics& diagnostics) {
    if (!spec_) return false;
    DeepPixels out;
    out.channels.resize(3 + n_values_);
    for (const DeepRun& run : pixels_) {
        out.counts.push_back(static_cast<std::uint32_t>(run.front.size()));
        for (std::size_t i = 0; i < run.front.size(); ++i) {
            out.channels[0].push_back(run.alpha[i]);
            out.channels[1].push_back(run.front[i]);
            out.channels[2].push_back(run.back[i]);
            for (std::size_t v = 0; v < n_values_; ++v)
                out.channels[3 + v].push_back(run.values[i * n_values_ + v]);
        }
    }
    try {
        write_deep_exr(path_, *spec_, out);
    } catch (const InputError& e) {
        diagnostics.add(e, where_);
        return false;
    }
    return true;
}

std::unique_ptr<Driver> DriverDeepExr::make_driver(NodeContext& context) const {
    return std::make_unique<DeepExrDriver>(*this, context);
}

}  // namespace

NodeType node_driver_deepexr() { return DriverDeepExr::describe(); }

}  // namespace lightsieve
