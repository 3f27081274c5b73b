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
    EXPECT_FALSE(inside.hides(&kWater, water));
    inside.enter(&kGlass, glass);
    EXPECT_TRUE(inside.hides(&kWater, water)) << "water reaches into the glass";
    inside.enter(&kWater, water);
    EXPECT_EQ(inside.here()->ior, 1.5F);
    EXPECT_EQ(inside.around(&kGlass, 2)->ior, 1.33F) << "the glass borders on the water";
    EXPECT_FALSE(inside.hides(&kGlass, glass));
    inside.leave(&kGlass);
    EXPECT_EQ(inside.here()->ior, 1.33F);
    EXPECT_FALSE(inside.hides(&kWater, water));
    EXPECT_FALSE(inside.hides(&kGlass, glass)) << "glass wins from the other side as well";
}

TEST(Interiors, EqualsKnowNothingOfOneAnother) {
    const Interior water = body(1.33F, 0), ice = body(1.31F, 0), glass = body(1.5F, -1);
    Interiors inside;
    inside.enter(&kWater, water);
    EXPECT_FALSE(inside.hides(&kIce, ice));
    EXPECT_EQ(inside.around(&kIce, 0), nullptr);
    inside.enter(&kIce, ice);
    EXPECT_EQ(inside.here()->ior, 1.31F) << "the last one absorbs";
    EXPECT_FALSE(inside.hides(&kWater, water));
    EXPECT_TRUE(inside.hides(&kGlass, glass));
    inside.leave(&kIce);
    EXPECT_EQ(inside.here()->ior, 1.33F);
    inside.leave(&kGlass);  // was never entered
    EXPECT_EQ(inside.here()->ior, 1.33F);
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
