// Shapes that Embree does not know, and particles: seen, in shadow, moved, instanced, filled.
#include <gtest/gtest.h>

#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

const std::string kSun = node("distant_light", "sun", " direction 0 -1 0\n intensity 3");
const std::string kGlow = node("flat", "glow", " color 1 1 1");

/// A picture from the side, -z onto the xy plane, 4 x 4 units of it.
std::string from_the_side(int pixels, int aa_samples) {
    return frame_text(pixels, pixels, aa_samples, ortho_camera({0, 0, 10}, {0, 0, 0}, 4));
}

TEST(SimpleShapesRender, CylindersHaveTheirSilhouetteAndNormals) {
    const Picture picture =
        render(from_the_side(32, 2) + kGlow +
                   node("cylinder", "c", " bottom 0 -1 0\n top 0 1 0\n radius 1\n shader glow"),
               in_memory({"N VECTOR", "Z FLOAT"}));
    EXPECT_NEAR(picture.mean_alpha("RGBA"), 4.0 / 16, 0.01);
    // A row through the middle: z = sqrt(1 - x^2).
    for (std::size_t x = 9; x < 23; ++x) {
        const std::size_t pixel = 16 * 32 + x;
        const float at = (static_cast<float>(x) + 0.5F) / 8 - 2, z = std::sqrt(1 - at * at);
        EXPECT_NEAR(picture.color("N", pixel).r, at, 0.05F);
        EXPECT_NEAR(picture.color("N", pixel).g, 0, 1e-6F);
        EXPECT_NEAR(picture.color("Z", pixel).r, 10 - z, 0.06F);
    }
}

TEST(SimpleShapesRender, ConesAndDisksCoverTheirArea) {
    const std::string cone =
        node("cone", "c", " bottom 0 -1 0\n top 0 1 0\n bottom_radius 1\n shader glow");
    EXPECT_NEAR(render(from_the_side(64, 2) + kGlow + cone).mean_alpha("RGBA"), 2.0 / 16, 2e-3);
    const std::string ring =
        node("disk", "round", " normal 0 0 2\n radius 1\n hole 0.5\n shader glow");
    EXPECT_NEAR(render(from_the_side(64, 2) + kGlow + ring).mean_alpha("RGBA"),
                static_cast<double>(kPi) * 0.75 / 16, 2e-3);
    // Its back is seen too, unless sidedness forbids it.
    const std::string back = node("disk", "round", " normal 0 0 -1\n radius 1\n shader glow\n");
    EXPECT_GT(render(from_the_side(8, 2) + kGlow + back).mean_alpha("RGBA"), 0.1);
    const std::string one_sided =
        node("disk", "round", " normal 0 0 -1\n radius 1\n shader glow\n sidedness 0");
    EXPECT_EQ(render(from_the_side(8, 2) + kGlow + one_sided).mean_alpha("RGBA"), 0);
}

TEST(SimpleShapesRender, PlanesHaveNoEnd) {
    // A horizon: all rays that go down meet the plane, however flat.
    const Picture picture =
        render(frame_text(8, 64, 2, persp_camera({0, 1, 0}, {0, 1, -1}, 5)) +
                   lambert("grey", 0.5F) + kSun + node("plane", "ground", " shader grey"),
               in_memory({"N VECTOR"}));
    EXPECT_NEAR(picture.mean_alpha("RGBA"), 0.5, 1e-3);
    const std::size_t bottom = 63 * 8;
    EXPECT_NEAR(picture.color("RGBA", bottom).r, 1.5F * kInvPi, 1e-4F);
    EXPECT_NEAR(picture.color("N", bottom).g, 1, 1e-4F);
    // Far away, too: 23 units and more from the camera a pixel of the far half.
    EXPECT_NEAR(picture.color("RGBA", 33 * 8).r, 1.5F * kInvPi, 1e-4F);
}

