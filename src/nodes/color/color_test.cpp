// Nodes that change colours.
#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {
namespace {

TestNode node_of(const char* type) { return TestNode(*builtin_registry().find(type)); }
ShaderValue value(const TestNode& node, const ShadePoint& at = {}) {
    return node.type().eval_value(node.block(), at);
}
void expect_color(Color is, Color expected, double tolerance = 1e-5) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(is[c], expected[c], tolerance) << "channel " << c;
}

TEST(ColorCorrect, EachStepAlone) {
    const Color in{0.25F, 0.5F, 1};
    const auto corrected = [&](auto... set) {
        TestNode node = node_of("color_correct");
        node.set("input", Rgba{in, 0.5F});
        (set(node), ...);
        return value(node);
    };
    expect_color(corrected().rgb, in);
    expect_color(corrected([](TestNode& n) { n.set("gamma", 2.0F); }).rgb, {0.5F, 0.7071068F, 1});
    expect_color(corrected([](TestNode& n) { n.set("invert", true); }).rgb, {0.75F, 0.5F, 0});
    expect_color(corrected([](TestNode& n) { n.set("saturation", 0.0F); }).rgb,
                 Color::grey(luminance(in)));
    expect_color(
        corrected([](TestNode& n) { n.set("contrast", 2.0F).set("contrast_pivot", 0.5F); }).rgb,
        {0, 0.5F, 1.5F});
    expect_color(corrected([](TestNode& n) { n.set("exposure", 1.0F); }).rgb, in * 2);
    expect_color(corrected([](TestNode& n) {
                     n.set("multiply", Color{2, 1, 0}).set("add", Color{0, 0, 3});
                 }).rgb,
                 {0.5F, 0.5F, 3});
    // A third of a turn: red to green to blue.
    expect_color(corrected([](TestNode& n) { n.set("hue_shift", 1.0F / 3); }).rgb,
                 {1, 0.25F, 0.5F});
    expect_color(corrected([](TestNode& n) { n.set("exposure", 1.0F).set("mask", 0.5F); }).rgb,
                 in * 1.5F);
}

TEST(ColorCorrect, Alpha) {
    TestNode node = node_of("color_correct");
    node.set("input", Rgba{Color::grey(0.25F), 0.5F})
        .set("alpha_multiply", 0.5F)
        .set("alpha_add", 0.1F);
    EXPECT_NEAR(value(node).a, 0.35, 1e-6);
    EXPECT_NEAR(value(node.set("invert_alpha", true)).a, 0.65, 1e-6);
    EXPECT_NEAR(value(node.set("alpha_is_luminance", true)).a, 1 - 0.225, 1e-5);
}

TEST(MixRgba, Blends) {
    TestNode node = node_of("mix_rgba");
    node.set("input1", Rgba{{1, 0, 0}, 1}).set("input2", Rgba{{0, 1, 0}, 0}).set("mix", 0.25F);
    expect_color(value(node).rgb, {0.75F, 0.25F, 0});
    EXPECT_NEAR(value(node).a, 0.75, 1e-6);
}

TEST(Shuffle, Reorders) {
    TestNode node = node_of("shuffle");
    node.set("color", Color{0.1F, 0.2F, 0.3F}).set("alpha", 0.4F);
    expect_color(value(node).rgb, {0.1F, 0.2F, 0.3F});
    node.set_enum("channel_r", 3).set_enum("channel_a", 2).set("negate_g", true);
    expect_color(value(node).rgb, {0.4F, 0.8F, 0.3F});
    EXPECT_NEAR(value(node).a, 0.3, 1e-6);
}

