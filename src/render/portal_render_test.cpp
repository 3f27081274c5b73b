// A room with a window under a sky, with and without a portal in the window.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A floor under a large lid with a window of 1 x 1 in it.
std::string room(const std::string& more) {
    const auto pane = [](const char* name, float x0, float x1, float z0, float z1) {
        return quad(name, {x0, 1, z0}, {x1, 1, z0}, {x1, 1, z1}, {x0, 1, z1}, "dark");
    };
    return frame_text(16, 16, 4, from_above(0.2F), " GI_diffuse_depth 0\n GI_diffuse_samples 1") +
           lambert("grey", 0.5F) + lambert("dark", 0) + floor("ground", 0, 20, "grey") +
           pane("left", -20, -0.5F, -20, 20) + pane("right", 0.5F, 20, -20, 20) +
           pane("front", -0.5F, 0.5F, 0.5F, 20) + pane("back", -0.5F, 0.5F, -20, -0.5F) + more;
}
std::string sky(const char* mode) {
    return node("skydome_light", "sky", std::string(" portal_mode \"") + mode + "\"");
}
std::string window() {
    return square_light("window", 1, 0.5F, " portal on\n intensity 100\n camera 1");
}

TEST(PortalsInPictures, TheSameLightWithLessNoise) {
    const Picture plain = render(room(sky("interior_only"))),
                  interior = render(room(sky("interior_only") + window())),
                  exterior = render(room(sky("interior_exterior") + window())),
                  off = render(room(sky("off") + window()));
    for (const Picture* picture : {&interior, &exterior})
        EXPECT_TRUE(check_same_mean(plain, "RGBA", *picture, "RGBA"));
    EXPECT_TRUE(check_identical(plain, "RGBA", off, "RGBA"));
    const double noise = estimate(plain, "RGBA", 0).error;
    EXPECT_LT(estimate(interior, "RGBA", 0).error, 0.2 * noise);
    EXPECT_LT(estimate(exterior, "RGBA", 0).error, 0.85 * noise);
}

TEST(PortalsInPictures, WithoutASkyTheyAreReported) {
    const TestScene scene(room(window()), in_memory(), {"no skydome shines through portal"});
    EXPECT_EQ(scene.diagnostics().items().size(), 1U);
}

}  // namespace
}  // namespace lightsieve::testing
