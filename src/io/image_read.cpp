#include "io/image_read.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "io/image_open.h"
#include "io/image_try.h"
#include "io/texture_input.h"

namespace lightsieve {

namespace {

[[noreturn]] void fail(Code code, std::string message, const SourceSpan& where, std::string hint) {
    throw InputError(Error{code, std::move(message), where, std::move(hint), {}, Severity::Error});
}

[[noreturn]] void damaged(const std::string& path, const std::string& why,
                          const SourceSpan& where) {
    fail(Code::FileFormat, "picture \"" + path + "\" cannot be read: " + why, where,
         "write the file again, or convert it to EXR, TIFF or PNG");
}

/// The file, open, its sizes checked.
std::unique_ptr<OIIO::ImageInput> open_picture(const std::string& path, const SourceSpan& where,
                                               std::size_t max_pixels) {
    std::error_code ec;
    if (!std::filesystem::exists(path, ec))
        fail(Code::FileNotFound, "there is no picture \"" + path + "\"", where,
             "check the name and the search paths");
    std::string problem;
    if (!try_image(path, problem)) damaged(path, problem, where);
    std::unique_ptr<OIIO::ImageInput> input = open_image(path, problem);
    if (!input) damaged(path, problem, where);
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.deep || spec.depth > 1) damaged(path, "it is deep or three-dimensional", where);
    if (static_cast<std::size_t>(spec.image_pixels()) > max_pixels) {
        fail(Code::LimitImageSize,
             "picture \"" + path + "\" has " + std::to_string(spec.width) + "x" +
                 std::to_string(spec.height) + " pixels, more than " + std::to_string(max_pixels),
             where, "use a smaller picture");
    }
    return input;
}

/// The least float of which `steps` times is not less than the integer that it stands for, so that neither rounding nor
/// dithering makes it another.
float whole_step(float value, float steps) {
    const float k = std::round(value * steps);
    float out = k / steps;
    while (out * steps < k)
        out = std::nextafter(out, 2.0F);
    return out;
}

}  // namespace

ColorImage read_color_image(const std::string& path, std::string_view color_space,
                            Diagnostics& diagnostics, const SourceSpan& where,
                            std::size_t max_pixels) {
    const std::unique_ptr<OIIO::ImageInput> input = open_picture(path, where, max_pixels);
    const OIIO::ImageSpec spec = input->spec();
    const ColorSpaces& spaces = ColorSpaces::built_in();
    const bool linear = is_float_format(spec);
    const TexelConversion conversion(
        spec,
        spaces.resolve(color_space, linear ? spaces.rendering() : spaces.integers(), diagnostics,
                       where),
        spaces.rendering());

    // Read in strips: a file may have many more channels than the three that are kept.
    constexpr int kRows = 64;
    const auto n_channels = static_cast<std::size_t>(spec.nchannels);
    const auto width = static_cast<std::size_t>(spec.width);
    ColorImage image{spec.width, spec.height, {}};
    image.pixels.reserve(static_cast<std::size_t>(spec.image_pixels()));
    std::vector<float> strip;
    const int rows = spec.tile_width > 0 ? spec.tile_height : kRows;
    for (int y = 0; y < spec.height; y += rows) {
        const int end = std::min(y + rows, spec.height);
        strip.resize(width * static_cast<std::size_t>(end - y) * n_channels);
        const bool ok = spec.tile_width > 0
                            ? input->read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y,
                                                spec.y + end, spec.z, spec.z + 1, 0,
                                                spec.nchannels, OIIO::TypeFloat, strip.data())
                            : input->read_scanlines(0, 0, spec.y + y, spec.y + end, 0, 0,
                                                    spec.nchannels, OIIO::TypeFloat, strip.data());
        if (!ok) damaged(path, input->geterror(), where);
        conversion.apply(strip.data(), strip.size() / n_channels);
        for (std::size_t i = 0; i < strip.size(); i += n_channels) {
            image.pixels.push_back(n_channels >= 3 ? Color(strip[i], strip[i + 1], strip[i + 2])
                                                   : Color::grey(strip[i]));
        }
    }
    return image;
}

StoredImage read_stored_image(const std::string& path, std::size_t max_pixels) {
    const std::unique_ptr<OIIO::ImageInput> input = open_picture(path, {}, max_pixels);
    const OIIO::ImageSpec& spec = input->spec();
    StoredImage out{spec.width, spec.height, spec.nchannels, {}};
    out.values.resize(static_cast<std::size_t>(spec.image_pixels()) *
                      static_cast<std::size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, out.values.data()))
        damaged(path, input->geterror(), {});
    if (spec.format == OIIO::TypeUInt8)
        for (float& value : out.values)
            value = whole_step(value, 255);
    return out;
}

}  // namespace lightsieve
