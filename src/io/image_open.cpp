#include "io/image_open.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <utility>

namespace lightsieve {

namespace {

using namespace std::string_view_literals;

/// How files of a format begin, and OpenImageIO's name of its reader.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kBeginnings{
    {{"\x76\x2f\x31\x01"sv, "openexr"},
     {"II*\0"sv, "tiff"},
     {"MM\0*"sv, "tiff"},
     {"II+\0"sv, "tiff"},
     {"MM\0+"sv, "tiff"},
     {"\x89PNG\r\n\x1a\n"sv, "png"},
     {"\xff\xd8\xff"sv, "jpeg"},
     {"#?RADIANCE"sv, "hdr"},
     {"#?RGBE"sv, "hdr"},
     {"BM"sv, "bmp"}}};
constexpr std::size_t kLongestBeginning = 16;

bool is_tga(std::string_view path) {
    constexpr std::string_view kEnd = ".tga";
    return path.size() >= kEnd.size() &&
           std::equal(kEnd.begin(), kEnd.end(), path.end() - kEnd.size(), [](char a, char b) {
               return a == std::tolower(static_cast<unsigned char>(b));
           });
}

/// Limits of the whole process; setting them again changes nothing.
void set_limits() {
    OIIO::attribute("limits:imagesize_MB", kMaxImageMb);
    OIIO::attribute("limits:channels", kMaxImageChannels);
}

std::string beginning_of(const std::string& path) {
    std::string head(kLongestBeginning, '\0');
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    return head;
}

}  // namespace

std::string_view image_format(std::string_view head, std::string_view path) {
    for (const auto& [beginning, format] : kBeginnings)
        if (head.starts_with(beginning)) return format;
    return is_tga(path) ? "targa"sv : ""sv;
}

OIIO::ImageSpec reader_settings() {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::string& path, std::string& problem) {
    std::error_code ec;
    // A pipe or a device could keep us waiting.
    if (!std::filesystem::is_regular_file(path, ec)) {
        problem = "it is not a file";
        return nullptr;
    }
    const std::string_view format = image_format(beginning_of(path), path);
    if (format.empty()) {
        problem = "it begins like none of " + std::string(kImageFormats);
        return nullptr;
    }
    set_limits();
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(std::string(format));
    if (!input) {
        problem = OIIO::geterror();
        return nullptr;
    }
    OIIO::ImageSpec spec;
    if (!input->open(path, spec, reader_settings())) {
        problem = input->geterror();
        if (problem.empty()) problem = "it is damaged";
        return nullptr;
    }
    // Not every reader heeds OpenImageIO's limits.
    constexpr auto kMaxBytes = OIIO::imagesize_t{kMaxImageMb} << 20U;
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 ||
        spec.nchannels > kMaxImageChannels || spec.image_bytes() > kMaxBytes) {
        problem = "it says that it has " + std::to_string(spec.width) + "x" +
                  std::to_string(spec.height) + " pixels of " + std::to_string(spec.nchannels) +
                  " channels, which is not allowed";
        return nullptr;
    }
    return input;
}

}  // namespace lightsieve
