#include "nodes/common/sky_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/blackbody.h"
#include "core/color.h"
#include "nodes/common/sky_model_data.h"

namespace lightsieve {
namespace {

/// Scene units for a luminous quantity: the radiance of a white matt surface under 100 klx is 1.
constexpr float kPerLux = kPi / 100000;
/// Luminous efficacy, by which the tables' watts become lumens [lm/W].
constexpr float kEfficacy = 683;

/// That of the tables.
constexpr ColorSpace kTableSpace{Primaries::Rec709, Transfer::Linear, false};

/// A quintic Bezier curve; its control points lie `stride` apart.
float quintic(const float* p, std::size_t stride, float t) {
    const float s = 1 - t;
    const std::array<float, 6> weight{s * s * s * s * s,      5 * s * s * s * s * t,
                                      10 * s * s * s * t * t, 10 * s * s * t * t * t,
                                      5 * s * t * t * t * t,  t * t * t * t * t};
    float sum = 0;
    for (std::size_t i = 0; i < weight.size(); ++i)
        sum += weight[i] * p[i * stride];
    return sum;
}

/// Linear in albedo and turbidity between the tables' values.
///
/// size  of one entry: control points times parameters
template <std::size_t N>
float table_value(const std::array<float, N>& table, std::size_t size, std::size_t offset,
                  std::size_t stride, float turbidity, float albedo, float t) {
    const float cell = std::min(std::floor(turbidity), 9.0F);
    const auto low = static_cast<std::size_t>(cell) - 1;
    const auto at = [&](std::size_t ground, std::size_t air) {
        return quintic(&table[(ground * 10 + air) * size + offset], stride, t);
    };
    const auto over_ground = [&](std::size_t air) {
        return std::lerp(at(0, air), at(1, air), albedo);
    };
    return std::lerp(over_ground(low), over_ground(low + 1), turbidity - cell);
}

/// What is left of sunlight after the air.
///
/// elevation  of the sun [rad]
Color transmittance(float turbidity, float elevation) {
    constexpr std::array<float, 3> kWavelength{0.611F, 0.549F, 0.464F};  // peaks of the bands [um]
    constexpr std::array<float, 3> kOzone{0.12F, 0.08F, 0.01F};          // absorption [1/cm]
    constexpr float kOzoneColumn = 0.35F;                                // [cm]
    // Relative optical mass. Source: Kasten 1965, as quoted by Preetham et al.
    const float zenith_deg = 90 - elevation * 180 / kPi;
    const float mass =
        1 / (std::cos(deg_to_rad(zenith_deg)) + 0.15F * std::pow(93.885F - zenith_deg, -1.253F));
    const float beta = 0.04608F * turbidity - 0.04586F;  // Angstroem's turbidity
    Color out;
    for (std::size_t i = 0; i < 3; ++i)
        out[static_cast<int>(i)] =
            std::exp(-mass * (0.008735F * std::pow(kWavelength[i], -4.08F) +
                              beta * std::pow(kWavelength[i], -1.3F) + kOzone[i] * kOzoneColumn));
    return out;
}

}  // namespace

SkyModel::SkyModel(float turbidity, Color albedo, Vec3f sun, ColorSpace rendering)
    : rendering_from_rec709_(kTableSpace, rendering), toward_sun_(sun) {
    const float air = std::clamp(turbidity, 1.0F, 10.0F);
    const Color albedos = clamp(ColorConversion(rendering, kTableSpace)(albedo), 0, 1);
    const float elevation = std::asin(std::clamp(sun.y, 0.0F, 1.0F));
    const float t = std::cbrt(elevation / (0.5F * kPi));
    for (std::size_t c = 0; c < 3; ++c) {
        const float ground = albedos[static_cast<int>(c)];
        for (std::size_t i = 0; i < 9; ++i)
            shape_[c][i] = table_value(sky_data::kShape[c], 54, i, 9, air, ground, t);
        radiance_[c] =
            table_value(sky_data::kRadiance[c], 6, 0, 1, air, ground, t) * kEfficacy * kPerLux;
    }
    if (!(sun.y > 0)) return;
    constexpr float kSurface = 5778;    // of the sun [K]
    constexpr float kOutside = 127500;  // illuminance outside of the atmosphere [lx]
    const Color outside = ColorConversion(
        kRenderingSpace, kTableSpace)(blackbody_color(kSurface) * (kOutside * kPerLux));
    sun_irradiance_ = rendering_from_rec709_(outside * transmittance(air, elevation));
}

Color SkyModel::sky(Vec3f direction) const {
    if (!(direction.y >= 0)) return kBlack;
    // The formula's angle is to the sun where the tables have it: on the horizon at the lowest.
    const Vec3f sun = toward_sun_.y >= 0
                          ? toward_sun_
                          : normalize(Vec3f{toward_sun_.x, 0, toward_sun_.z}, {0, 1, 0});
    const float cosine = std::clamp(dot(direction, sun), -1.0F, 1.0F), gamma = std::acos(cosine);
    const float height = std::min(direction.y, 1.0F);
    Color out;
    for (std::size_t c = 0; c < 3; ++c) {
        // Equations 8 and 9 of the paper; the order of the last two parameters is that of the tables.
        const auto& [a, b, k, d, e, f, g, i, h] = shape_[c];
        const float around = 1 + h * h - 2 * h * cosine;
        const float halo = (1 + cosine * cosine) / (around * std::sqrt(around));
        const float value =
            (1 + a * std::exp(b / (height + 0.01F))) *
            (k + d * std::exp(e * gamma) + f * cosine * cosine + g * halo + i * std::sqrt(height));
        out[static_cast<int>(c)] = std::max(0.0F, value * radiance_[c]);
    }
    return rendering_from_rec709_(out);
}

}  // namespace lightsieve
