// Rotations as matrices of row vectors, for nodes that are given angles.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/matrix.h"

namespace lightsieve {

/// Which axis comes first.
enum class RotationOrder : std::int32_t { Xyz, Xzy, Yxz, Yzx, Zxy, Zyx };
/// Names for `ParamBuilder::names`.
inline std::vector<std::string> rotation_order_names() {
    return {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"};
}

/// Rotation by `angle_rad` about a unit axis. Source: Rodrigues' formula.
inline Mat4f rotation_about(Vec3f axis, float angle_rad) {
    const float s = std::sin(angle_rad), c = std::cos(angle_rad);
    Mat4f out;
    const std::array<Vec3f, 3> axes{Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3f v =
            axes[i] * c + cross(axis, axes[i]) * s + axis * (dot(axis, axes[i]) * (1 - c));
        out.m[i] = {v.x, v.y, v.z, 0};
    }
    return out;
}

/// Rotations about the three axes, one after the other.
inline Mat4f rotation_in_order(Vec3f angles_rad, RotationOrder order) {
    const std::array<Mat4f, 3> about{rotation_about({1, 0, 0}, angles_rad.x),
                                     rotation_about({0, 1, 0}, angles_rad.y),
                                     rotation_about({0, 0, 1}, angles_rad.z)};
    constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    const auto& axes = kOrders.at(static_cast<std::size_t>(order));
    return about.at(axes[0]) * about.at(axes[1]) * about.at(axes[2]);
}

}  // namespace lightsieve
