// driver_jpeg: one layer as a JPEG picture, without alpha.
#include "nodes/common/picture_driver.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct DriverJpeg {
    Name filename;
    Name color_space = "auto";
    std::int32_t quality = 100;
    bool dither = true, output_padded = false;
    NodeRef input;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Driver> make_driver(NodeContext& context) const;
};

NodeType DriverJpeg::describe() {
    Describe<DriverJpeg> d("driver_jpeg", NodeKind::Driver,
                           "Writes one layer as a JPEG picture, without alpha.");
    d.param("filename", &DriverJpeg::filename,
            "The file; relative names are relative to where the command is run, or to -o.");
    d.param("color_space", &DriverJpeg::color_space,
            "What colours are converted to; auto: sRGB; empty: nothing.");
    d.param("quality", &DriverJpeg::quality, "From 1, small, to 100, good.").hard_range(1, 100);
    d.param("dither", &DriverJpeg::dither,
            "Adds noise of one step before rounding, against banding.");
    d.param("output_padded", &DriverJpeg::output_padded,
            "The whole frame, black around the region; off: the region only.");
    d.param("input", &DriverJpeg::input,
            "The last of a chain of imagers, which change colours before they are written.");
    return d.done();
}

std::unique_ptr<Driver> DriverJpeg::make_driver(NodeContext& context) const {
    PictureOptions options;
    options.format = PictureFormat::Jpeg;
    options.quality = quality;
    options.dither = dither;
    options.skip_alpha = true;
    options.output_padded = output_padded;
    return std::make_unique<PictureDriver>(filename, color_space, options, context);
}

}  // namespace

NodeType node_driver_jpeg() { return DriverJpeg::describe(); }

}  // namespace lightsieve
