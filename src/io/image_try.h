// Reads a picture in another process first, so that a file that crashes its reader ends in a message and not the render.
//
// Readers of pictures are made for speed and trust what they read: of 10,000 damaged files one or two still crash libtiff or
// OpenImageIO. The program `lightsieve_image_reader` (src/image_reader) is started at the first picture and forks a process
// for each that reads it as the renderer will, under limits of memory and processor time. What it survives is then read here,
// in full and at full speed. The price is a quarter of a second once, and decoding twice; of pictures over
// kWholeTryBytes the program reads only the top and the bottom of each level, because textures of that size are read
// here in parts, too. Not guarded against: files that change afterwards, and damage that lies in the middle of such a
// large picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lightsieve {

/// The program's file name; it lies beside the module or program that runs it.
inline constexpr std::string_view kImageReaderName = "lightsieve_image_reader";
/// Levels up to this size are tried whole [bytes in memory].
inline constexpr std::size_t kWholeTryBytes = std::size_t{64} << 20;
/// What reading one picture may take [bytes], [s of processor time].
inline constexpr std::size_t kTryMemory = std::size_t{4} << 30;
inline constexpr unsigned kTrySeconds = 30;

/// What the program answers to a path (which ends with a zero byte): one of these, and the number of the signal.
enum class ImageTrial : std::uint8_t {
    Survived = 's',
    Crashed = 'c',
    TooSlow = 't',
    Memory = 'm'
};
inline constexpr std::size_t kTrialBytes = 2;

/// Whether `path` may be read in this process; if not, `problem` says why. Remembers files until they change. A reader that
/// cannot be started stops nothing: the pictures are read untried.
[[nodiscard]] bool try_image(const std::string& path, std::string& problem);

/// The same with a program of one's own that nothing is remembered of, for tests.
[[nodiscard]] bool try_image_with(const std::string& program, const std::string& path,
                                  std::string& problem);

}  // namespace lightsieve
