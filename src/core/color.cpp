#include "core/color.h"

#include <cctype>
#include <cmath>

namespace lightsieve {

namespace {

using Vec3d = std::array<double, 3>;

Vec3d operator*(const ColorMatrix& m, const Vec3d& v) {
    Vec3d out{};
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return out;
}

ColorMatrix operator*(const ColorMatrix& a, const ColorMatrix& b) {
    ColorMatrix out{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    }
    return out;
}

/// Inverse by cofactors; the matrices here are well conditioned.
ColorMatrix inverse(const ColorMatrix& m) {
    const auto cofactor = [&m](std::size_t i, std::size_t j) {
        const std::size_t r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
        return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    };
    const double determinant =
        m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    ColorMatrix out{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            out[j][i] = cofactor(i, j) / determinant;
    }
    return out;
}

/// Tristimulus values of a chromaticity with Y = 1.
Vec3d xyz_from_xy(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

/// Source: SMPTE RP 177-1993, section 3.3.
ColorMatrix xyz_from_rgb(const Chromaticities& c) {
    const Vec3d r = xyz_from_xy(c.red_x, c.red_y), g = xyz_from_xy(c.green_x, c.green_y),
                b = xyz_from_xy(c.blue_x, c.blue_y);
    const ColorMatrix columns{{{r[0], g[0], b[0]}, {r[1], g[1], b[1]}, {r[2], g[2], b[2]}}};
    const Vec3d scale = inverse(columns) * xyz_from_xy(c.white_x, c.white_y);
    return columns * ColorMatrix{{{scale[0], 0, 0}, {0, scale[1], 0}, {0, 0, scale[2]}}};
}

/// Bradford chromatic adaptation. Source: Lam 1985; Lindbloom, "Chromatic Adaptation".
ColorMatrix adaptation(const Chromaticities& from, const Chromaticities& to) {
    constexpr ColorMatrix kBradford{
        {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
    const Vec3d source = kBradford * xyz_from_xy(from.white_x, from.white_y);
    const Vec3d target = kBradford * xyz_from_xy(to.white_x, to.white_y);
    const ColorMatrix gain{{{target[0] / source[0], 0, 0},
                            {0, target[1] / source[1], 0},
                            {0, 0, target[2] / source[2]}}};
    return inverse(kBradford) * gain * kBradford;
}

struct NamedSpace {
    std::string_view name;
    ColorSpace space;
};

constexpr ColorSpace linear(Primaries p) { return {p, Transfer::Linear, false, nullptr}; }

/// The first name of a space is the one that messages use. Names of OCIO's cg-config and studio-config, their
/// aliases, ACES 1.0.3 ("Utility - ...") and Arnold's old ones.
constexpr NamedSpace kSpaces[] = {
    {"ACEScg", linear(Primaries::Ap1)},
    {"ACES - ACEScg", linear(Primaries::Ap1)},
    {"lin_ap1", linear(Primaries::Ap1)},
    {"linear", linear(Primaries::Ap1)},
    {"scene_linear", linear(Primaries::Ap1)},
    {"rendering", linear(Primaries::Ap1)},
    {"ACES2065-1", linear(Primaries::Ap0)},
    {"ACES - ACES2065-1", linear(Primaries::Ap0)},
    {"aces2065_1", linear(Primaries::Ap0)},
    {"lin_ap0", linear(Primaries::Ap0)},
    {"Linear Rec.709 (sRGB)", linear(Primaries::Rec709)},
    {"lin_rec709", linear(Primaries::Rec709)},
    {"lin_rec709_srgb", linear(Primaries::Rec709)},
    {"lin_rec709_scene", linear(Primaries::Rec709)},
    {"lin_srgb", linear(Primaries::Rec709)},
    {"scene-linear Rec.709-sRGB", linear(Primaries::Rec709)},
    {"Utility - Linear - Rec.709", linear(Primaries::Rec709)},
    {"Utility - Linear - sRGB", linear(Primaries::Rec709)},
    {"linear sRGB", linear(Primaries::Rec709)},
    {"Linear Rec.2020", linear(Primaries::Rec2020)},
    {"lin_rec2020", linear(Primaries::Rec2020)},
    {"Utility - Linear - Rec.2020", linear(Primaries::Rec2020)},
    {"Linear P3-D65", linear(Primaries::P3D65)},
    {"lin_p3d65", linear(Primaries::P3D65)},
    {"Utility - Linear - P3-D65", linear(Primaries::P3D65)},
    {"Linear AdobeRGB", linear(Primaries::AdobeRgb)},
    {"lin_adobergb", linear(Primaries::AdobeRgb)},
    {"Utility - Linear - Adobe RGB", linear(Primaries::AdobeRgb)},
    {"sRGB - Texture", kSrgb},
    {"sRGB", kSrgb},
    {"srgb_tx", kSrgb},
    {"srgb_texture", kSrgb},
    {"sRGB Encoded Rec.709 (sRGB)", kSrgb},
    {"srgb_rec709_scene", kSrgb},
    {"Utility - sRGB - Texture", kSrgb},
    {"Input - Generic - sRGB - Texture", kSrgb},
    {"sRGB Encoded AP1 - Texture", {Primaries::Ap1, Transfer::Srgb, false, nullptr}},
    {"srgb_encoded_ap1_tx", {Primaries::Ap1, Transfer::Srgb, false, nullptr}},
    {"sRGB Encoded P3-D65 - Texture", {Primaries::P3D65, Transfer::Srgb, false, nullptr}},
    {"Gamma 1.8 Rec.709 - Texture", {Primaries::Rec709, Transfer::Gamma18, false, nullptr}},
    {"g18_rec709_tx", {Primaries::Rec709, Transfer::Gamma18, false, nullptr}},
    {"Gamma 2.2 Rec.709 - Texture", {Primaries::Rec709, Transfer::Gamma22, false, nullptr}},
    {"g22_rec709_tx", {Primaries::Rec709, Transfer::Gamma22, false, nullptr}},
    {"g22_rec709", {Primaries::Rec709, Transfer::Gamma22, false, nullptr}},
    {"Gamma 2.2 AP1 - Texture", {Primaries::Ap1, Transfer::Gamma22, false, nullptr}},
    {"g22_ap1_tx", {Primaries::Ap1, Transfer::Gamma22, false, nullptr}},
    {"raw", kRawSpace},
    {"Utility - Raw", kRawSpace},
    {"data", kRawSpace},
};

bool same_name(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::tolower(static_cast<unsigned char>(a[i])) !=
            std::tolower(static_cast<unsigned char>(b[i])))
            return false;
    }
    return true;
}

/// Source: IEC 61966-2-1:1999, extended as an odd function.
float srgb_decode(float v) {
    const float a = std::abs(v);
    return std::copysign(a <= 0.04045F ? a / 12.92F : std::pow((a + 0.055F) / 1.055F, 2.4F), v);
}

float srgb_encode(float v) {
    const float a = std::abs(v);
    return std::copysign(a <= 0.0031308F ? a * 12.92F : 1.055F * std::pow(a, 1 / 2.4F) - 0.055F,
                         v);
}

}  // namespace

Chromaticities chromaticities(Primaries primaries) {
    switch (primaries) {
        case Primaries::Ap1: return {0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767};
        case Primaries::Ap0: return {0.7347, 0.2653, 0.0, 1.0, 0.0001, -0.0770, 0.32168, 0.33767};
        case Primaries::Rec709: return {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
        case Primaries::Rec2020: return {0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290};
        case Primaries::P3D65: return {0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290};
        case Primaries::AdobeRgb: return {0.64, 0.33, 0.21, 0.71, 0.15, 0.06, 0.3127, 0.3290};
    }
    return {};
}

ColorMatrix rgb_to_rgb(Primaries from, Primaries to) {
    const Chromaticities source = chromaticities(from), target = chromaticities(to);
    return inverse(xyz_from_rgb(target)) * adaptation(source, target) * xyz_from_rgb(source);
}

ColorMatrix rgb_from_xyz(Primaries to) {
    return rgb_to_rgb(Primaries::Rec709, to) *
           inverse(xyz_from_rgb(chromaticities(Primaries::Rec709)));
}

float decode(Transfer transfer, float stored) {
    switch (transfer) {
        case Transfer::Linear: return stored;
        case Transfer::Srgb: return srgb_decode(stored);
        case Transfer::Gamma18: return std::copysign(std::pow(std::abs(stored), 1.8F), stored);
        case Transfer::Gamma22: return std::copysign(std::pow(std::abs(stored), 2.2F), stored);
    }
    return stored;
}

float encode(Transfer transfer, float light) {
    switch (transfer) {
        case Transfer::Linear: return light;
        case Transfer::Srgb: return srgb_encode(light);
        case Transfer::Gamma18: return std::copysign(std::pow(std::abs(light), 1 / 1.8F), light);
        case Transfer::Gamma22: return std::copysign(std::pow(std::abs(light), 1 / 2.2F), light);
    }
    return light;
}

std::optional<ColorSpace> find_color_space(std::string_view name) {
    if (name.empty()) return kRawSpace;
    for (const NamedSpace& entry : kSpaces) {
        if (same_name(entry.name, name)) return entry.space;
    }
    return std::nullopt;
}

std::vector<std::string> color_space_names() {
    std::vector<std::string> names;
    for (const NamedSpace& entry : kSpaces)
        names.emplace_back(entry.name);
    return names;
}

std::string_view color_space_text(ColorSpace space) {
    if (space.external != nullptr) return space.external->name();
    for (const NamedSpace& entry : kSpaces) {
        if (entry.space == space) return entry.name;
    }
    return "a colour space without a name";
}

ColorConversion::ColorConversion(ColorSpace from, ColorSpace to)
    : before_(from.external), after_(to.external) {
    identity_ = from.raw || to.raw || from == to;
    if (identity_) return;
    // What a configuration's space gives, or takes, is light in the rendering space.
    if (before_ != nullptr) from = before_->rendering();
    if (after_ != nullptr) to = after_->rendering();
    same_primaries_ = from.primaries == to.primaries;
    decode_ = from.transfer;
    encode_ = to.transfer;
    const ColorMatrix m = rgb_to_rgb(from.primaries, to.primaries);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            matrix_[i][j] = static_cast<float>(m[i][j]);
    }
}

Color ColorConversion::operator()(Color c) const {
    if (identity_) return c;
    if (before_ != nullptr) c = before_->to_rendering(c);
    c = built_in(c);
    return after_ != nullptr ? after_->from_rendering(c) : c;
}

Color ColorConversion::built_in(Color c) const {
    Color light{decode(decode_, c.r), decode(decode_, c.g), decode(decode_, c.b)};
    if (!same_primaries_) {
        const Color in = light;
        for (int i = 0; i < 3; ++i) {
            const auto& row = matrix_[static_cast<std::size_t>(i)];
            light[i] = row[0] * in.r + row[1] * in.g + row[2] * in.b;
        }
    }
    return {encode(encode_, light.r), encode(encode_, light.g), encode(encode_, light.b)};
}

float ColorConversion::grey(float v) const {
    if (identity_) return v;
    if (before_ != nullptr || after_ != nullptr) return (*this)(Color::grey(v)).g;
    return encode(encode_, decode(decode_, v));
}

std::optional<ColorSpace> ColorSpaces::find(std::string_view name) const {
    for (const char* role : {"rendering", "scene_linear", "linear"})
        if (same_name(name, role)) return rendering_;
    return find_color_space(name);
}

ColorSpace ColorSpaces::resolve(std::string_view name, ColorSpace automatic,
                                Diagnostics& diagnostics, const SourceSpan& where) const {
    if (same_name(name, "auto")) return automatic;
    if (const std::optional<ColorSpace> space = find(name)) return *space;
    std::vector<std::string> candidates = names();
    candidates.emplace_back("auto");
    std::string hint = did_you_mean(name, candidates);
    if (hint.empty())
        hint =
            "known names are \"auto\", \"\" (no conversion), \"ACEScg\", \"sRGB\", \"lin_rec709\" "
            "and the usual names of the ACES configurations";
    diagnostics.warning(Code::UnknownColorSpace,
                        "unknown colour space \"" + std::string(name) + "\"; taken for \"" +
                            std::string(color_space_text(automatic)) + "\"",
                        where, std::move(hint));
    return automatic;
}

const ColorSpaces& ColorSpaces::built_in() {
    static const ColorSpaces all;
    return all;
}

}  // namespace lightsieve
