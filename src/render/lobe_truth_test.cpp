// Each lobe's light in its AOV, against integration of the lobe alone; see render/testing/lobe_checks.h.
#include <gtest/gtest.h>

#include "render/testing/lobe_checks.h"

namespace lightsieve::testing {
namespace {

TEST(LobeTruth, UnderAQuadLight) { EXPECT_TRUE(check_lobes_under_a_quad()); }
TEST(LobeTruth, UnderADome) { EXPECT_TRUE(check_lobes_under_a_dome()); }
TEST(LobeTruth, OnBothSides) { EXPECT_TRUE(check_lobes_on_both_sides()); }
TEST(LobeTruth, ThroughOneBounce) { EXPECT_TRUE(check_lobes_through_one_bounce()); }
TEST(LobeTruth, DepthLimitsByLobe) { EXPECT_TRUE(check_depth_limits_by_lobe()); }
TEST(LobeTruth, MasksByLobe) { EXPECT_TRUE(check_masks_by_lobe()); }
TEST(LobeTruth, MultipliersByLobe) { EXPECT_TRUE(check_multipliers_by_lobe()); }
TEST(LobeTruth, SingleLobes) { EXPECT_TRUE(check_single_lobes()); }
TEST(LobeTruth, DirectLightIsDirect) { EXPECT_TRUE(check_direct_light_is_direct()); }

/// A floor of metal and diffuse layers before a wall, and only the floor in the picture.
std::string half_metal(std::string_view metalness, std::string_view light) {
    return frame_text(24, 24, 4, ortho_camera({0, 1.8F, 0.6F}, {0, 0, 0.1F}, 1.2F),
                      " GI_diffuse_depth 1\n GI_specular_depth 1\n GI_total_depth 1") +
           node("standard_surface", "mix",
                " specular 0\n base_color 0.7 0.5 0.3\n specular_roughness 0.4\n caustics on\n "
                "metalness " +
                    std::string(metalness)) +
           node("lambert", "wall", " Kd 0.6\n Kd_color 0.5 0.8 1") + floor("plane", 0, 1, "mix") +
           quad("back", {-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, "wall") +
           node("quad_light", "key",
                " vertices 4 1 VECTOR -0.5 1.9 -0.5  0.5 1.9 -0.5  0.5 1.9 0.5  -0.5 1.9 0.5\n "
                "color " +
                    std::string(light)) +
           node("skydome_light", "sky", " camera 0\n color " + std::string(light));
}

TEST(LobeTruth, AMixHasTheLightOfItsPartsAlone) {
    // metalness mixes whole layers: half the metal and half the diffuse base. Rendered alone under half the light, each is
    // what its AOV of the mix must be, directly and through one bounce. 4 comparisons of 3 channels: a false alarm in 12000 seeds.
    const std::vector<std::string> aovs{"diffuse_direct", "diffuse_indirect", "specular_direct",
                                        "specular_indirect"};
    const Picture mixed = render(half_metal("0.5", "2 2 2"), in_memory(aovs));
    const Picture diffuse = render(half_metal("0", "1 1 1"), in_memory(aovs)),
                  metal = render(half_metal("1", "1 1 1"), in_memory(aovs));
    for (const char* aov : {"diffuse_direct", "diffuse_indirect"}) {
        EXPECT_TRUE(check_lit(diffuse, aov));
        EXPECT_TRUE(check_same_mean(mixed, aov, diffuse, aov));
        EXPECT_TRUE(check_black(metal, aov));
    }
    for (const char* aov : {"specular_direct", "specular_indirect"}) {
        EXPECT_TRUE(check_lit(metal, aov));
        EXPECT_TRUE(check_same_mean(mixed, aov, metal, aov));
        EXPECT_TRUE(check_black(diffuse, aov));
    }
}

}  // namespace
}  // namespace lightsieve::testing
