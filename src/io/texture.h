// Textures: filtered look-ups in picture files, in the rendering space.
//
// Files are read on demand through OpenImageIO's texture system within a fixed memory budget. Texels are made linear
// BEFORE they are filtered: the cache is given a reader of ours (texture_input.h) that decodes and converts each tile
// when it is loaded, so that mip levels and interpolation mix light, not code values. Alpha is never converted.
// OpenImageIO appears only in the .cpp files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/color.h"
#include "core/diagnostics.h"
#include "core/vec.h"

namespace lightsieve {

/// What lies outside [0,1].
enum class TextureWrap : std::int32_t { Periodic, Black, Clamp, Mirror, File };
/// Interpolation between texels. SmartBicubic: a cubic B-spline where texels are larger than the footprint, else bilinear.
enum class TextureFilter : std::int32_t { Closest, Bilinear, Bicubic, SmartBicubic };

/// The area that a look-up averages: an ellipse within the parallelogram of two vectors [uv units]. Zero: the largest
/// level, magnified.
struct TextureFootprint {
    Vec2f across, along;
    /// As wide in all directions.
    static TextureFootprint round(float width) { return {{width, 0}, {0, width}}; }
};

/// One open texture; belongs to its cache.
struct Texture;

/// What a file holds.
struct TextureInfo {
    int width = 0, height = 0;  ///< of the largest level [texels]
    int n_channels = 0;
    bool has_alpha = false;
    bool is_float = false;  ///< half or float; false: integers
    ColorSpace space{};     ///< what its colours were taken for
};

/// How to look up; plain data, made once per node.
struct TextureSampling {
    TextureWrap wrap_s = TextureWrap::Periodic;
    TextureWrap wrap_t = TextureWrap::Periodic;
    TextureFilter filter = TextureFilter::SmartBicubic;
    std::int32_t start_channel = 0;  ///< first channel read
    bool single_channel = false;     ///< only `start_channel`, in r, g and b
};

class TextureCache {
  public:
    /// memory_mb  bound on the texels in memory [MiB]
    /// spaces     what names of colour spaces mean
    explicit TextureCache(std::size_t memory_mb = kDefaultMemoryMb,
                          std::shared_ptr<const ColorSpaces> spaces = nullptr);
    ~TextureCache();
    TextureCache(const TextureCache&) = delete;
    TextureCache& operator=(const TextureCache&) = delete;

    static constexpr std::size_t kDefaultMemoryMb = 2048;

    /// Opens a texture and reads enough of it to know that it is sound. Not for the hot path; thread safe.
    ///
    /// path         an existing file, after search paths
    /// color_space  as written in a scene: "auto" (integers sRGB, floats the rendering space), "" raw, or a name
    /// returns      the texture, valid as long as the cache; null with an error reported at `where`
    [[nodiscard]] const Texture* open(const std::string& path, std::string_view color_space,
                                      Diagnostics& diagnostics, const SourceSpan& where);
    [[nodiscard]] static const TextureInfo& info(const Texture& texture);

    /// The filtered colour in the rendering space and alpha (1 if the file has none). Hot path: no locks of ours, no strings.
    ///
    /// uv  v = 0 is the bottom row
    [[nodiscard]] Rgba lookup(const Texture& texture, Vec2f uv, TextureFootprint footprint,
                              const TextureSampling& sampling) const noexcept;

    /// Texels in memory now [bytes], with what untiled files keep beside the cache.
    [[nodiscard]] std::size_t memory() const;
    /// The same when all that is open would be looked at, within the bound [bytes].
    [[nodiscard]] std::size_t most_memory() const;
    /// What opening took [s].
    [[nodiscard]] double open_seconds() const;

    /// Reports look-ups that failed while rendering (files damaged or gone); such look-ups gave black.
    void report_failures(Diagnostics& diagnostics) const;

  private:
    [[nodiscard]] const Texture* open_untimed(const std::string& path,
                                              std::string_view color_space,
                                              Diagnostics& diagnostics, const SourceSpan& where);

    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lightsieve
