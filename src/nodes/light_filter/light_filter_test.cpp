// Light filters: what they leave of a light, by place.
#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/common/node_test_support.h"
#include "scene/light_filter.h"

namespace lightsieve {
namespace {

/// A spot light at (0, 2, 0) that shines down, 90 degrees wide; its x axis is the world's.
LightPlace spot_above() {
    LightPlace out;
    out.world_from_light = Mat4f::look_at({0, 2, 0}, {0, 0, 0}, {0, 0, -1});
    out.light_from_world = out.world_from_light.inverse();
    out.cone_tangent = 1;
    return out;
}

class Filter {
  public:
    explicit Filter(const char* type) : node_(*builtin_registry().find(type)) {}
    TestNode* operator->() { return &node_; }
    /// What is left of white light at a point; the floor lies at y = 0.
    [[nodiscard]] Color at(Vec3f point, const LightPlace& place = spot_above()) {
        const auto filter = node_.type().make_light_filter(node_.block(), context_, place);
        if (!filter) return Color::grey(-1);
        const Vec3f lamp = place.world_from_light.point({});
        return filter->filtered(kWhite, lamp, point, length(point - lamp));
    }
    TestContext context_;

  private:
    TestNode node_;
};

TEST(LightDecay, FadesNearAndFar) {
    Filter decay("light_decay");
    EXPECT_EQ(decay.at({0, -50, 0}), kWhite);
    decay->set("use_far_atten", true).set("far_start", 2.0F).set("far_end", 4.0F);
    EXPECT_EQ(decay.at({0, 1, 0}), kWhite);
    EXPECT_NEAR(decay.at({0, -1, 0}).r, 0.5, 1e-5);
    EXPECT_EQ(decay.at({0, -3, 0}), kBlack);
    decay->set("use_near_atten", true).set("near_start", 0.5F).set("near_end", 1.5F);
    EXPECT_NEAR(decay.at({0, 1, 0}).r, 0.5, 1e-5);
    EXPECT_EQ(decay.at({0, 1.75F, 0}), kBlack);
}

TEST(Barndoor, FlapsCutTheBeam) {
    Filter doors("barndoor");
    EXPECT_EQ(doors.at({1.9F, 0, 0}), kWhite);
    EXPECT_EQ(doors.at({0, 3, 0}), kBlack) << "behind the lamp";
    // The beam is 4 wide on the floor: a quarter of it from the left is x = -1.
    doors->set("barndoor_left_top", 0.25F).set("barndoor_left_bottom", 0.25F);
    EXPECT_EQ(doors.at({-1.1F, 0, 0}), kBlack);
    EXPECT_EQ(doors.at({-0.9F, 0, 0}), kWhite);
    doors->set("barndoor_left_edge", 0.5F);
    EXPECT_NEAR(doors.at({0, 0, 0}).r, 0.5, 1e-5);
    // The top of the picture is -z here.
    doors->set("barndoor_left_top", 0.0F).set("barndoor_left_bottom", 0.0F);
    doors->set("barndoor_top_left", 0.25F).set("barndoor_top_right", 0.25F);
    EXPECT_EQ(doors.at({0, 0, -1.1F}), kBlack);
    EXPECT_EQ(doors.at({0, 0, 1.1F}), kWhite);
    LightPlace no_cone = spot_above();
    no_cone.cone_tangent = 0;
    EXPECT_EQ(doors.at({}, no_cone), Color::grey(-1));
    EXPECT_EQ(doors.context_.count(Code::InvalidValue), 1U);
}

TEST(Gobo, ShowsItsSlide) {
    Filter gobo("gobo");
    EXPECT_EQ(gobo.at({1, 0, 1}), kWhite) << "the test's slide is white";
    gobo->set("density", 0.75F);
    EXPECT_NEAR(gobo.at({1, 0, 1}).r, 0.25, 1e-6);
    gobo->set_enum("filter_mode", 2);
    EXPECT_NEAR(gobo.at({1, 0, 1}).r, 1.25, 1e-6);
    gobo->set_enum("filter_mode", 3);
    EXPECT_NEAR(gobo.at({1, 0, 1}).r, 0.75, 1e-6);
    gobo->set_enum("filter_mode", 0).set("sscale", 2.0F).set_enum("swrap", 1);
    EXPECT_EQ(gobo.at({1.5F, 0, 0}), kBlack) << "beside the slide";
}

TEST(LightBlocker, KeepsLightAway) {
    Filter blocker("light_blocker");
    EXPECT_EQ(blocker.at({}), kWhite) << "density 0";
    // The test's colour input is white: blocked light keeps its colour, so look at what remains of it through `shader`.
    blocker->set("density", 1.0F).set("geometry_matrix", Mat4f::scale({0, 1, 1}));
    EXPECT_EQ(blocker.at({}), Color::grey(-1)) << "a flat matrix";
    EXPECT_EQ(blocker.context_.count(Code::InvalidValue), 1U);
}

}  // namespace
}  // namespace lightsieve