TEST(SimpleShapesRender, ShadowsAndLightFromTheOpenEnd) {
    // A floor under a cylinder that stands around it, lit from above: the sun comes in through the open top.
    const std::string scene =
        frame_text(4, 4, 2, ortho_camera({0, 5, 0}, {0, 0, 0}, 0.1F, {0, 0, -1})) +
        lambert("grey", 0.5F) + kSun + floor("ground", 0, 2, "grey");
    const std::string tube = node("cylinder", "tube", " top 0 1 0\n radius 0.5\n shader grey");
    const std::string lid = node("disk", "lid", " center 0 1 0\n radius 0.5\n shader grey");
    EXPECT_TRUE(check_constant(render(scene + tube), "RGBA", Color::grey(1.5F * kInvPi), 1e-5));
    const std::string below =
        frame_text(4, 4, 2, ortho_camera({0, 0.5F, 0}, {0, 0, 0}, 0.1F, {0, 0, -1})) +
        lambert("grey", 0.5F) + kSun + floor("ground", 0, 2, "grey");
    EXPECT_TRUE(check_black(render(below + tube + lid), "RGBA"));
}

TEST(SimpleShapesRender, MatricesMoveThemAndInstancesRepeatThem) {
    // A squashed cylinder equals one that is thinner; so does its instance.
    const std::string head = from_the_side(24, 2) + lambert("grey", 0.5F) +
                             node("distant_light", "key", " direction -0.5 -0.3 -1\n intensity 2");
    const std::string squash = " matrix 0.5 0 0 0  0 0.5 0 0  0 0 0.5 0  0.25 0.5 0 1";
    const Picture a = render(head + node("cylinder", "c", " shader grey\n radius 1" + squash));
    const Picture b =
        render(head + node("cylinder", "c",
                           " shader grey\n radius 0.5\n bottom 0.25 0.5 0\n top 0.25 1 0"));
    const Picture c =
        render(head + node("cylinder", "c", " shader grey\n radius 1\n visibility 0") +
               node("ginstance", "i", " node c\n visibility 255" + squash));
    EXPECT_GT(a.mean_alpha("RGBA"), 0.02);
    EXPECT_TRUE(check_equal(a, "RGBA", b, "RGBA", 1e-3));
    EXPECT_TRUE(check_equal(a, "RGBA", c, "RGBA", 1e-6));
}

TEST(SimpleShapesRender, MotionBlursThem) {
    const std::string camera =
        node("ortho_camera", "cam",
             " position 0 2 0\n look_at 0 0 0\n up 0 0 -1\n screen_window_min -2 -2\n "
             "screen_window_max 2 2\n shutter_start 0\n shutter_end 1");
    const std::string disk =
        node("disk", "round",
             " shader glow\n radius 0.5\n matrix 1 2 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 -1 0 0 1  1 0 "
             "0 0 0 1 0 0 0 0 1 0 1 0 0 1");
    const Picture picture = render(frame_text(16, 16, 8, camera) + kGlow + disk);
    // What it covers does not change while it moves; where its middle passes it is for chord / way of the time.
    EXPECT_NEAR(picture.mean_alpha("RGBA"), static_cast<double>(kPi) / 4 / 16, 5e-3);
    EXPECT_NEAR(picture.color("RGBA", 7 * 16 + 7).r, 0.5F, 0.08F);
}

TEST(SimpleShapesRender, ABoxOfGlassIsClosed) {
    const std::string head =
        frame_text(16, 16, 4, persp_camera({2, 1.5F, 3}, {0, 0, 0}, 40),
                   " GI_transmission_depth 8\n GI_specular_depth 2") +
        node("standard_surface", "glass", " base 0\n transmission 1\n specular_IOR 1.4\n") +
        node("skydome_light", "sky", " intensity 1");
    const Picture picture = render(head + node("box", "b", " shader glass"));
    // In a white furnace glass is white.
    EXPECT_TRUE(check_mean(picture, "RGBA", kWhite, 0.02));
}

TEST(Points, SpheresEqualSphereNodes) {
    const std::string head = frame_text(24, 24, 2, persp_camera({0, 1, 4}, {0, 0, 0}, 45)) +
                             lambert("grey", 0.5F) + kSun;
    const Picture a =
        render(head + node("points", "p",
                           " points 2 1 VECTOR -0.5 0 0  0.6 0.2 0.3\n radius 2 1 FLOAT 0.3 "
                           "0.4\n mode sphere\n shader grey"));
    const Picture b = render(head + sphere("a", {-0.5F, 0, 0}, 0.3F, "grey") +
                             sphere("b", {0.6F, 0.2F, 0.3F}, 0.4F, "grey"));
    EXPECT_TRUE(check_equal(a, "RGBA", b, "RGBA", 1e-4));
}

