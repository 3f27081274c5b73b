// Where surfaces are: transforms, sides, shaders by face, instances, motion.
#include <gtest/gtest.h>

#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

// Shapes -------------------------------------------------------------------------------------------------------------------

TEST(Shapes, SquashedSphereHasTheNormalsOfAnEllipsoid) {
    // x^2 + (y / 0.5)^2 + z^2 = 1 at x = 0.6, z = 0: y = 0.4, gradient (0.6, 1.6, 0).
    const Picture picture = render(
        frame_text(4, 4, 2, ortho_camera({0.6F, 2, 0}, {0.6F, 0, 0}, 1e-3F, {0, 0, -1})) +
            lambert("grey", 0.5F) +
            node("distant_light", "sun", " direction 0 -1 0\n intensity 3") +
            sphere("ball", {0, 0, 0}, 1, "grey", " matrix 1 0 0 0  0 0.5 0 0  0 0 1 0  0 0 0 1"),
        in_memory({"N VECTOR", "Z FLOAT"}));
    const float len = std::sqrt(0.6F * 0.6F + 1.6F * 1.6F);
    EXPECT_NEAR(picture.color("N", 0).r, 0.6F / len, 2e-3F);
    EXPECT_NEAR(picture.color("N", 0).g, 1.6F / len, 2e-3F);
    EXPECT_NEAR(picture.color("Z", 0).r, 1.6F, 2e-3F);
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(3 * 0.5F * kInvPi * 1.6F / len), 2e-3));
}