TEST(Composite, PutsPremultipliedColoursTogether) {
    TestNode node = node_of("composite");
    node.set("A", Rgba{{0.5F, 0, 0}, 0.5F}).set("B", Rgba{{0, 0.8F, 0}, 0.8F});
    expect_color(value(node).rgb, {0.5F, 0.4F, 0});
    EXPECT_NEAR(value(node).a, 0.9, 1e-6) << "over is the default";
    const auto& names = node.type().find("operation")->enumerators;
    const auto with = [&](const char* operation) {
        const auto found = std::find(names.begin(), names.end(), operation);
        EXPECT_NE(found, names.end()) << operation;
        node.set_enum("operation", static_cast<std::int32_t>(found - names.begin()));
        return value(node);
    };
    expect_color(with("A").rgb, {0.5F, 0, 0});
    expect_color(with("in").rgb, {0.4F, 0, 0});
    expect_color(with("out").rgb, {0.1F, 0, 0});
    expect_color(with("atop").rgb, {0.4F, 0.4F, 0});
    expect_color(with("xor").rgb, {0.1F, 0.4F, 0});
    expect_color(with("under").rgb, {0.1F, 0.8F, 0});
    expect_color(with("plus").rgb, {0.5F, 0.8F, 0});
    expect_color(with("geometric").rgb, kBlack);
    EXPECT_NEAR(with("stencil").a, 0.4, 1e-6);
    node.set_enum("alpha_operation", 2);
    EXPECT_NEAR(value(node).a, 0.8, 1e-6);
}

TEST(LayerFloat, BlendsFromTheBottom) {
    TestNode node = node_of("layer_float");
    node.set("input1", 2.0F).set("enable2", true).set("input2", 4.0F).set("mix2", 0.25F);
    EXPECT_NEAR(value(node).rgb.r, 2.5, 1e-6);
    node.set("input8", 10.0F);
    EXPECT_NEAR(value(node).rgb.r, 2.5, 1e-6) << "layer 8 is off";
}

TEST(SwitchRgba, ChoosesByNumber) {
    TestNode node = node_of("switch_rgba");
    node.set("input3", Rgba{{1, 2, 3}, 0.5F}).set("index", std::int32_t{3});
    EXPECT_EQ(value(node), (Rgba{{1, 2, 3}, 0.5F}));
    node.set("input19", Rgba{{4, 4, 4}, 1}).set("index", std::int32_t{50});
    expect_color(value(node).rgb, {4, 4, 4});
    node.set("index", std::int32_t{-5});
    expect_color(value(node).rgb, kBlack);
}

TEST(ColorJitter, StaysWithinItsRanges) {
    TestNode node = node_of("color_jitter");
    const Color in{0.5F, 0.25F, 0.25F};
    node.set("input", in);
    expect_color(value(node).rgb, in);
    node.set("obj_gain_min", 0.1F).set("obj_gain_max", 0.3F);
    float low = 9, high = 0;
    for (std::uint32_t id = 0; id < 200; ++id) {
        ShadePoint at;
        at.shape_id = id;
        const float brightest = max_component(value(node, at).rgb);
        low = std::min(low, brightest);
        high = std::max(high, brightest);
    }
    EXPECT_GE(low, 0.6F - 1e-5F);
    EXPECT_LT(low, 0.62F);
    EXPECT_LE(high, 0.8F + 1e-5F);
    EXPECT_GT(high, 0.78F);
    ShadePoint first, second;
    second.primitive = 1;
    EXPECT_EQ(value(node, first), value(node, second)) << "faces do not count yet";
    node.set("face_hue_max", 1.0F);
    EXPECT_NE(value(node, first), value(node, second));
}

TEST(ColorConvert, ByName) {
    TestNode node = node_of("color_convert");
    node.set("input", Color{0.2F, 0.4F, 0.6F});
    TestContext context;
    node.type().prepare(node.block(), context);
    expect_color(value(node).rgb, {0.2F, 0.4F, 0.6F});
    node.set("from", Name("sRGB")).set("input", kWhite);
    node.type().prepare(node.block(), context);
    expect_color(value(node).rgb, kWhite, 1e-3);
    node.set("from", Name("RGB")).set("to", Name("HSV")).set("input", Color{0, 0.5F, 0});
    node.type().prepare(node.block(), context);
    expect_color(value(node).rgb, {1.0F / 3, 1, 0.5F});
}

TEST(Blackbody, ColourAndRadiance) {
    TestNode node = node_of("blackbody");
    EXPECT_NEAR(luminance(value(node).rgb), 1, 0.01);
    const Color warm = value(node.set("temperature", 2500.0F)).rgb;
    EXPECT_GT(warm.r, warm.b * 2);
    node.set("normalize", false).set("intensity", 0.5F);
    const float once = value(node).rgb.g;
    EXPECT_NEAR(value(node.set("intensity", 1.0F)).rgb.g / once, 2, 1e-4);
    EXPECT_EQ(value(node.set("temperature", -5.0F)).rgb, kBlack);
}

}  // namespace
}  // namespace lightsieve
