// Reads texture files for the texture cache: every tile leaves it linear, in the rendering space, alpha premultiplied.
//
// OpenImageIO's cache asks an ImageInput for tiles. `ConvertingInput` stands between the cache and the real reader:
// it converts each tile once, when it is loaded, so that the cache holds (and filters) light. It also gives files
// without tiles a tiled face, because the cache would decode a PNG from its first row for every strip it misses.
// Private to io: includes OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/color.h"

namespace lightsieve {

/// How the texels of one file become light.
struct TexelConversion {
    ColorConversion color;
    int n_channels = 0;
    int n_color = 0;  ///< 3, or 1 for grey; the first channels
    int alpha_channel = -1;
    bool divide_alpha = false;  ///< colours are stored multiplied by alpha and are not linear
    bool multiply_alpha =
        false;  ///< colours are not multiplied by alpha yet (also after `divide_alpha`)

    /// spec  of the file, opened with "oiio:UnassociatedAlpha" so that nothing is multiplied yet
    /// to  the rendering space
    TexelConversion(const OIIO::ImageSpec& spec, ColorSpace from, ColorSpace to);
    TexelConversion() = default;
    [[nodiscard]] bool identity() const {
        return color.identity() && !divide_alpha && !multiply_alpha;
    }
    /// Converts in place. pixels: n * n_channels.
    void apply(float* pixels, std::size_t n) const;
};

/// Half or float; integers are taken for sRGB when a scene says "auto".
[[nodiscard]] bool is_float_format(const OIIO::ImageSpec& spec);

/// Bound on what untiled files that are open keep in memory, all together, and what they keep now [bytes].
inline constexpr std::size_t kMostWholeImages = std::size_t{1} << 30;
[[nodiscard]] std::size_t whole_images_memory();

class ConvertingInput final : public OIIO::ImageInput {
  public:
    /// For the cache: it opens a made-up name, and `settings(path, from)` say which file is meant.
    static OIIO::ImageInput* create() { return new ConvertingInput; }
    [[nodiscard]] static OIIO::ImageSpec settings(const std::string& path, ColorSpace from,
                                                  ColorSpace to);

    ~ConvertingInput() override { close(); }
    [[nodiscard]] const char* format_name() const override { return "lightsieve"; }
    bool open(const std::string& name, OIIO::ImageSpec& spec) override;
    bool open(const std::string& name, OIIO::ImageSpec& spec,
              const OIIO::ImageSpec& config) override;
    bool close() override;
    [[nodiscard]] int current_subimage() const override { return 0; }
    [[nodiscard]] int current_miplevel() const override { return miplevel_; }
    bool seek_subimage(int subimage, int miplevel) override;
    bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override;
    bool read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data) override;

  private:
    /// Describes the current level of the real file as the cache is to see it.
    void adopt_spec();
    [[nodiscard]] bool whole_image_fits() const;
    /// Pixels of one tile as the file has them, converted to `format`; outside the picture unspecified.
    bool fetch_tile(int x, int y, OIIO::TypeDesc format, std::byte* out);
    bool fetch_from_whole(int x, int y, std::byte* out);
    bool fetch_from_strip(int x, int y, std::byte* out);
    void release_whole();

    std::unique_ptr<OIIO::ImageInput> inner_;
    TexelConversion conversion_;
    int miplevel_ = 0;
    bool tiled_ = false;            ///< the file has tiles of its own
    OIIO::TypeDesc read_format_;    ///< in which texels are fetched
    std::vector<std::byte> whole_;  ///< all texels of an untiled file, in read_format_
    std::vector<float> scratch_;    ///< one tile
};

}  // namespace lightsieve
