// Layers about the render itself: what clamps took away, rays, time, densities; and Pref.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A corner in bright light: direct and indirect light, both above the clamps that tests set.
std::string corner(const std::string& options) {
    return frame_text(6, 6, 3, persp_camera({0, 1.5F, 3}, {0, 0.5F, 0}, 60),
                      " GI_diffuse_depth 2\n" + options) +
           lambert("grey", 0.8F) + floor("ground", 0, 3, "grey") +
           quad("back", {-3, 0, -1}, {3, 0, -1}, {3, 3, -1}, {-3, 3, -1}, "grey") +
           square_light("lamp", 2.5F, 0.3F, " intensity 60");
}
const std::vector<const char*> kClamps{"RGBA RGBA f d",  "clamp_loss RGB f d", "unclamped RGB f d",
                                       "direct RGB f d", "indirect RGB f d",   "emission RGB f d"};

TEST(ClampLoss, AndTheBeautyAreWhatThereWas) {
    for (const char* clamps : {" AA_sample_clamp 0.4\n", " indirect_sample_clamp 0.05\n",
                               " AA_sample_clamp 0.4\n indirect_sample_clamp 0.05\n"}) {
        const Picture picture = render(corner(outputs(kClamps) + clamps));
        EXPECT_TRUE(check_lit(picture, "clamp_loss")) << clamps;
        EXPECT_TRUE(check_sum(picture, "unclamped", {"RGBA", "clamp_loss"})) << clamps;
        EXPECT_TRUE(check_sum(picture, "RGBA", {"direct", "indirect", "emission"})) << clamps;
        for (std::size_t i = 0; i < picture.n_pixels(); ++i)
            EXPECT_GE(picture.color("clamp_loss", i).g, 0);
    }
}

TEST(ClampLoss, IsBlackWithoutClamps) {
    const std::string open = " AA_sample_clamp 1e30\n indirect_sample_clamp 1e30\n";
    const Picture picture = render(corner(outputs(kClamps) + open));
    EXPECT_TRUE(check_black(picture, "clamp_loss"));
    EXPECT_TRUE(check_equal(picture, "unclamped", picture, "RGBA"));
    // Paths do not depend on clamps: what there was is the picture without them.
    const Picture clamped = render(corner(outputs(kClamps) + " AA_sample_clamp 0.4\n"));
    EXPECT_TRUE(check_equal(picture, "RGBA", clamped, "unclamped"));
}

TEST(ClampLoss, IsASumThatFilesClaim) {
    const TestScene scene(corner(outputs(kClamps)));
    const std::vector<std::string> sums =
        proved_partitions(scene.scene().plan, 0, scene.scene().events);
    EXPECT_NE(std::find(sums.begin(), sums.end(), "unclamped = RGBA + clamp_loss"), sums.end());
}

TEST(Costs, CountRaysAndSamplesOfThePixel) {
    const Picture picture =
        render(frame_text(2, 1, 3, from_above(2),
                          outputs({"RGBA RGBA f d", "raycount FLOAT f d",
                                   "AA_inv_density FLOAT f d", "cputime FLOAT f d"})) +
               node("flat", "red", " color 1 0 0") +
               quad("left", {-5, 0, -5}, {-5, 0, 5}, {0, 0, 5}, {0, 0, -5}, "red"));
    // A camera ray each of nine samples; nothing scatters.
    EXPECT_EQ(picture.color("raycount", 0).r, 9);
    EXPECT_EQ(picture.color("raycount", 1).r, 9);
    EXPECT_FLOAT_EQ(picture.color("AA_inv_density", 0).r, 1.0F / 9);
    EXPECT_GT(picture.color("cputime", 0).r, 0);
    EXPECT_EQ(picture.result().rays, 18U);
}

TEST(Pref, IsUserDataOrObjectSpace) {
    const std::string told =
        " matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0.5 0 1\n declare Pref varying VECTOR\n"
        " Pref 4 1 VECTOR 0 0 0 0 0 4 4 0 4 4 0 0";
    const std::vector<const char*> strings{"RGBA RGBA f d", "Pref VECTOR near d"};
    const auto scene = [&](const std::string& more) {
        return frame_text(1, 1, 1, from_above(0.01F), outputs(strings)) +
               node("closest_filter", "near", "") + lambert("grey", 0.5F) +
               quad("sheet", {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, "grey", more);
    };
    const Color pref = render(scene(told)).color("Pref", 0);
    EXPECT_NEAR(pref.r, 2, 0.02F);
    EXPECT_NEAR(pref.b, 2, 0.02F);
    const Color own = render(scene(" matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0.5 0 1")).color("Pref", 0);
    EXPECT_NEAR(own.g, 0, 1e-5F) << "not moved by the matrix";
}

}  // namespace
}  // namespace lightsieve::testing