TEST(Shapes, SidednessHidesBackFaces) {
    const std::string head = node("flat", "red", " color 1 0 0") +
                             node("flat", "blue", " color 0 0 1") + floor("ground", -1, 2, "blue");
    const std::string above = frame_text(4, 4, 2, from_above(1, 3)) + head;
    // Seen from above: a plane that faces up, then one that faces down.
    const auto facing_down = [](std::string_view more) {
        return quad("plane", {-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, "red", more);
    };
    EXPECT_TRUE(check_constant(render(above + floor("plane", 0, 1, "red", " sidedness 0")), "RGBA",
                               {1, 0, 0}, 1e-6));
    EXPECT_TRUE(check_constant(render(above + facing_down("")), "RGBA", {1, 0, 0}, 1e-6));
    EXPECT_TRUE(
        check_constant(render(above + facing_down(" sidedness 254")), "RGBA", {0, 0, 1}, 1e-6));
    EXPECT_TRUE(check_constant(render(above + facing_down(" sidedness 254\n invert_normals on")),
                               "RGBA", {1, 0, 0}, 1e-6));
    // Shadow rays go from the surface to the light: from below they meet the back of a plane that faces up.
    const std::string lit =
        frame_text(4, 4, 2, ortho_camera({0.3F, -0.5F, 0}, {0, -1, 0}, 0.01F)) +
        lambert("grey", 0.5F) + node("distant_light", "sun", " direction 0 -1 0\n intensity 3") +
        floor("base", -1, 2, "grey") + node("flat", "red", " color 0 0 0");
    EXPECT_TRUE(check_black(render(lit + floor("plane", 0, 1, "red")), "RGBA"));
    EXPECT_TRUE(check_constant(render(lit + floor("plane", 0, 1, "red", " sidedness 253")), "RGBA",
                               Color::grey(1.5F * kInvPi), 1e-5));
    EXPECT_TRUE(check_black(render(lit + facing_down(" sidedness 253")), "RGBA"));
}

TEST(Shapes, SidesThatNobodySeesHideNoLight) {
    // Light comes by shadow rays and by rays that meet the lamp, here past all depth limits. All of them meet the back of
    // the plane.
    const std::string lit =
        frame_text(24, 24, 8, ortho_camera({0.3F, -0.5F, 0}, {0, -1, 0}, 0.01F),
                   " GI_diffuse_depth 0") +
        lambert("grey", 0.5F) + floor("ground", -1, 3, "grey") + square_light("lamp", 1, 1.5F, "");
    EXPECT_TRUE(check_same_mean(render(lit + floor("none", 0, 3, "grey", " sidedness 0")), "RGBA",
                                render(lit), "RGBA"));
}

TEST(Shapes, FacesChooseTheirShader) {
    const std::string mesh = node("polymesh", "two",
                                  " nsides 2 1 UINT 4 4\n vidxs 8 1 UINT 0 1 2 3  3 2 4 5\n vlist "
                                  "6 1 VECTOR -1 0 -1  -1 0 1  0 0 1  0 0 -1  1 0 1  1 0 -1\n "
                                  "shader 2 1 NODE \"red\" \"blue\"\n shidxs 2 1 BYTE 1 0");
    const Picture picture =
        render(frame_text(2, 2, 2, from_above(1)) + node("flat", "red", " color 1 0 0") +
               node("flat", "blue", " color 0 0 1") + mesh);
    EXPECT_EQ(picture.color("RGBA", 0), Color(0, 0, 1));
    EXPECT_EQ(picture.color("RGBA", 1), Color(1, 0, 0));
}

// Instances and motion -----------------------------------------------------------------------------------------------------

TEST(Instances, EqualACopiedShape) {
    const std::string move = " matrix 0.8 0 0.6 0  0 1.5 0 0  -0.6 0 0.8 0  0.3 0.1 -0.2 1";
    const std::string head =
        frame_text(24, 24, 3, persp_camera({0, 1.5F, 4}, {0, 0.3F, 0}, 45)) +
        node("standard_surface", "gloss", " specular_roughness 0.3") +
        node("distant_light", "sun", " direction 0.4 -0.8 -0.3\n intensity 3") +
        node("skydome_light", "sky", " intensity 0.3");
    const std::string copy =
        sphere("ball", {0.2F, 0.1F, 0}, 0.6F, "gloss", move) +
        quad("wall", {-1, 0, -1}, {1, 0, -1}, {1, 1, -1}, {-1, 1, -1}, "gloss", move);
    const std::string source =
        sphere("ball", {0.2F, 0.1F, 0}, 0.6F, "gloss", " visibility 0") +
        quad("wall", {-1, 0, -1}, {1, 0, -1}, {1, 1, -1}, {-1, 1, -1}, "gloss", " visibility 0");
    const std::string instances = node("ginstance", "i1", " node ball\n visibility 255\n" + move) +
                                  node("ginstance", "i2", " node wall\n visibility 255\n" + move);
    const Picture a = render(head + copy), b = render(head + source + instances);
    EXPECT_TRUE(check_same_mean(a, "RGBA", b, "RGBA"));
    // The same samples meet the same points but for rounding, so nearly all pixels agree closely.
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.n_pixels(); ++i)
        differ += std::abs(a.color("RGBA", i).g - b.color("RGBA", i).g) > 1e-3F ? 1 : 0;
    EXPECT_LT(differ, a.n_pixels() / 50);
}

TEST(Instances, OverrideShaderAndNest) {
    const std::string head = frame_text(8, 8, 2, from_above(1)) +
                             node("flat", "red", " color 1 0 0") +
                             node("flat", "blue", " color 0 0 1");
    const std::string source = floor("plane", 0, 1, "red", " visibility 0");
    EXPECT_TRUE(check_constant(
        render(head + source +
               node("ginstance", "i", " node plane\n visibility 255\n shader blue")),
        "RGBA", {0, 0, 1}, 1e-6));
    const std::string nested =
        node("ginstance", "inner",
             " node plane\n visibility 0\n matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 -5 0 1") +
        node("ginstance", "outer",
             " node inner\n visibility 255\n matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 5 0 1");
    const Picture both = render(head + source + nested, in_memory({"Z FLOAT"}));
    EXPECT_TRUE(check_constant(both, "RGBA", {1, 0, 0}, 1e-6));
    EXPECT_NEAR(both.color("Z", 0).r, 2, 1e-5) << "the two matrices cancel";
}

