// exit_to_background: past a depth limit a ray takes the background in place of whatever it would meet.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

const Color kHaze(0.5F, 1, 2);

/// A floor under a lid that hides the background, seen from below the lid.
std::string under_a_lid(const std::string& shader, const std::string& options = "") {
    return frame_text(8, 8, 2, from_above(1, 1), " background haze\n" + options) +
           node("flat", "haze", " color 0.5 1 2") +
           node("standard_surface", "ground", " base 1\n base_color 0.5 0.5 0.5\n" + shader) +
           floor("plane", 0, 3, "ground") + lambert("black", 0) + floor("lid", 2, 1e5F, "black");
}

TEST(ExitToBackground, StandsInForWhatARayPastItsLimitWouldMeet) {
    const Picture picture = render(under_a_lid(" specular 0\n exit_to_background on"),
                                   in_memory({"diffuse_indirect", "background"}));
    EXPECT_TRUE(check_constant(picture, "RGBA", kHaze * 0.5F, 1e-5));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "diffuse_indirect"))
        << "the event is C RD B";
    EXPECT_TRUE(check_black(picture, "background"));
}

TEST(ExitToBackground, IsOffUnlessTheShaderSaysSo) {
    EXPECT_TRUE(check_black(render(under_a_lid(" specular 0")), "RGBA"));
}

TEST(ExitToBackground, WaitsForTheLimit) {
    // One bounce is allowed: the ray meets the lid, which reflects nothing.
    EXPECT_TRUE(check_black(
        render(under_a_lid(" specular 0\n exit_to_background on", " GI_diffuse_depth 1")),
        "RGBA"));
}

TEST(ExitToBackground, IsAMatterOfTheShaderThatTheRayLeft) {
    // Left half of the floor with, right half without.
    const std::string halves =
        frame_text(8, 8, 2, from_above(1), " background haze") +
        node("flat", "haze", " color 0.5 1 2") +
        node("standard_surface", "exits",
             " specular 0\n base 1\n base_color 1 1 1\n exit_to_background on") +
        node("standard_surface", "ends", " specular 0\n base 1\n base_color 1 1 1") +
        quad("left", {-2, 0, -2}, {-2, 0, 2}, {0, 0, 2}, {0, 0, -2}, "exits") +
        quad("right", {0, 0, -2}, {0, 0, 2}, {2, 0, 2}, {2, 0, -2}, "ends");
    const Picture picture = render(halves);
    for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
        const float green = picture.color("RGBA", i).g;
        if (i % 8 < 4) {
            EXPECT_NEAR(green, 1, 1e-5) << "pixel " << i;
        } else {
            EXPECT_EQ(green, 0) << "pixel " << i;
        }
    }
}

TEST(ExitToBackground, HoldsForMirrors) {
    // The outer colour of a metal seen from straight above is that of its base.
    const std::string mirror =
        " exit_to_background on\n metalness 1\n specular 1\n specular_color 1 1 1\n "
        "specular_roughness 0";
    const Picture picture = render(under_a_lid(mirror), in_memory({"specular_indirect"}));
    EXPECT_TRUE(check_constant(picture, "specular_indirect", kHaze * 0.5F, 1e-2));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "specular_indirect"));
    EXPECT_TRUE(check_black(render(under_a_lid(mirror, " GI_specular_depth 1")), "RGBA"))
        << "within the limit the mirror shows the lid";
}

TEST(ExitToBackground, ObeysTheVisibilityOfTheBackground) {
    // Camera rays only.
    const Picture picture =
        render(under_a_lid(" specular 0\n exit_to_background on", " background_visibility 1"));
    EXPECT_TRUE(check_black(picture, "RGBA"));
}

}  // namespace
}  // namespace lightsieve::testing
