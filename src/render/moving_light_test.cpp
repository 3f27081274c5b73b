// Lights that move while the shutter is open.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A white floor seen at the origin under a lamp of intensity pi that moves from x = -2 to 2 at height 2.
std::string scene(std::string_view shutter, std::string_view light, std::string_view type) {
    return frame_text(8, 8, 4,
                      node("ortho_camera", "cam",
                           " position 0 1 0\n look_at 0 0 0\n up 0 0 1\n screen_window_min -0.001 "
                           "-0.001\n screen_window_max 0.001 0.001\n" +
                               std::string(shutter))) +
           lambert("white", 1) + floor("ground", 0, 1, "white") +
           node(type, "lamp",
                " intensity 3.14159265\n matrix 1 2 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 -2 2 0 1  1 0 "
                "0 0 0 1 0 0 0 0 1 0 2 2 0 1\n motion_start 0\n motion_end 1\n" +
                    std::string(light));
}

TEST(MovingLights, BringTheMeanOfTheirWay) {
    const std::string open = " shutter_start 0\n shutter_end 1";
    // E = I h / r^3; its mean over the way is (h / 4) [x / (h^2 r)] from -2 to 2 = 0.17678 I.
    EXPECT_TRUE(
        check_mean(render(scene(open, "", "point_light")), "RGBA", Color::grey(0.176777F), 2e-3));
    // Half of the shutter: half of the way, from x = -2 to 0.
    EXPECT_TRUE(check_mean(render(scene(" shutter_start 0\n shutter_end 0.5", "", "point_light")),
                           "RGBA", Color::grey(0.176777F), 2e-3));
    // An instant: where the light is then.
    EXPECT_TRUE(
        check_constant(render(scene(" shutter_start 0.5\n shutter_end 0.5", "", "point_light")),
                       "RGBA", Color::grey(0.25F), 1e-4));
    // The same by the option: nothing is blurred, and nothing to warn of where the light is seen.
    std::string sharp = scene(open, "camera 1", "point_light");
    sharp.insert(sharp.find("options") + 9, " ignore_motion_blur on\n reference_time 0.5\n");
    EXPECT_TRUE(check_constant(render(sharp), "RGBA", Color::grey(0.25F), 1e-4));
    // A ball of light is as bright as a point.
    EXPECT_TRUE(check_mean(render(scene(open, " radius 0.2", "point_light")), "RGBA",
                           Color::grey(0.176777F), 0.01));
}

TEST(MovingLights, KeepTheirGroupAndMultipliers) {
    const Picture picture = render(
        scene(" shutter_start 0\n shutter_end 1", " aov \"key\"\n diffuse 0.5", "point_light"),
        in_memory({"diffuse_key"}));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "diffuse_key"));
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(0.5F * 0.176777F), 2e-3));
}

TEST(MovingLights, ThatAreSeenStandStill) {
    const TestScene still(
        scene(" shutter_start 0\n shutter_end 1", " radius 0.1\n camera 1", "point_light"),
        in_memory(), {"moves and is seen"});
    EXPECT_EQ(still.diagnostics().items().size(), 1U);
    EXPECT_EQ(still.scene().lights.size(), 1U);
    EXPECT_TRUE(check_mean(render(still), "RGBA", Color::grey(0.25F), 0.01));
}

}  // namespace
}  // namespace lightsieve::testing