TEST(Points, DisksAndQuadsFaceTheCamera) {
    for (const Vec3f eye : {Vec3f{0, 0, 10}, Vec3f{10, 0, 0}, Vec3f{6, 5, 6}}) {
        const std::string head = frame_text(64, 64, 2, ortho_camera(eye, {0, 0, 0}, 4)) + kGlow;
        const Picture disk =
            render(head + node("points", "p", " points 0 0 0\n radius 1\n shader glow"),
                   in_memory({"N VECTOR"}));
        EXPECT_NEAR(disk.mean_alpha("RGBA"), static_cast<double>(kPi) / 16, 4e-3);
        const Vec3f n = normalize(eye);
        EXPECT_NEAR(disk.color("N", 32 * 64 + 32).r, n.x, 1e-4F);
        EXPECT_NEAR(disk.color("N", 32 * 64 + 32).g, n.y, 1e-4F);
        const Picture quad =
            render(head + node("points", "p",
                               " points 0 0 0\n radius 1\n aspect 2\n mode quad\n shader glow"));
        EXPECT_NEAR(quad.mean_alpha("RGBA"), 2.0 / 16, 4e-3);
        // Upright, twice as wide as high: left of the middle it is seen, above it is not.
        EXPECT_EQ(quad.alpha("RGBA", 32 * 64 + 18), 1);
        EXPECT_EQ(quad.alpha("RGBA", 18 * 64 + 32), 0);
    }
}

TEST(Points, FlatOnesAreLitAndCastShadows) {
    const std::string head =
        frame_text(4, 4, 2, ortho_camera({0, 5, 0}, {0, 0, 0}, 0.1F, {0, 0, -1})) +
        lambert("grey", 0.5F) + kSun;
    for (const char* mode : {"disk", "quad", "sphere"}) {
        const std::string point = node(
            "points", "p", std::string(" points 0 1 0\n radius 0.5\n shader grey\n mode ") + mode);
        EXPECT_TRUE(check_mean(render(head + point), "RGBA", Color::grey(1.5F * kInvPi), 0.02))
            << mode;
        const std::string shadow =
            frame_text(4, 4, 2, ortho_camera({0, 0.3F, 0}, {0, 0, 0}, 0.1F, {0, 0, -1})) +
            lambert("grey", 0.5F) + kSun + floor("ground", 0, 2, "grey") + point;
        EXPECT_TRUE(check_black(render(shadow), "RGBA")) << mode;
    }
}

TEST(Points, UserDataStayWithTheirPoint) {
    // The first point has no radius and is left out: the second keeps its own colour.
    const std::string head = frame_text(2, 2, 2, ortho_camera({0, 0, 5}, {0, 0, 0}, 0.2F)) +
                             node("flat", "paint", " color look") +
                             node("user_data_rgb", "look", " attribute tint");
    for (const char* mode : {"disk", "quad", "sphere"}) {
        const std::string point = node(
            "points", "p",
            std::string(" points 2 1 VECTOR 0 0 2  0 0 0\n radius 2 1 FLOAT 0 0.5\n shader paint\n"
                        " declare tint uniform RGB\n tint 2 1 RGB 1 0 0  0 0.25 1\n mode ") +
                mode);
        EXPECT_TRUE(check_constant(render(TestScene(head + point, in_memory(), {"left out"})),
                                   "RGBA", {0, 0.25F, 1}, 1e-6))
            << mode;
    }
}

TEST(Points, MoveWithinTheShutter) {
    const std::string camera = node("ortho_camera", "cam",
                                    " position 0 0 10\n look_at 0 0 0\n screen_window_min -2 -2\n "
                                    "screen_window_max 2 2\n shutter_start 0\n shutter_end 1");
    for (const char* mode : {"disk", "quad", "sphere"}) {
        const Picture picture =
            render(frame_text(16, 16, 8, camera) + kGlow +
                   node("points", "p",
                        std::string(" points 1 2 VECTOR -1 0 0  1 0 0\n radius 0.5\n shader "
                                    "glow\n mode ") +
                            mode));
        const double area = mode[0] == 'q' ? 1 : static_cast<double>(kPi) / 4;
        EXPECT_NEAR(picture.mean_alpha("RGBA"), area / 16, 6e-3) << mode;
        EXPECT_NEAR(picture.color("RGBA", 7 * 16 + 7).r, 0.5F, 0.08F) << mode;
    }
}

}  // namespace
}  // namespace lightsieve::testing
