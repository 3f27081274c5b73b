// Opens picture files: the one way from a path to an OpenImageIO reader.
//
// OpenImageIO knows dozens of formats, and some of its readers crash on damaged files. Here a file is read only if its first
// bytes are those of a format of a short list, so its name does not choose the code that runs, and OpenImageIO's own limits
// are set. Private to io (and to the program that tries pictures first, image_try.h): includes OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <string_view>

namespace lightsieve {

/// Pictures that are larger in memory are refused [MiB].
inline constexpr int kMaxImageMb = 8192;
/// Files with more channels are no pictures.
inline constexpr int kMaxImageChannels = 1024;
/// The formats that are read, as messages name them.
inline constexpr std::string_view kImageFormats = "EXR, TIFF (.tx), PNG, JPEG, HDR, BMP and TGA";

/// OpenImageIO's name of the format whose files begin with `head`; empty if it is none of the list. TGA files have no
/// beginning of their own: `path` must end in .tga.
[[nodiscard]] std::string_view image_format(std::string_view head, std::string_view path);

/// The settings with which readers are opened: alpha as it is in the file.
[[nodiscard]] OIIO::ImageSpec reader_settings();

/// A reader at the first picture of the file, or null with `problem` set.
[[nodiscard]] std::unique_ptr<OIIO::ImageInput> open_image(const std::string& path,
                                                           std::string& problem);

}  // namespace lightsieve
