// One row a formula: what each mathematical node gives for known numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/all_nodes.h"
#include "nodes/common/node_test_support.h"
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

TestNode node_of(const char* type) { return TestNode(*builtin_registry().find(type)); }
ShaderValue value(const TestNode& node, const ShadePoint& at = {}) {
    return node.type().eval_value(node.block(), at);
}
void expect_color(Color is, Color expected, const char* what, double tolerance = 1e-5) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(is[c], expected[c], tolerance) << what << ", channel " << c;
}

TEST(MathNodes, WorkChannelByChannel) {
    struct Row {
        const char* node;
        Color input, expected;
    };
    for (const Row& row : {
             Row{"abs", {-2, 0, 3}, {2, 0, 3}},
             Row{"sqrt", {4, 0.25F, -1}, {2, 0.5F, 0}},
             Row{"exp", {0, 1, -1}, {1, 2.7182818F, 0.3678794F}},
             Row{"negate", {1, -2, 0}, {-1, 2, 0}},
             Row{"reciprocal", {4, -2, 0}, {0.25F, -0.5F, 0}},
             Row{"fraction", {1.25F, -0.25F, 3}, {0.25F, 0.75F, 0}},
             Row{"sign", {7, -0.5F, 0}, {1, -1, 0}},
             Row{"complement", {0.25F, 1, 3}, {0.75F, 0, -2}},
             Row{"log", {2.7182818F, 1, -1}, {1, 0, 0}},
         })
        expect_color(value(node_of(row.node).set("input", row.input)).rgb, row.expected, row.node);
}

TEST(MathNodes, TakeTwoColours) {
    struct Row {
        const char *node, *first, *second;
        Color a, b, expected;
    };
    for (const Row& row : {
             Row{"subtract", "input1", "input2", {1, 2, 3}, {3, 2, 1}, {-2, 0, 2}},
             Row{"divide", "input1", "input2", {1, 2, 3}, {4, 0, -1}, {0.25F, 0, -3}},
             Row{"min", "input1", "input2", {1, 5, 3}, {4, 0, 3}, {1, 0, 3}},
             Row{"max", "input1", "input2", {1, 5, 3}, {4, 0, 3}, {4, 5, 3}},
             Row{"pow", "base", "exponent", {2, 9, 5}, {3, 0.5F, 0}, {8, 3, 1}},
             Row{"modulo", "input", "divisor", {7, -7, 1}, {4, 4, 0}, {3, -3, 0}},
         })
        expect_color(value(node_of(row.node).set(row.first, row.a).set(row.second, row.b)).rgb,
                     row.expected, row.node);
}

TEST(MathNodes, TrigoKnowsFunctionsAndUnits) {
    TestNode trigo = node_of("trigo");
    trigo.set("input", Color{30, 0, 90}).set_enum("units", 1).set_enum("function", 1);
    expect_color(value(trigo).rgb, {0.5F, 0, 1}, "sin");
    trigo.set("frequency", 2.0F).set("phase", 30.0F);
    expect_color(value(trigo).rgb, {1, 0.5F, -0.5F}, "sin of 2 x + 30");
    trigo.set("frequency", 1.0F).set("phase", 0.0F).set_enum("function", 4);
    trigo.set("input", Color{0.5F, 2, -1});
    expect_color(value(trigo).rgb, {30, 90, -90}, "asin");
    TestNode atan = node_of("atan");
    atan.set("y", Color{1, 1, -1}).set("x", Color{1, 0, -1}).set_enum("units", 1);
    expect_color(value(atan).rgb, {45, 90, -135}, "atan", 1e-4);
}

TEST(MathNodes, RangeMapsIntervals) {
    TestNode range = node_of("range");
    range.set("input", Color{2, 3, 6}).set("input_min", 2.0F).set("input_max", 4.0F);
    range.set("output_min", 10.0F).set("output_max", 20.0F);
    expect_color(value(range).rgb, {10, 15, 30}, "linear, not limited");
    range.set("smoothstep", true).set("input", Color{2.5F, 1, 9});
    expect_color(value(range).rgb, {11.5625F, 10, 20}, "smoothstep");
    range.set("smoothstep", false).set("bias", 0.25F).set("input", Color{3, 2, 4});
    expect_color(value(range).rgb, {12.5F, 10, 20}, "bias");
    range.set("bias", 0.5F).set("contrast", 2.0F).set("input", Color{3, 3.5F, 2.5F});
    expect_color(value(range).rgb, {15, 20, 10}, "contrast");
}

