#include <gtest/gtest.h>

#include <limits>

#include "nodes/common/node_test_support.h"
#include "scene/shape.h"

namespace lightsieve {

NodeType node_points();

namespace {

constexpr std::int32_t kDisk = 0, kQuad = 2;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TestNode points(std::vector<Vec3f> places, std::vector<float> radius, std::int32_t mode,
                std::uint32_t n_keys = 1) {
    TestNode node(node_points());
    node.set_array<Vec3f>("points", std::move(places), n_keys);
    node.set_array<float>("radius", std::move(radius));
    node.set_enum("mode", mode);
    return node;
}

PointList built(const TestNode& node, std::size_t n_warnings = 0) {
    TestContext context;
    const auto geometry = node.type().make_geometry(node.block(), context);
    EXPECT_FALSE(context.diagnostics().has_errors()) << context.diagnostics().render();
    EXPECT_EQ(context.count(Code::BadMesh), n_warnings) << context.diagnostics().render();
    return std::get<PointList>(geometry->data);
}

TEST(Points, OneRadiusForAllOrOneEach) {
    const std::vector<Vec3f> three{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    EXPECT_EQ(built(points(three, {0.5F}, kDisk)).radii[0], std::vector<float>(3, 0.5F));
    const PointList each = built(points(three, {1, 2, 3}, kDisk));
    EXPECT_EQ(each.radii[0], (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(each.centers[0], three);
    EXPECT_EQ(each.index, (std::vector<std::uint32_t>{0, 1, 2}));
    // Counts that do not fit.
    EXPECT_EQ(built(points(three, {1, 2}, kDisk), 1).radii[0], (std::vector<float>{1, 2, 1}));
}

TEST(Points, MotionKeys) {
    const PointList list =
        built(points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0.5F}, kDisk, 2));
    ASSERT_EQ(list.centers.size(), 2U);
    EXPECT_EQ(list.centers[1], (std::vector<Vec3f>{{0, 1, 0}, {1, 1, 0}}));
    ASSERT_EQ(list.radii.size(), 2U);
    // Radii may move where points do not.
    TestNode growing(node_points());
    growing.set_array<Vec3f>("points", {{1, 2, 3}});
    growing.set_array<float>("radius", {1, 2}, 2);
    const PointList grown = built(growing);
    ASSERT_EQ(grown.centers.size(), 2U);
    EXPECT_EQ(grown.centers[1][0], (Vec3f{1, 2, 3}));
    EXPECT_EQ(grown.radii[1][0], 2);
}

TEST(Points, BadOnesAreLeftOutAndTheOthersKeepTheirNumbers) {
    const PointList list = built(points({{0, 0, 0}, {kNan, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},
                                        {1, 1, -1, kNan, 2}, kDisk),
                                 2);
    EXPECT_EQ(list.index, (std::vector<std::uint32_t>{0, 4}));
    EXPECT_EQ(list.radii[0], (std::vector<float>{1, 2}));
    EXPECT_TRUE(built(points({{0, 0, 0}}, {}, kDisk), 1).index.empty());
    EXPECT_TRUE(built(points({}, {}, kDisk)).index.empty());
}

TEST(Points, QuadsHaveAspectAndRotation) {
    TestNode node = points({{0, 0, 0}, {1, 0, 0}}, {0.5F}, kQuad);
    node.set_array<float>("aspect", {2, 0});
    node.set_array<float>("rotation", {90});
    const PointList list = built(node, 1);
    EXPECT_EQ(list.aspect, (std::vector<float>{2, 1}));
    EXPECT_NEAR(list.rotation_rad[0], kPi / 2, 1e-6F);
    EXPECT_EQ(list.rotation_rad[1], 0);
    EXPECT_EQ(list.up, (Vec3f{0, 1, 0}));
}

TEST(Points, SmallOnesAreWidenedToAShareOfAPixel) {
    // Without a camera the frame sees all around: at distance 10 a unit has 160 / (2 pi 10) = 2.546 pixels.
    TestNode node = points({{0, 0, 10}, {10, 0, 0}}, {0.01F, 0.5F}, kDisk);
    EXPECT_TRUE(built(node).own_radii.empty());
    node.set("min_pixel_width", 1.0F);
    const PointList list = built(node);
    EXPECT_EQ(list.own_radii[0], (std::vector<float>{0.01F, 0.5F}));
    EXPECT_NEAR(list.radii[0][0], 0.5F / 2.546F, 1e-3F);
    EXPECT_EQ(list.radii[0][1], 0.5F);
}

}  // namespace
}  // namespace lightsieve
