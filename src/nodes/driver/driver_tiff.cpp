// driver_tiff: one layer as a TIFF of integers or floats.
#include "nodes/common/picture_driver.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

enum class Compression : std::int32_t { None, Lzw, Rle, Zip };
enum class Format : std::int32_t { Int8, Int16, Int32, Float32 };

struct DriverTiff {
    Name filename;
    Name color_space = "auto";
    Compression compression = Compression::Lzw;
    Format format = Format::Int8;
    bool tiled = true, dither = true, output_padded = false, unpremult_alpha = false,
         skip_alpha = false, append = false;
    NodeRef input;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Driver> make_driver(NodeContext& context) const;
};

NodeType DriverTiff::describe() {
    Describe<DriverTiff> d("driver_tiff", NodeKind::Driver, "Writes one layer as a TIFF picture.");
    d.param("filename", &DriverTiff::filename,
            "The file; relative names are relative to where the command is run, or to -o.");
    d.param("color_space", &DriverTiff::color_space,
            "What colours are converted to; auto: sRGB for int8, else ACEScg; empty: nothing.");
    d.param("compression", &DriverTiff::compression,
            "How pixels are packed; none of these loses precision.")
        .names({"none", "lzw", "rle", "zip"});
    d.param("format", &DriverTiff::format,
            "Type of a channel; integers are clamped to 0..1 and rounded.")
        .names({"int8", "int16", "int32", "float32"});
    d.param("tiled", &DriverTiff::tiled, "Tiles instead of scanlines.");
    d.param("dither", &DriverTiff::dither,
            "Adds noise of one step before rounding to int8, against banding.");
    d.param("output_padded", &DriverTiff::output_padded,
            "The whole frame, black around the region; off: the region only.");
    d.param("unpremult_alpha", &DriverTiff::unpremult_alpha,
            "Divides colours by alpha; int8 only.");
    d.param("skip_alpha", &DriverTiff::skip_alpha, "Leaves alpha out.");
    d.param(
        "append", &DriverTiff::append,
        "Goes on with a file that is there, if it has the same size: what is not rendered stays.");
    d.param("input", &DriverTiff::input,
            "The last of a chain of imagers, which change colours before they are written.");
    return d.done();
}

std::unique_ptr<Driver> DriverTiff::make_driver(NodeContext& context) const {
    PictureOptions options;
    options.format = PictureFormat::Tiff;
    options.type = format == Format::Int8    ? PictureType::UInt8
                   : format == Format::Int16 ? PictureType::UInt16
                   : format == Format::Int32 ? PictureType::UInt32
                                             : PictureType::Float;
    options.compression = static_cast<TiffCompression>(compression);
    options.tiled = tiled;
    options.dither = dither;
    options.unpremult_alpha = unpremult_alpha;
    options.skip_alpha = skip_alpha;
    options.output_padded = output_padded;
    options.append = append;
    return std::make_unique<PictureDriver>(filename, color_space, options, context);
}

}  // namespace

NodeType node_driver_tiff() { return DriverTiff::describe(); }

}  // namespace lightsieve
