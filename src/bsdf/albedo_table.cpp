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
float along(const std::int16_t* p, int stride, float t) {
    return lerp(static_cast<float>(p[0]), static_cast<float>(p[stride]), t);
}

float bilinear(const std::int16_t* p, int stride_x, float tx, int stride_y, float ty) {
    return lerp(along(p, stride_x, tx), along(p + stride_y, stride_x, tx), ty);
}

DielectricShares rough_dielectric(float cos_theta, float alpha, float eta) {
    const bool outside = eta >= 1;
    const Cell e =
        cell(eta_coordinate(outside ? eta : 1 / eta), outside ? kOutsideEta : kInsideEta);
    const Cell a = cell(alpha_coordinate(alpha), kDielectricAlpha);
    const Cell c = cell(dielectric_cos_coordinate(cos_theta, alpha, eta), kDielectricCos);
    constexpr int kStrideAlpha = kDielectricCos * kDielectricValues,
                  kStrideEta = kDielectricAlpha * kStrideAlpha;
    const std::int16_t* p = (outside ? kOutsideData.data() : kInsideData.data()) +
                            e.index * kStrideEta + a.index * kStrideAlpha +
                            c.index * kDielectricValues;
    const auto value = [&](int i) {
        const float near = bilinear(p + i, kDielectricValues, c.t, kStrideAlpha, a.t);
        const float far = bilinear(p + i + kStrideEta, kDielectricValues, c.t, kStrideAlpha, a.t);
        return lerp(near, far, e.t) * (1 / kScale);
    };
    const float smooth =
        fresnel_share(alpha, eta) * fresnel_dielectric(cos_theta, eta).reflectance;
    return {std::clamp(smooth + value(0), 0.0F, 1.0F), value(1)};
}

}  // namespace

float ggx_albedo(float cos_theta, float alpha) noexcept {
    if (alpha < kSmoothAlpha) return 1;
    const Cell a = cell(alpha_coordinate(alpha), kWhiteAlpha);
    const Cell c = cell(white_cos_coordinate(cos_theta, alpha), kWhiteCos);
    return bilinear(kWhiteData.data() + a.index * kWhiteCos + c.index, 1, c.t, kWhiteCos, a.t) *
           (1 / kScale);
}

MeanCosines ggx_mean_cosines(float cos_theta, float alpha) noexcept {
    if (alpha < kSmoothAlpha) return {{cos_theta, cos_theta, cos_theta}, {0, 0, 1}};
    const Cell a = cell(alpha_coordinate(alpha), kMeanAlpha);
    const Cell c = cell(white_cos_coordinate(cos_theta, alpha), kMeanCos);
    const std::int16_t* p = kMeanData.data() + (a.index * kMeanCos + c.index) * kMeanValues;
    const auto value = [&](int i) {
        return bilinear(p + i, kMeanValues, c.t, kMeanCos * kMeanValues, a.t) * (1 / kScale);
    };
    const float first = value(3), second = value(4);
    return {{value(0), value(1), value(2)}, {first, second, 1 - first - second}};
}

DielectricShares dielectric_shares(float cos_theta, float alpha, float eta) noexcept {
    if (alpha < kSmoothAlpha) return {fresnel_dielectric(cos_theta, eta).reflectance, 1};
    return rough_dielectric(cos_theta, alpha, eta);
}

float dielectric_albedo(float cos_theta, float alpha, float eta) noexcept {
    return dielectric_shares(cos_theta, alpha, eta).reflected;
}

float sheen_albedo(float cos_theta, float roughness) noexcept {
    const Cell r =
        cell((roughness - kMinSheenRoughness) / (1 - kMinSheenRoughness), kSheenRoughness);
    const Cell c = cell(sheen_cos_coordinate(cos_theta), kSheenCos);
    return bilinear(kSheenData.data() + r.index * kSheenCos + c.index, 1, c.t, kSheenCos, r.t) *
           (1 / kScale);
}

}  // namespace lightsieve
