// Where the entries of the albedo tables lie; shared by the lookup and by tools/make_albedo_table.cpp.
//
// The integrals change fast near the horizon (over cos theta ~ alpha), near the critical angle (where exact Fresnel
// has a kink) and for small alpha. Each axis is therefore a monotone map of its parameter to [0,1] that gives such
// places more nodes, followed by n equally spaced nodes. Interpolation is linear along every axis.
#pragma once

#include <bit>
#include <cstdint>

#include "bsdf/dielectric.h"
#include "core/vec.h"

namespace lightsieve::albedo_grid {

/// Nodes of the table of E, the albedo of white microfacets: cos theta, alpha.
inline constexpr int kWhiteCos = 32, kWhiteAlpha = 32;
/// Nodes of the table of mean cosines; three cosines and the weights of the first two of them.
inline constexpr int kMeanCos = 24, kMeanAlpha = 16, kMeanValues = 5;
/// Nodes of the tables of dielectrics, one for each side: cos theta, alpha, eta.
inline constexpr int kDielectricCos = 24, kDielectricAlpha = 16, kOutsideEta = 12, kInsideEta = 16;
/// Values of a dielectric table: R - base * Fresnel, and T / (1 - R).
inline constexpr int kDielectricValues = 2;
/// Nodes of the sheen table: cos theta, roughness.
inline constexpr int kSheenCos = 32, kSheenRoughness = 16;
/// Stored integers are value * kScale.
inline constexpr float kScale = 30000;
/// The smallest cosine that is tabulated.
inline constexpr float kMinCos = 1e-4F;
/// Node of the critical angle along the cosine axis of the inner table.
inline constexpr int kCriticalNode = 14;

/// alpha in [kSmoothAlpha, 1] to [0,1].
[[nodiscard]] inline float alpha_coordinate(float alpha) {
    const float smallest = std::sqrt(kSmoothAlpha);
    return (std::sqrt(alpha) - smallest) / (1 - smallest);
}

/// cos theta to [0,1], tables of white microfacets: half of the nodes lie below 2 alpha.
[[nodiscard]] inline float white_cos_coordinate(float cos_theta, float alpha) {
    const float k = 2 * alpha;
    return cos_theta * (1 + k) / (cos_theta + k);
}

/// cos theta to [0,1], sheen table.
[[nodiscard]] inline float sheen_cos_coordinate(float cos_theta) { return std::sqrt(cos_theta); }

/// eta above 1 to [0,1]; for the inside give 1 / eta.
[[nodiscard]] inline float eta_coordinate(float eta) {
    return std::sqrt((eta - 1) * (kMaxEta + 1) / ((eta + 1) * (kMaxEta - 1)));
}

/// log2 of a normal positive number within 3e-6: cheaper than std::log and the same on every processor.
[[nodiscard]] inline float quick_log2(float x) {
    // x = 2^exponent * m with m in [sqrt(1/2), sqrt(2)); then the series of atanh.
    const std::int32_t bits = std::bit_cast<std::int32_t>(x), exponent = (bits - 0x3f3504f3) >> 23;
    const float m = std::bit_cast<float>(bits - (exponent << 23));
    const float t = (m - 1) / (m + 1), t2 = t * t;
    return static_cast<float>(exponent) + t * (2.8853901F + t2 * (0.96179669F + t2 * 0.57707802F));
}

/// y in [0,1] to [0,1], logarithmic from scale k on.
[[nodiscard]] inline float logarithmic(float y, float k) {
    return quick_log2(1 + y / k) / quick_log2(1 + 1 / k);
}

/// Width of the blur of the critical angle; 1 - eta^2 is its distance from the horizon.
[[nodiscard]] inline float blur(float alpha, float eta) {
    const float room = std::abs((eta - 1) * (eta + 1));
    return 0.3F * alpha * room / (room + 4 * alpha);
}

/// cos theta to [0,1], dielectric table of the side that eta is on.
[[nodiscard]] inline float dielectric_cos_coordinate(float cos_theta, float alpha, float eta) {
    if (eta >= 1) return logarithmic(cos_theta, 0.3F * alpha);
    constexpr float kCritical = static_cast<float>(kCriticalNode) / (kDielectricCos - 1);
    const float k = blur(alpha, eta);
    const float cos2_critical = (1 - eta) * (1 + eta), cos_critical = std::sqrt(cos2_critical);
    const float beyond = square(cos_theta) - cos2_critical;
    if (beyond >= 0)
        return kCritical + (1 - kCritical) * logarithmic(std::min(beyond / square(eta), 1.0F), k);
    const float y = std::min(1 - cos_theta / cos_critical, 1.0F);
    return kCritical * (1 - 0.5F * (1 + logarithmic(y, k) - logarithmic(1 - y, k)));
}

/// The share of exact Fresnel that is subtracted from R before it is tabulated, so that narrow lobes tend to it exactly.
[[nodiscard]] inline float fresnel_share(float alpha, float eta) {
    if (eta >= 1) return 1;
    const float room2 = square((eta - 1) * (eta + 1));
    return room2 / (room2 + 4 * alpha * alpha);
}

}  // namespace lightsieve::albedo_grid
