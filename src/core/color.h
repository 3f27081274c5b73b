// Colour spaces: the rendering space (ACEScg), the names that scenes use, and conversions between them.
//
// Numbers in a scene are rendering-space values and stay as they are; only textures are converted on the way in and
// pictures on the way out. Matrices are computed from primaries and white points with Bradford adaptation (CIE 15,
// Lindbloom), so nothing is typed in twice. The usual names of the ACES configurations are built in; spaces of a user's
// OpenColorIO configuration (io/color_config.h) come in as `ExternalSpace`s. Names compare without regard to case, as in OCIO.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "core/vec.h"

namespace lightsieve {

/// Red, green, blue and white of a colour space.
enum class Primaries : std::uint8_t {
    Ap1,       ///< ACEScg, white about D60
    Ap0,       ///< ACES2065-1
    Rec709,    ///< also sRGB, D65
    Rec2020,   ///< D65
    P3D65,     ///< D65
    AdobeRgb,  ///< D65
};

/// How stored values relate to light.
enum class Transfer : std::uint8_t { Linear, Srgb, Gamma18, Gamma22 };

class ExternalSpace;

/// What the numbers of a picture mean. Default: the rendering space.
struct ColorSpace {
    Primaries primaries = Primaries::Ap1;
    Transfer transfer = Transfer::Linear;
    bool raw = false;  ///< data, never converted
    /// A space of a configuration, which says it all; null: built in.
    const ExternalSpace* external = nullptr;
    friend bool operator==(const ColorSpace&, const ColorSpace&) = default;
};

/// The space in which light is computed, unless a scene chooses another.
inline constexpr ColorSpace kRenderingSpace{};
inline constexpr ColorSpace kSrgb{Primaries::Rec709, Transfer::Srgb, false, nullptr};
inline constexpr ColorSpace kRawSpace{Primaries::Ap1, Transfer::Linear, true, nullptr};

/// A space that a colour configuration defines.
class ExternalSpace {
  public:
    /// rendering  the built-in space that stands for the one that the configuration renders in
    ExternalSpace(std::string name, ColorSpace rendering)
        : name_(std::move(name)), rendering_(rendering) {}
    virtual ~ExternalSpace() = default;
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] ColorSpace rendering() const { return rendering_; }
    /// Stored values to light in the rendering space, and back. Hot path.
    [[nodiscard]] virtual Color to_rendering(Color stored) const noexcept = 0;
    [[nodiscard]] virtual Color from_rendering(Color light) const noexcept = 0;

  private:
    std::string name_;
    ColorSpace rendering_;
};

/// CIE xy chromaticities.
struct Chromaticities {
    double red_x, red_y, green_x, green_y, blue_x, blue_y, white_x, white_y;
};
[[nodiscard]] Chromaticities chromaticities(Primaries primaries);

/// Three rows of three; applied to a column (r, g, b).
using ColorMatrix = std::array<std::array<double, 3>, 3>;
/// Linear RGB of one set of primaries to another; white maps to white (Bradford adaptation).
[[nodiscard]] ColorMatrix rgb_to_rgb(Primaries from, Primaries to);
/// CIE XYZ seen under daylight (D65) to linear RGB; daylight maps to white.
[[nodiscard]] ColorMatrix rgb_from_xyz(Primaries to);

/// Stored value to light. Odd around 0, defined for any float; NaN stays NaN.
[[nodiscard]] float decode(Transfer transfer, float stored);
/// Light to stored value, the inverse of `decode`.
[[nodiscard]] float encode(Transfer transfer, float light);

/// The space of that name; "" and "raw" are raw. Nothing for unknown names and for "auto", which the caller decides.
[[nodiscard]] std::optional<ColorSpace> find_color_space(std::string_view name);
/// Every name that `find_color_space` knows, for messages.
[[nodiscard]] std::vector<std::string> color_space_names();
/// A name for messages and headers, e.g. "ACEScg", "sRGB - Texture"; "raw" for raw.
[[nodiscard]] std::string_view color_space_text(ColorSpace space);

/// Converts colours from one space to another. Cheap to copy; nothing is allocated.
class ColorConversion {
  public:
    /// Leaves colours as they are.
    ColorConversion() = default;
    /// If either space is raw, colours stay as they are.
    ColorConversion(ColorSpace from, ColorSpace to);
    [[nodiscard]] bool identity() const { return identity_; }
    [[nodiscard]] Color operator()(Color c) const;
    /// A grey value (r = g = b): greys stay grey.
    [[nodiscard]] float grey(float v) const;

  private:
    [[nodiscard]] Color built_in(Color c) const;

    bool identity_ = true;
    bool same_primaries_ = true;
    Transfer decode_ = Transfer::Linear;
    Transfer encode_ = Transfer::Linear;
    std::array<std::array<float, 3>, 3> matrix_{};
    const ExternalSpace *before_ = nullptr, *after_ = nullptr;  ///< around the built-in part
};

/// The colour spaces of a scene: which one light is computed in, and what names mean. This one has the built-in spaces only.
class ColorSpaces {
  public:
    explicit ColorSpaces(ColorSpace rendering = kRenderingSpace) : rendering_(rendering) {}
    virtual ~ColorSpaces() = default;
    [[nodiscard]] ColorSpace rendering() const { return rendering_; }
    /// What "auto" means for 8-bit and 16-bit pictures.
    [[nodiscard]] virtual ColorSpace integers() const { return kSrgb; }
    /// The space of that name; "" and "raw" are raw. Nothing for unknown names and for "auto".
    [[nodiscard]] virtual std::optional<ColorSpace> find(std::string_view name) const;
    /// Names that `find` knows, for messages.
    [[nodiscard]] virtual std::vector<std::string> names() const { return color_space_names(); }
    /// The space of that name. "auto" gives `automatic`; so does an unknown name, with a warning that says so.
    [[nodiscard]] ColorSpace resolve(std::string_view name, ColorSpace automatic,
                                     Diagnostics& diagnostics, const SourceSpan& where) const;
    /// Without a configuration, in ACEScg.
    [[nodiscard]] static const ColorSpaces& built_in();

  private:
    ColorSpace rendering_;
};

}  // namespace lightsieve
