#include "bsdf/albedo_table.h"

#include <array>
#include <cstdint>

#include "bsdf/albedo_grid.h"
#include "bsdf/fresnel.h"
#include "bsdf/sheen.h"

namespace lightsieve {
namespace {

using namespace albedo_grid;
#include "bsdf/albedo_table_data.inc"

/// Cell of an axis with n nodes and the place in it, for a coordinate in [0,1].
struct Cell {
    int index;
    float t;
};

Cell cell(float coordinate, int n) {
    const float x = std::clamp(coordinate, 0.0F, 1.0F) * static_cast<float>(n - 1);
    const int index = std::min(static_cast<int>(x), n - 2);
    return {index, x - static_cast<float>(index)};
}

/// Linear between two stored values `stride` apart.
float along(const std::int16_t* p, int stride, float t) { return lerp(static_cast<float>(p[0]), static_cast<float>(p[stride]), t); }

float bilinear(const std::int16_t* p, int stride_x, float tx, int stride_y, float ty) {
    return lerp(along(p, stride_x, tx), along(p + stride_y, stride_x, tx), ty);
}

/// Entry of the white table below (cos theta, alpha); the values of an entry follow one another.
struct WhiteEntry {
    const std::int16_t* p;
    float t_cos, t_alpha;
    [[nodiscard]] float value(int i) const { return bilinear(p + i, kWhiteValues, t_cos, kWhiteCos * kWhiteValues, t_alpha) * (1 / kScale); }
};

WhiteEntry white_entry(float cos_theta, float alpha) {
    const Cell a = cell(alpha_coordinate(alpha), kWhiteAlpha);
    const Cell c = cell(white_cos_coordinate(cos_theta, alpha), kWhiteCos);
    return {kWhiteData.data() + (a.index * kWhiteCos + c.index) * kWhiteValues, c.t, a.t};
}

/// R of a rough interface, and the share of the rest that gets through.
struct DielectricEntry {
    float reflected, share;
};

DielectricEntry dielectric_entry(float cos_theta, float alpha, float eta) {
    const Cell e = cell(eta_coordinate(eta >= 1 ? eta : 1 / eta), kDielectricEta);
    const Cell a = cell(alpha_coordinate(alpha), kDielectricAlpha);
    const Cell c = cell(dielectric_cos_coordinate(cos_theta, alpha, eta), kDielectricCos);
    constexpr int kStrideAlpha = kDielectricCos * kDielectricValues, kStrideEta = kDielectricAlpha * kStrideAlpha;
    const std::int16_t* p = (eta >= 1 ? kOutsideData : kInsideData).data() + e.index * kStrideEta + a.index * kStrideAlpha + c.index * kDielectricValues;
    const auto value = [&](int i) {
        const float near = bilinear(p + i, kDielectricValues, c.t, kStrideAlpha, a.t);
        const float far = bilinear(p + i + kStrideEta, kDielectricValues, c.t, kStrideAlpha, a.t);
        return lerp(near, far, e.t) * (1 / kScale);
    };
    const float smooth = fresnel_share(alpha, eta) * fresnel_dielectric(cos_theta, eta).reflectance;
    return {std::clamp(smooth + value(0), 0.0F, 1.0F), value(1)};
}

}  // namespace

float ggx_albedo(float cos_theta, float alpha) noexcept { return alpha < kSmoothAlpha ? 1 : white_entry(cos_theta, alpha).value(0); }

GgxMoments ggx_moments(float cos_theta, float alpha) noexcept {
    if (alpha < kSmoothAlpha) {
        const float m = 1 - cos_theta, m5 = square(square(m)) * m;
        return {1, m5, cos_theta * m * m5};
    }
    const WhiteEntry entry = white_entry(cos_theta, alpha);
    return {entry.value(0), entry.value(1), entry.value(2)};
}

float dielectric_albedo(float cos_theta, float alpha, float eta) noexcept {
    if (alpha < kSmoothAlpha) return fresnel_dielectric(cos_theta, eta).reflectance;
    return dielectric_entry(cos_theta, alpha, eta).reflected;
}

float dielectric_transmittance(float cos_theta, float alpha, float eta) noexcept {
    if (alpha < kSmoothAlpha) return 1 - fresnel_dielectric(cos_theta, eta).reflectance;
    const DielectricEntry entry = dielectric_entry(cos_theta, alpha, eta);
    return (1 - entry.reflected) * entry.share;
}

float sheen_albedo(float cos_theta, float roughness) noexcept {
    const Cell r = cell((roughness - kMinSheenRoughness) / (1 - kMinSheenRoughness), kSheenRoughness);
    const Cell c = cell(sheen_cos_coordinate(cos_theta), kSheenCos);
    return bilinear(kSheenData.data() + r.index * kSheenCos + c.index, 1, c.t, kSheenCos, r.t) * (1 / kScale);
}

}  // namespace lightsieve
