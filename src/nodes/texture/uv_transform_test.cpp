// uv_transform: where its input is asked, against coordinates worked out by hand.
#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/common/node_test_support.h"
#include "nodes/texture/perlin.h"

namespace lightsieve {
namespace {

/// The node with an input that shows the coordinates and the footprint it is asked for.
class Uv {
  public:
    Uv() : node_(*builtin_registry().find("uv_transform")) {
        const ParamInfo* input = node_.type().find("passthrough");
        LazyLink link;
        link.links = this;
        link.apply = [](const void*, void* value, const ShadePoint& at) {
            const Rgba seen{{at.uv.x, at.uv.y, at.uv_width}, 1};
            std::memcpy(value, &seen, sizeof(seen));
        };
        std::memcpy(static_cast<std::byte*>(node_.block()) + input->lazy_offset, &link,
                    sizeof(link));
    }
    TestNode* operator->() { return &node_; }
    [[nodiscard]] Rgba at(float u, float v) const {
        ShadePoint point;
        point.uv = {u, v};
        point.uv_width = 0.01F;
        return node_.type().eval_value(node_.block(), point);
    }

  private:
    TestNode node_;
};

void expect_uv(const Rgba& is, float u, float v) {
    EXPECT_EQ(is.a, 1);
    EXPECT_NEAR(is.rgb.r, u, 1e-5);
    EXPECT_NEAR(is.rgb.g, v, 1e-5);
}

TEST(UvTransform, LeavesCoordinatesAsTheyAre) {
    const Uv uv;
    expect_uv(uv.at(0.3F, 2.7F), 0.3F, 2.7F);
    EXPECT_NEAR(uv.at(0.3F, 0.7F).rgb.b, 0.01, 1e-7);
}

TEST(UvTransform, TurnsTheFrameThenMovesIt) {
    Uv uv;
    uv->set("rotate_frame", 90.0F).set("translate_frame", Vec2f{0.25F, 0});
    // (0.7, 0.5) about the middle by 90 degrees is (0.5, 0.7).
    expect_uv(uv.at(0.7F, 0.5F), 0.25F, 0.7F);
    uv->set("rotate_frame", 0.25F).set_enum("unit", 2);
    expect_uv(uv.at(0.7F, 0.5F), 0.25F, 0.7F);
}

TEST(UvTransform, CoverageLeavesGapsOrEnlarges) {
    Uv uv;
    uv->set("coverage", Vec2f{0.5F, 1}).set("wrap_frame_color", Rgba{{0.1F, 0.2F, 0.3F}, 0.5F});
    expect_uv(uv.at(1.25F, 0.5F), 0.5F, 0.5F);
    EXPECT_EQ(uv.at(1.75F, 0.5F).a, 0.5F) << "in the gap";
    uv->set("coverage", Vec2f{2, 1});
    expect_uv(uv.at(3, 0.5F), 1.5F, 0.5F);
    uv->set("coverage", Vec2f{0, 1});
    EXPECT_EQ(uv.at(0.5F, 0.5F).a, 0.5F);
}

TEST(UvTransform, Wraps) {
    Uv uv;
    uv->set("wrap_frame_color", Rgba{{0, 0, 0}, 0.5F});
    uv->set_enum("wrap_frame_u", 1);
    expect_uv(uv.at(-0.5F, 0.5F), 0, 0.5F);
    uv->set_enum("wrap_frame_u", 2).set("coverage", Vec2f{0.9F, 1});
    expect_uv(uv.at(1.55F, 0.5F), 0.5F, 0.5F);
    uv->set_enum("wrap_frame_u", 3);
    EXPECT_EQ(uv.at(1.5F, 0.5F).a, 0.5F);
    uv->set_enum("wrap_frame_u", 4).set("coverage", Vec2f{0.5F, 1});
    expect_uv(uv.at(1.5F, 0.5F), 3, 0.5F);
}

TEST(UvTransform, RepeatsOffsetsStaggersMirrorsAndTurnsInThisOrder) {
    Uv uv;
    uv->set("repeat", Vec2f{2, 4}).set("offset", Vec2f{0.1F, 0.2F});
    expect_uv(uv.at(0.5F, 0.25F), 1.1F, 1.2F);
    EXPECT_NEAR(uv.at(0.5F, 0.25F).rgb.b, 0.01 * std::sqrt(8.0), 1e-6);
    uv->set("stagger", true);
    expect_uv(uv.at(0.5F, 0.25F), 1.6F, 1.2F);
    uv->set("mirror_u", true);
    expect_uv(uv.at(0.5F, 0.25F), 1.4F, 1.2F);
    uv->set("rotate", 180.0F);
    expect_uv(uv.at(0.5F, 0.25F), -0.4F, -0.2F);
    uv->set("flip_u", true).set("swap_uv", true);
    expect_uv(uv.at(0.5F, 0.25F), -0.2F, 1.4F);
    uv->set("mirror_v", true).set("flip_v", true).set("pivot", Vec2f{0, 0});
    // v: 1.2 mirrored is 1.8... 2 * 1 + 1 - 1.2; turned about the corner by half a turn.
    expect_uv(uv.at(0.5F, 0.25F), 1 + 1.8F, 1 + 1.4F);
}

TEST(UvTransform, NoiseMovesALittle) {
    Uv uv;
    uv->set("noise", Vec2f{0.1F, 0.1F});
    float largest = 0;
    for (int i = 0; i < 50; ++i) {
        const float u = 0.013F * static_cast<float>(i);
        largest = std::max(largest, std::abs(uv.at(u, 0.4F).rgb.r - u));
    }
    EXPECT_GT(largest, 0.01F);
    EXPECT_LE(largest, 0.1F);
}

TEST(PerlinNoise, HasItsRangeAndIsSmooth) {
    float low = 1, high = -1, jump = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3f p{0.0137F * static_cast<float>(i), 0.31F, -2.7F};
        const float v = perlin_noise(p), next = perlin_noise(p + Vec3f{0.001F, 0, 0});
        low = std::min(low, v);
        high = std::max(high, v);
        jump = std::max(jump, std::abs(next - v));
    }
    EXPECT_LT(low, -0.5F);
    EXPECT_GT(high, 0.5F);
    EXPECT_GE(low, -1);
    EXPECT_LE(high, 1);
    EXPECT_LT(jump, 0.005F);
    EXPECT_EQ(perlin_noise({3, -7, 12}), 0);
    EXPECT_NE(perlin_noise({0.3F, 0.4F, 0.5F}, 0.5F), perlin_noise({0.3F, 0.4F, 0.5F}, 1.5F));
    EXPECT_EQ(perlin_noise({kInfinity, 0, 0}), 0);
}

}  // namespace
}  // namespace lightsieve
