#include "render/interiors.h"

#include <gtest/gtest.h>

namespace lightsieve {
namespace {

const char kGlass = 0, kWater = 0, kIce = 0;

Interior body(float ior, int priority) {
    return {{Color::grey(ior), {}, {}, nullptr}, ior, priority, true};
}

TEST(Interiors, HigherPriorityIsThere) {
    const Interior glass = body(1.5F, 2), water = body(1.33F, 1);
    Interiors inside;
    EXPECT_EQ(inside.here(), nullptr);
    EXPECT_FALSE(inside.hides(&kWater, water, true));
    inside.enter(&kGlass, glass);
    EXPECT_TRUE(inside.hides(&kWater, water, true)) << "water reaches into the glass";
    inside.enter(&kWater, water);
    EXPECT_EQ(inside.here()->ior, 1.5F);
    EXPECT_EQ(inside.around(&kGlass)->ior, 1.33F) << "the glass borders on the water";
    EXPECT_FALSE(inside.hides(&kGlass, glass, false));
    inside.leave(&kGlass);
    EXPECT_EQ(inside.here()->ior, 1.33F);
    EXPECT_FALSE(inside.hides(&kWater, water, false));
    EXPECT_FALSE(inside.hides(&kGlass, glass, true)) << "glass wins from the other side as well";
}

TEST(Interiors, OfEqualsTheLastIsThere) {
    const Interior water = body(1.33F, 0), ice = body(1.31F, 0);
    Interiors inside;
    inside.enter(&kWater, water);
    EXPECT_FALSE(inside.hides(&kIce, ice, true));
    inside.enter(&kIce, ice);
    EXPECT_EQ(inside.here()->ior, 1.31F);
    EXPECT_TRUE(inside.hides(&kWater, water, false));
    EXPECT_FALSE(inside.hides(&kIce, ice, false));
    inside.leave(&kIce);
    EXPECT_EQ(inside.here()->ior, 1.33F);
}

TEST(Interiors, ABodyThatThePathBeganInIsTheFirst) {
    Interiors inside;
    inside.enter(&kIce, body(1.31F, 0));
    EXPECT_TRUE(inside.hides(&kWater, body(1.33F, 0), false));
    EXPECT_FALSE(inside.hides(&kWater, body(1.33F, 1), false));
    inside.leave(&kWater);  // was never entered
    EXPECT_EQ(inside.here()->ior, 1.31F);
}

TEST(Interiors, MoreThanFitAreForgotten) {
    Interiors inside;
    for (int i = 0; i < 20; ++i)
        inside.enter(&kGlass, body(1.5F, i));
    EXPECT_FALSE(inside.empty());
    for (int i = 0; i < 20; ++i)
        inside.leave(&kGlass);
    EXPECT_TRUE(inside.empty());
}

}  // namespace
}  // namespace lightsieve
