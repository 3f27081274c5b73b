#include "render/turning.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightsieve {
namespace {

/// Stretched by `scale`, turned about y by an angle, then moved.
Mat4f turned(float angle_deg, Vec3f move, Vec3f scale = {1, 1, 1}) {
    const float a = deg_to_rad(angle_deg);
    Mat4f r;
    r.m[0] = {std::cos(a), 0, -std::sin(a), 0};
    r.m[2] = {std::sin(a), 0, std::cos(a), 0};
    return Mat4f::scale(scale) * r * Mat4f::translation(move);
}

void expect_near(const Mat4f& a, const Mat4f& b) {
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(a.m[r][c], b.m[r][c], 2e-5F) << r << c;
}

TEST(Turning, KeysInBetweenTurnEvenly) {
    const std::vector<Mat4f> keys{turned(10, {1, 0, 0}, {1, 2, 3}),
                                  turned(98, {3, 2, 0}, {2, 2, 3})};
    const auto all = turning_keys(keys, TransformType::RotateAboutOrigin, {9, 9, 9});
    ASSERT_EQ(all.size(), 19U);  // steps of 5 degrees
    for (std::size_t i = 0; i < all.size(); ++i) {
        const float t = static_cast<float>(i) / 18;
        expect_near(all[i], turned(10 + 88 * t, {1 + 2 * t, 2 * t, 0}, {1 + t, 2, 3}));
    }
}

TEST(Turning, TheCenterMovesAlongALine) {
    const Vec3f center{2, 0, 1};
    const std::vector<Mat4f> keys{turned(0, {0, 0, 0}), turned(120, {1, 1, 0})};
    const auto all = turning_keys(keys, TransformType::RotateAboutCenter, center);
    ASSERT_GT(all.size(), 20U);
    const Vec3f a = keys[0].point(center), b = keys[1].point(center);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(all.size() - 1);
        EXPECT_LT(length(all[i].point(center) - (a * (1 - t) + b * t)), 1e-5F);
        // Rigid all the way: no corner comes nearer to the center.
        EXPECT_NEAR(length(all[i].point({3, 0, 1}) - all[i].point(center)), 1, 1e-5F);
    }
}

TEST(Turning, WhatDoesNotTurnIsLeftAlone) {
    const std::vector<Mat4f> still{turned(30, {0, 0, 0}), turned(30, {5, 0, 0})};
    EXPECT_EQ(turning_keys(still, TransformType::RotateAboutCenter, {}).size(), 2U);
    const std::vector<Mat4f> turning{turned(0, {}), turned(90, {})};
    EXPECT_EQ(turning_keys(turning, TransformType::Linear, {}).size(), 2U);
    const std::vector<Mat4f> mirrored{turned(0, {}), turned(90, {}, {-1, 1, 1})};
    EXPECT_EQ(turning_keys(mirrored, TransformType::RotateAboutCenter, {}).size(), 2U);
    const std::vector<Mat4f> flat{turned(0, {}, {0, 0, 0}), turned(90, {})};
    EXPECT_EQ(turning_keys(flat, TransformType::RotateAboutCenter, {}).size(), 2U);
    // Both keys mirrored: that turns.
    const std::vector<Mat4f> both{turned(0, {}, {-1, 1, 1}), turned(88, {}, {-1, 1, 1})};
    const auto all = turning_keys(both, TransformType::RotateAboutOrigin, {});
    ASSERT_EQ(all.size(), 19U);
    expect_near(all[9], turned(44, {}, {-1, 1, 1}));
}

TEST(Turning, ManyKeysStayWithinWhatTheRayLibraryTakes) {
    std::vector<Mat4f> keys;
    for (int i = 0; i < 60; ++i)
        keys.push_back(turned(static_cast<float>(i % 2) * 170, {}));
    EXPECT_LE(turning_keys(keys, TransformType::RotateAboutCenter, {}).size(), 128U);
}

}  // namespace
}  // namespace lightsieve
