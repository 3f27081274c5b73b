#include <gtest/gtest.h>

#include <limits>

#include "nodes/common/node_test_support.h"
#include "scene/shape.h"

namespace lightsieve {

NodeType node_curves();

namespace {

constexpr std::int32_t kBezier = 0, kBSpline = 1, kCatmullRom = 2, kLinear = 3;
constexpr std::int32_t kThick = 1, kOriented = 2;

/// Points along x at 0, 1, 2, ...
std::vector<Vec3f> row(int n) {
    std::vector<Vec3f> out;
    for (int i = 0; i < n; ++i)
        out.push_back({static_cast<float>(i), 0, 0});
    return out;
}

TestNode curves(std::vector<std::uint32_t> counts, std::vector<Vec3f> points,
                std::vector<float> radius, std::int32_t basis) {
    TestNode node(node_curves());
    node.set_array<std::uint32_t>("num_points", std::move(counts));
    node.set_array<Vec3f>("points", std::move(points));
    node.set_array<float>("radius", std::move(radius));
    node.set_enum("basis", basis);
    return node;
}

CurveList built(const TestNode& node, std::size_t n_warnings = 0) {
    TestContext context;
    const auto geometry = node.type().make_geometry(node.block(), context);
    EXPECT_FALSE(context.diagnostics().has_errors()) << context.diagnostics().render();
    EXPECT_EQ(context.count(Code::BadMesh), n_warnings) << context.diagnostics().render();
    return std::get<CurveList>(geometry->data);
}

TEST(Curves, LinearKeepsItsPoints) {
    const CurveList list = built(curves({3, 2}, row(5), {0.5F}, kLinear));
    EXPECT_TRUE(list.linear);
    ASSERT_EQ(list.segments.size(), 3U);
    EXPECT_EQ(list.points[0], row(5));
    EXPECT_EQ(list.segments[1].first, 1U);
    EXPECT_EQ(list.segments[2].first, 3U);
    EXPECT_EQ(list.segments[2].curve, 1U);
    EXPECT_EQ(list.segments[1].v0, 0.5F);
    EXPECT_EQ(list.segments[1].v1, 1);
    EXPECT_EQ(list.radii[0], std::vector<float>(5, 0.5F));
}

TEST(Curves, CubicBasesBecomeBezier) {
    // Equal steps along a line stay equal steps in every basis, but each basis covers another part of the line.
    const auto ends = [](std::int32_t basis, int n) {
        const CurveList list = built(curves({}, row(n), {0.1F}, basis));
        EXPECT_EQ(list.points[0].size(), list.segments.size() * 3 + 1);
        for (std::size_t i = 1; i < list.points[0].size(); ++i)
            EXPECT_NEAR(list.points[0][i].x - list.points[0][i - 1].x,
                        basis == kBezier ? 1.0F : 1.0F / 3, 1e-6F);
        return std::pair{list.points[0].front().x, list.points[0].back().x};
    };
    EXPECT_EQ(ends(kBezier, 7), (std::pair{0.0F, 6.0F}));
    EXPECT_EQ(ends(kCatmullRom, 6), (std::pair{1.0F, 4.0F}));
    const auto [first, last] = ends(kBSpline, 6);
    EXPECT_NEAR(first, 1, 1e-6F);
    EXPECT_NEAR(last, 4, 1e-6F);
}

TEST(Curves, TheCountOfRadiiSaysWhatTheyAre) {
    // Two catmull-rom curves of 5 points: 2 segments and 3 ends each.
    const auto radii = [](std::vector<float> radius) {
        return built(curves({5, 5}, row(10), std::move(radius), kCatmullRom)).radii[0];
    };
    EXPECT_EQ(radii({2})[13], 2);
    EXPECT_EQ(radii({2, 3})[7], 3);
    const auto by_end = radii({0, 3, 6, 1, 1, 1});
    for (std::size_t i = 0; i < 7; ++i)
        EXPECT_NEAR(by_end[i], static_cast<float>(i), 1e-5F);
    EXPECT_EQ(by_end[7], 1);
    const auto by_point = radii({0, 1, 2, 3, 4, 7, 7, 7, 7, 7});
    EXPECT_NEAR(by_point[0], 1, 1e-6F);
    EXPECT_NEAR(by_point[6], 3, 1e-6F);
    EXPECT_NEAR(by_point[10], 7, 1e-5F);
}

TEST(Curves, WrongCountsAreReportedAndTheRestIsShown) {
    EXPECT_EQ(built(curves({5, 5}, row(10), {1, 2, 3}, kCatmullRom), 1).radii[0][0], 1);
    // The second curve lacks points.
    EXPECT_EQ(built(curves({4, 9}, row(10), {1}, kLinear), 1).segments.size(), 3U);
    // Points that no curve uses.
    EXPECT_EQ(built(curves({4}, row(6), {1}, kLinear), 1).segments.size(), 3U);
    TestNode uvs = curves({5, 5}, row(10), {1}, kLinear);
    uvs.set_array<Vec2f>("uvs", {{0, 0}});
    EXPECT_TRUE(built(uvs, 1).uvs.empty());
}

TEST(Curves, OneCountIsThatOfEveryCurve) {
    EXPECT_EQ(built(curves({2}, row(6), {1}, kLinear)).segments.size(), 3U);
    EXPECT_EQ(built(curves({0}, row(6), {1}, kLinear), 1).segments.size(), 0U);
}

TEST(Curves, CurvesThatCannotBeDrawnAreLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Vec3f> points = row(9);
    points[4].y = nan;
    const CurveList list = built(curves({3, 3, 3}, points, {1}, kLinear), 1);
    ASSERT_EQ(list.segments.size(), 4U);
    EXPECT_EQ(list.segments[2].curve, 2U);
    EXPECT_EQ(list.points[0][list.segments[2].first].x, 6);
    // Too short, without radius, radius not a number.
    EXPECT_EQ(built(curves({1, 2}, row(3), {1}, kLinear), 1).segments.size(), 1U);
    EXPECT_EQ(built(curves({2, 2}, row(4), {0, 1}, kLinear), 1).segments.size(), 1U);
    EXPECT_EQ(built(curves({2, 2}, row(4), {nan, -1}, kLinear), 1).segments.size(), 0U);
    EXPECT_EQ(built(curves({2}, row(2), {}, kLinear), 1).segments.size(), 0U);
    EXPECT_EQ(built(curves({}, {}, {1}, kLinear)).segments.size(), 0U);
    // A bezier curve has 4, 7, 10 ... points.
    EXPECT_EQ(built(curves({6}, row(6), {1}, kBezier), 1).segments.size(), 1U);
}

TEST(Curves, MotionKeysMoveTogether) {
    TestNode node = curves({2}, {}, {}, kLinear);
    node.set_array<Vec3f>("points", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, 2);
    node.set_array<float>("radius", {1, 1, 2, 2}, 2);
    const CurveList list = built(node);
    ASSERT_EQ(list.points.size(), 2U);
    EXPECT_EQ(list.points[1][1], (Vec3f{1, 1, 0}));
    EXPECT_EQ(list.radii[1][0], 2);
    node.set_array<float>("radius", {1, 1, 2, 2, 3, 3}, 3);
    EXPECT_EQ(built(node, 1).radii[1][0], 1);
}

TEST(Curves, OrientedCurvesNeedNormals) {
    TestNode node = curves({3}, row(3), {1}, kLinear);
    node.set_enum("mode", kOriented);
    node.set_array<Vec3f>("orientations", {{0, 1, 0}, {0, 1, 0}, {0, 0, 0}});
    const CurveList list = built(node);
    EXPECT_EQ(list.mode, CurveList::Mode::Oriented);
    EXPECT_FALSE(list.linear) << "flat straight segments cannot be turned";
    EXPECT_EQ(list.normals[0].size(), list.points[0].size());
    EXPECT_EQ(list.normals[0].back(), (Vec3f{0, 0, 1})) << "a normal without direction";
    node.set_array<Vec3f>("orientations", {{0, 1, 0}});
    EXPECT_EQ(built(node, 1).mode, CurveList::Mode::Ribbon);
    node.set_enum("mode", kThick);
    EXPECT_EQ(built(node).mode, CurveList::Mode::Thick);
}

TEST(Curves, ThinOnesAreWidenedToAShareOfAPixel) {
    // Without a camera the frame sees all around: at distance 10 a unit has 160 / (2 pi 10) = 2.546 pixels.
    const float least = 0.5F / 2.546F;
    TestNode node = curves({2, 2}, {{0, 0, 10}, {0, 0, 10}, {0, 0, 20}, {0, 0, 20}}, {}, kLinear);
    node.set_array<float>("radius", {0.01F, 0.5F, 0.01F, 0.5F});
    EXPECT_TRUE(built(node).own_radii.empty());
    node.set("min_pixel_width", 1.0F);
    const CurveList list = built(node);
    EXPECT_EQ(list.own_radii[0], (std::vector<float>{0.01F, 0.5F, 0.01F, 0.5F}));
    EXPECT_NEAR(list.radii[0][0], least, 1e-3F);
    EXPECT_EQ(list.radii[0][1], 0.5F);
    EXPECT_NEAR(list.radii[0][2], 2 * least, 2e-3F);
    // Nothing is kept where nothing was widened.
    node.set_array<float>("radius", {0.5F});
    EXPECT_TRUE(built(node).own_radii.empty());
    node.set_array<float>("radius", {0.01F});
    for (const float odd : {-1.0F, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity()}) {
        node.set("min_pixel_width", odd);
        EXPECT_TRUE(built(node).own_radii.empty()) << odd;
    }
}

}  // namespace
}  // namespace lightsieve