TEST(MathNodes, PerlinCurvesKeepTheirFixedPoints) {
    for (const float b : {0.1F, 0.3F, 0.9F}) {
        EXPECT_NEAR(perlin_bias(0.5F, b), b, 1e-6);
        EXPECT_EQ(perlin_bias(0, b), 0);
        EXPECT_EQ(perlin_bias(1, b), 1);
        EXPECT_NEAR(perlin_gain(0.5F, b), 0.5, 1e-6);
    }
    EXPECT_GT(perlin_gain(0.9F, 0.8F) - perlin_gain(0.1F, 0.8F), 0);
}

TEST(MathNodes, ClampCompareAndRounding) {
    TestNode clamp = node_of("clamp");
    clamp.set("input", Color{-1, 0.5F, 2});
    expect_color(value(clamp).rgb, {0, 0.5F, 1}, "scalar");
    clamp.set_enum("mode", 1)
        .set("min_color", Color{0.1F, 0.6F, 0})
        .set("max_color", Color{1, 1, 3});
    expect_color(value(clamp).rgb, {0.1F, 0.6F, 2}, "color");
    const bool expected[]{false, true, false, true, false, true};
    for (std::int32_t test = 0; test < 6; ++test)
        EXPECT_EQ(
            value(
                node_of("compare").set("input1", 1.0F).set("input2", 2.0F).set_enum("test", test))
                    .rgb.r != 0,
            expected[test]);
    const float rounded[]{-2, -1, -2, -1};
    for (std::int32_t mode = 0; mode < 4; ++mode)
        EXPECT_EQ(value(node_of("float_to_int").set("input", -1.6F).set_enum("mode", mode)).rgb.r,
                  rounded[mode]);
    EXPECT_EQ(value(node_of("is_finite").set("input", Color{0, kInfinity, 0})).rgb.r, 0);
    EXPECT_EQ(value(node_of("is_finite")).rgb.r, 1);
}

TEST(MathNodes, VectorsAndConversions) {
    const Vec3f a{1, 2, 3}, b{-2, 0.5F, 4};
    EXPECT_NEAR(value(node_of("dot").set("input1", a).set("input2", b)).rgb.r, 11, 1e-6);
    expect_color(value(node_of("cross").set("input1", a).set("input2", b)).rgb, {6.5F, -10, 4.5F},
                 "cross");
    expect_color(value(node_of("normalize").set("input", Vec3f{0, 3, 4})).rgb, {0, 0.6F, 0.8F},
                 "normalize");
    const float lengths[]{5, 25, 7};
    for (std::int32_t mode = 0; mode < 3; ++mode)
        EXPECT_NEAR(
            value(node_of("length").set("input", Vec3f{0, -3, 4}).set_enum("mode", mode)).rgb.r,
            lengths[mode], 1e-6);
    expect_color(value(node_of("float_to_rgb").set("r", 1.0F).set("b", 3.0F)).rgb, {1, 0, 3},
                 "rgb");
    EXPECT_EQ(value(node_of("float_to_rgba").set("a", 0.25F)).a, 0.25F);
    const float floats[]{0.1F, 0.6F, 0.3F, 0.9F, 0.1F * 0.2126F + 0.2F * 0.7152F + 0.6F * 0.0722F,
                         0.1F, 0.2F, 0.6F};
    for (std::int32_t mode = 0; mode < 8; ++mode)
        EXPECT_NEAR(value(node_of("rgb_to_float")
                              .set("input", Color{0.1F, 0.2F, 0.6F})
                              .set_enum("mode", mode))
                        .rgb.r,
                    floats[mode], 1e-6)
            << mode;
    TestNode rgba = node_of("rgba_to_float");
    rgba.set("input", Rgba{{0.1F, 0.2F, 0.6F}, 0.7F});
    EXPECT_NEAR(value(rgba).rgb.r, 0.4, 1e-6);
    EXPECT_EQ(value(rgba.set_enum("mode", 1)).rgb.r, 0.7F);
    expect_color(
        value(node_of("rgb_to_vector").set("input", Color{0, 0.5F, 1}).set_enum("mode", 1)).rgb,
        {-1, 0, 1}, "canonical");
    expect_color(
        value(node_of("vector_to_rgb").set("input", Vec3f{0, 0, -2}).set_enum("mode", 1)).rgb,
        {0.5F, 0.5F, 0}, "normalized");
}