TEST(Motion, CoverageOfAMovingEmitterIsItsShareOfTheShutter) {
    // A plate 1 wide slides from x in -1.5..-0.5 to 0.5..1.5 while the shutter is open: at x it covers for the part of
    // the time in which |x - center| < 1/2, which is 1/2 for |x| < 1/2 and falls to 0 at |x| = 3/2.
    const std::string camera =
        node("ortho_camera", "cam",
             " position 0 2 0\n look_at 0 0 0\n up 0 0 -1\n screen_window_min -2 -2\n "
             "screen_window_max 2 2\n shutter_start 0\n shutter_end 1");
    const std::string plate =
        node("flat", "glow", " color 1 1 1") + quad("plate", {-0.5F, 0, -3}, {-0.5F, 0, 3},
                                                    {0.5F, 0, 3}, {0.5F, 0, -3}, "glow",
                                                    " matrix 1 2 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 "
                                                    "-1 0 0 1  1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1");
    const Picture picture = render(frame_text(16, 16, 10, camera) + plate);
    for (int x = 0; x < 16; ++x) {
        double mean = 0, truth = 0;
        for (std::size_t y = 0; y < 16; ++y)
            mean += static_cast<double>(
                        picture.color("RGBA", y * 16 + static_cast<std::size_t>(x)).r) /
                    16;
        for (int s = 0; s < 100; ++s) {
            const double at = std::abs((x + (s + 0.5) / 100) / 4 - 2);
            truth += (at < 0.5 ? 0.5 : at < 1.5 ? (1.5 - at) / 2 : 0) / 100;
        }
        // 1600 samples a column: 0.0125 at most for independent ones, which stratified ones are better than.
        EXPECT_NEAR(mean, truth, 0.03) << "column " << x;
    }
}

TEST(Motion, VerticesMoveToo) {
    const std::string camera =
        node("ortho_camera", "cam",
             " position 0 2 0\n look_at 0 0 0\n up 0 0 -1\n screen_window_min -2 -2\n "
             "screen_window_max 2 2\n shutter_start 0\n shutter_end 1");
    const std::string plate =
        node("flat", "glow", " color 1 1 1") +
        node("polymesh", "plate",
             " nsides 1 1 UINT 4\n vidxs 4 1 UINT 0 1 2 3\n shader glow\n vlist 4 2 VECTOR -1.5 0 "
             "-3  -1.5 0 3  -0.5 0 3  -0.5 0 -3  0.5 0 -3  0.5 0 3  1.5 0 3  1.5 0 -3");
    const std::string same =
        node("flat", "glow", " color 1 1 1") + quad("plate", {-0.5F, 0, -3}, {-0.5F, 0, 3},
                                                    {0.5F, 0, 3}, {0.5F, 0, -3}, "glow",
                                                    " matrix 1 2 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 "
                                                    "-1 0 0 1  1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1");
    EXPECT_TRUE(check_same_mean(render(frame_text(16, 16, 4, camera) + plate), "RGBA",
                                render(frame_text(16, 16, 4, camera) + same), "RGBA"));
}

TEST(Motion, ATurningPlateStaysAsLarge) {
    // A plate that turns by half a turn about its middle, between two keys. Element by element it would pass through a line.
    const std::string camera =
        node("ortho_camera", "cam",
             " position 0 2 0\n look_at 0 0 0\n up 0 0 -1\n screen_window_min -2 -2\n "
             "screen_window_max 2 2\n shutter_start 0\n shutter_end 1");
    const auto turned = [&](const char* type) {
        return render(frame_text(16, 16, 8, camera) + node("flat", "glow", " color 1 1 1") +
                      quad("plate", {1, 0, -1}, {1, 0, 1}, {3, 0, 1}, {3, 0, -1}, "glow",
                           std::string(" matrix 1 2 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 -2 0 0 1  -1 0 "
                                       "0 0 0 1 0 0 0 0 -1 0 2 0 0 1\n transform_type ") +
                               type))
            .mean_alpha("RGBA");
    };
    // A square of side 2 in a window of 4 covers a quarter all the time.
    EXPECT_NEAR(turned("rotate_about_center"), 0.25, 5e-3);
    EXPECT_NEAR(turned("linear"), 0.25 / 3, 0.01);
    // About the origin, which lies beside the plate, it swings out of the window and back.
    EXPECT_LT(turned("rotate_about_origin"), 0.24);
}

}  // namespace
}  // namespace lightsieve::testing
