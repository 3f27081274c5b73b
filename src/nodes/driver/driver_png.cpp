// driver_png: one layer as a PNG of 8 or 16 bits.
#include "nodes/common/picture_driver.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

enum class Format : std::int32_t { Int8, Int16 };

struct DriverPng {
    Name filename;
    Name color_space = "auto";
    Format format = Format::Int8;
    bool dither = true, output_padded = false, unpremult_alpha = false, skip_alpha = false;
    NodeRef input;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Driver> make_driver(NodeContext& context) const;
};

NodeType DriverPng::describe() {
    Describe<DriverPng> d("driver_png", NodeKind::Driver, "Writes one layer as a PNG picture.");
    d.param("filename", &DriverPng::filename,
            "The file; relative names are relative to where the command is run, or to -o.");
    d.param(
        "color_space", &DriverPng::color_space,
        "What colours are converted to; auto: sRGB for int8, ACEScg for int16; empty: nothing.");
    d.param("format", &DriverPng::format, "Bits a channel.").names({"int8", "int16"});
    d.param("dither", &DriverPng::dither,
            "Adds noise of one step before rounding to int8, against banding.");
    d.param("output_padded", &DriverPng::output_padded,
            "The whole frame, black around the region; off: the region only.");
    d.param("unpremult_alpha", &DriverPng::unpremult_alpha,
            "Divides colours by alpha; int8 only.");
    d.param("skip_alpha", &DriverPng::skip_alpha, "Leaves alpha out.");
    d.param("input", &DriverPng::input,
            "The last of a chain of imagers, which change colours before they are written.");
    return d.done();
}

std::unique_ptr<Driver> DriverPng::make_driver(NodeContext& context) const {
    PictureOptions options;
    options.format = PictureFormat::Png;
    options.type = format == Format::Int8 ? PictureType::UInt8 : PictureType::UInt16;
    options.dither = dither;
    options.unpremult_alpha = unpremult_alpha;
    options.skip_alpha = skip_alpha;
    options.output_padded = output_padded;
    return std::make_unique<PictureDriver>(filename, color_space, options, context);
}

}  // namespace

NodeType node_driver_png() { return DriverPng::describe(); }

}  // namespace lightsieve