TEST(MathNodes, Matrices) {
    TestNode transform = node_of("matrix_transform");
    transform.set("rotation", Vec3f{0, 0, 90}).set("scale", Vec3f{2, 1, 1});
    transform.set("translate", Vec3f{0, 0, 5});
    const auto moved = [&](Vec3f p) {
        return transform.type().eval_matrix(transform.block(), {}).point(p);
    };
    EXPECT_NEAR(length(moved({1, 0, 0}) - Vec3f{0, 2, 5}), 0, 1e-5)
        << "scale, rotation, translation";
    transform.set_enum("transform_order", 2);
    EXPECT_NEAR(length(moved({1, 0, 0}) - Vec3f{0, 1, 5}), 0, 1e-5) << "rotation first";
    transform.set_enum("rotation_type", 1).set("axis", Vec3f{0, 2, 0}).set("angle", 90.0F);
    EXPECT_NEAR(length(moved({0, 0, 1}) - Vec3f{2, 0, 5}), 0, 1e-5) << "about y, from z to x";
    transform.set("pivot", Vec3f{0, 0, 1});
    EXPECT_NEAR(length(moved({0, 0, 1}) - Vec3f{0, 0, 6}), 0, 1e-5) << "the pivot only moves";

    TestNode multiply = node_of("matrix_multiply_vector");
    multiply.set("matrix", Mat4f::scale({2, 1, 1}) * Mat4f::translation({1, 0, 0}));
    multiply.set("input", Vec3f{1, 1, 0});
    expect_color(value(multiply).rgb, {3, 1, 0}, "point");
    expect_color(value(multiply.set_enum("type", 1)).rgb, {2, 1, 0}, "vector");
    expect_color(value(multiply.set_enum("type", 2)).rgb, {0.5F, 1, 0}, "normal");

    TestNode blend = node_of("matrix_interpolate");
    blend.set_array<Mat4f>("matrix", {Mat4f{}, Mat4f::translation({4, 0, 0}), Mat4f{}});
    ShadePoint at;
    at.time = 0.25F;
    EXPECT_NEAR(blend.type().eval_matrix(blend.block(), at).point({}).x, 2, 1e-6);
    blend.set_enum("type", 1).set("value", 0.5F);
    EXPECT_NEAR(blend.type().eval_matrix(blend.block(), at).point({}).x, 4, 1e-6);
    EXPECT_EQ(node_of("float_to_matrix").set("input_31", 3.0F).get<float>("input_31"), 3);
}

TEST(MathNodes, RandomIsEvenAndRepeats) {
    TestNode random = node_of("random");
    Color mean;
    constexpr int kDraws = 4000;
    for (int i = 0; i < kDraws; ++i) {
        random.set("input_int", std::int32_t{i});
        const Color c = value(random).rgb;
        EXPECT_EQ(c, value(random).rgb);
        mean += c * (1.0F / kDraws);
    }
    // Standard deviation of the mean: 0.29 / sqrt(4000) = 0.0046; five of them.
    expect_color(mean, Color::grey(0.5F), "mean", 0.023);
    const Color first = value(random).rgb;
    EXPECT_NE(first, value(random.set("seed", std::int32_t{1})).rgb);
    random.set("grayscale", true);
    EXPECT_EQ(value(random).rgb.r, value(random).rgb.b);
    random.set_enum("input_type", 1).set("input_float", 0.0F);
    const Color zero = value(random).rgb;
    EXPECT_EQ(zero, value(random.set("input_float", -0.0F)).rgb);
}

TEST(MathNodes, HsvRoundTrip) {
    for (const Color c : {Color{0.2F, 0.7F, 0.1F}, Color{3, 0.5F, 1}, Color{0.5F, 0.5F, 0.5F}})
        expect_color(rgb_from_hsv(hsv_from_rgb(c)), c, "there and back", 1e-5);
}

}  // namespace
}  // namespace lightsieve
