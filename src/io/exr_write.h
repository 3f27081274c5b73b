// OpenEXR files written while a picture is being rendered.
//
// Rectangles arrive in any order. Tiled files take each tile as soon as it is complete (at once, if rectangles are
// tiles); scanline files take bands of rows from the top, so rectangles of later bands wait in memory. Files are
// written to a temporary name and renamed at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/color.h"

namespace lightsieve {

enum class ExrPixelType : std::uint8_t { Half, Float, UInt };
enum class ExrCompression : std::uint8_t {
    None,
    Rle,
    Zip,
    Zips,
    Piz,
    Pxr24,
    B44,
    B44a,
    Dwaa,
    Dwab
};

struct ExrChannel {
    std::string name;  ///< full name, e.g. "diffuse.R"
    ExrPixelType type = ExrPixelType::Float;
};

/// One part of a file; files with one part are ordinary ones.
struct ExrPart {
    std::string name;                  ///< needed and distinct if there are several parts
    std::vector<ExrChannel> channels;  ///< in the order in which pixels are handed over
};

/// Sixteen floats are written as a matrix (worldToCamera), others as a float vector.
using ExrAttribute = std::variant<int, float, std::string, std::vector<float>>;

struct ExrWriteSpec {
    int width = 0, height = 0;  ///< display window [pixels], from (0, 0)
    int data_x = 0, data_y = 0, data_width = 0, data_height = 0;  ///< data window
    float pixel_aspect_ratio = 1;
    bool tiled = true;
    int tile_size =
        64;  ///< tiles are squares on a grid from data_x, data_y; for scanline files the height of a band
    ExrCompression compression = ExrCompression::Zip;
    std::vector<ExrPart> parts;
    std::map<std::string, ExrAttribute> attributes;  ///< in every part's header
    Primaries primaries = Primaries::Ap1;            ///< written as `chromaticities`
};

/// One channel of a rectangle. UInt values travel as the bits of a float.
struct ExrPlane {
    const float* data = nullptr;      ///< upper left pixel
    std::ptrdiff_t pixel_stride = 1;  ///< floats from a pixel to the next one
    std::ptrdiff_t row_stride = 0;    ///< floats from a row to the next one
};

class ExrWriter {
  public:
    /// Creates the temporary file and writes the header.
    /// throws  InputError: the file cannot be created, or OpenEXR refuses the header (equal channel names, ...)
    ExrWriter(const std::string& path, ExrWriteSpec spec);
    /// Removes what was written unless `close` was called.
    ~ExrWriter();
    ExrWriter(const ExrWriter&) = delete;
    ExrWriter& operator=(const ExrWriter&) = delete;

    /// Adds a rectangle, in frame pixels; each pixel once. Parts outside the data window are left out.
    /// planes  one for each channel, part after part. Halfs: finite values are clamped to the range of half.
    /// throws  InputError: the disk refuses
    void write(int x, int y, int width, int height, std::span<const ExrPlane> planes);
    /// Writes pixels that never came as 0, closes the file and gives it its name.
    /// throws  InputError: the disk refuses
    void close();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lightsieve
