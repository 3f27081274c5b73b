// Ramps: where a point lies, and what is between the keys.
#include "nodes/texture/ramp.h"

#include <gtest/gtest.h>

#include "nodes/common/node_test_support.h"

namespace lightsieve {

NodeType node_ramp_float();
NodeType node_ramp_rgb();

namespace {

TestNode ramp(std::int32_t interpolation) {
    TestNode node(node_ramp_float());
    // Not in order, as files have them.
    node.set_array<float>("position", {0.5F, 0, 1, 0.75F});
    node.set_array<float>("value", {4, 1, 2, 3});
    node.set_array<std::int32_t>("interpolation", std::vector<std::int32_t>(4, interpolation));
    return node;
}

float at(TestNode& node, float t) {
    node.set("input", t);
    return node.type().eval_value(node.block(), {}).rgb.r;
}

TEST(Ramp, KeysAreSortedAndEndsGoOn) {
    TestNode linear = ramp(1);
    EXPECT_FLOAT_EQ(at(linear, -1), 1);
    EXPECT_FLOAT_EQ(at(linear, 0.25F), 2.5F);
    EXPECT_FLOAT_EQ(at(linear, 0.5F), 4);
    EXPECT_FLOAT_EQ(at(linear, 0.625F), 3.5F);
    EXPECT_FLOAT_EQ(at(linear, 0.875F), 2.5F);
    EXPECT_FLOAT_EQ(at(linear, 3), 2);
    TestNode constant = ramp(0);
    EXPECT_FLOAT_EQ(at(constant, 0.49F), 1);
    EXPECT_FLOAT_EQ(at(constant, 0.74F), 4);
}

TEST(Ramp, CubicsPassTheKeysAndMonotoneOnesStayBetween) {
    TestNode catmull = ramp(2), monotone = ramp(3);
    float highest = 0;
    for (const float t : {0.0F, 0.5F, 0.75F, 1.0F}) {
        EXPECT_NEAR(at(catmull, t), at(monotone, t), 1e-5);
    }
    for (int i = 0; i <= 100; ++i) {
        const float t = static_cast<float>(i) / 100;
        highest = std::max(highest, at(catmull, t));
        EXPECT_LE(at(monotone, t), 4 + 1e-5F);
        EXPECT_GE(at(monotone, t), 1 - 1e-5F);
    }
    EXPECT_GT(highest, 4.001F);  // Catmull-Rom overshoots
}

TEST(Ramp, AStraightRowOfKeysIsALine) {
    TestNode node(node_ramp_float());
    node.set_array<float>("position", {0, 0.3F, 0.4F, 1});
    node.set_array<float>("value", {0, 0.6F, 0.8F, 2});
    for (const std::int32_t how : {1, 2, 3}) {
        node.set_array<std::int32_t>("interpolation", {how, how, how, how});
        for (const float t : {0.1F, 0.35F, 0.7F})
            EXPECT_NEAR(at(node, t), 2 * t, 1e-5) << how;
    }
}

TEST(Ramp, RunsAlongUvAndStrands) {
    TestNode node(node_ramp_rgb());
    node.set_array<Color>("color", {{0, 0, 0}, {1, 2, 4}});
    ShadePoint p;
    p.uv = {0.25F, 0.75F};
    const auto red = [&] { return node.type().eval_value(node.block(), p).rgb.r; };
    struct Row {
        std::int32_t type;
        float place;
    };
    for (const Row& row : {Row{1, 0.25F}, Row{2, 0.75F}, Row{3, 0.5F}, Row{6, 0.5F}, Row{5, 0.5F},
                           Row{7, 0.1875F}}) {
        node.set_enum("type", row.type);
        EXPECT_NEAR(red(), row.place, 1e-6) << row.type;
    }
    node.set_enum("type", 2);
    p.on_curve = true;
    p.curve_uv = {0.5F, 0.1F};
    EXPECT_NEAR(red(), 0.1F, 1e-6);
    node.set_enum("use_implicit_uvs", 0);
    EXPECT_NEAR(red(), 0.75F, 1e-6);
    p.uv.y = 2.25F;
    EXPECT_NEAR(red(), 1, 1e-6);
    node.set("wrap_uvs", true);
    EXPECT_NEAR(red(), 0.25F, 1e-6);
}

TEST(Ramp, WithoutKeysIsBlack) {
    TestNode node(node_ramp_rgb());
    EXPECT_EQ(node.type().eval_value(node.block(), {}).rgb, kBlack);
    TestNode one(node_ramp_float());
    one.set_array<float>("value", {3});
    EXPECT_EQ(at(one, 0.7F), 3);
}

}  // namespace
}  // namespace lightsieve
