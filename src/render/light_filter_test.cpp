// Lights behind filters, seen in pictures.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

std::string lit_floor(const std::string& light) {
    return frame_text(4, 4, 2, from_above(0.1F)) + lambert("grey", 1) +
           floor("ground", 0, 2, "grey") + light;
}

TEST(LightFilters, DecayActsOnPointsAndAreas) {
    const std::string decay =
        node("light_decay", "fade", " use_far_atten on\n far_start 1\n far_end 3");
    for (const char* radius : {"0", "0.1"}) {
        const auto lamp = [&](const std::string& filters) {
            return render(lit_floor(node("point_light", "lamp",
                                         std::string(" position 0 2 0\n intensity 10\n radius ") +
                                             radius + filters) +
                                    decay))
                .mean("RGBA");
        };
        // Half way between both distances.
        EXPECT_NEAR(lamp("\n filters \"fade\"").r / lamp("").r, 0.5, radius[1] == 0 ? 1e-3 : 0.06);
    }
}

TEST(LightFilters, BlockersTakeLightFromARegion) {
    const auto lamp = [&](const std::string& blocker) {
        return render(lit_floor(node("point_light", "lamp",
                                     " position 0 2 0\n intensity 10\n filters \"block\"") +
                                node("light_blocker", "block", blocker)))
            .mean("RGBA");
    };
    const Color free = lamp("");
    EXPECT_GT(free.r, 0.1F);
    EXPECT_EQ(lamp(" density 1"), kBlack) << "the floor lies in the box";
    EXPECT_NEAR(lamp(" density 0.25").r / free.r, 0.75, 1e-5);
    EXPECT_NEAR(lamp(" density 1\n shader 1 0.5 0").g / free.g, 0.5, 1e-5);
    const std::string aside = " density 1\n geometry_matrix 1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1";
    EXPECT_EQ(lamp(aside), free);
    // A square across the light's way.
    EXPECT_EQ(
        lamp(" density 1\n geometry_type \"plane\"\n geometry_matrix 1 0 0 0 0 0 1 0 0 -1 0 0 "
             "0 1 0 1"),
        kBlack);
}

TEST(LightFilters, WhatIsNoFilterIsSaid) {
    const TestScene scene(lit_floor(node("point_light", "lamp", " filters \"grey\"")), in_memory(),
                          {"not a light filter"});
    EXPECT_EQ(scene.diagnostics().items().size(), 1U);
}

}  // namespace
}  // namespace lightsieve::testing
