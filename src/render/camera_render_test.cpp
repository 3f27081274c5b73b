// Cameras in pictures: maps over the film, empty parts of the frame, rolling shutters; and AOVs that are read again.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

std::string camera(std::string_view type, std::string_view body) {
    return node(type, "cam", body);
}
/// A sky of radiance 1 before the camera.
std::string before_the_sky(const std::string& cam, int width = 16, int height = 16) {
    return frame_text(width, height, 2, cam) + node("skydome_light", "sky", " intensity 1");
}

TEST(CamerasInPictures, FiltermapWeighsAndEmpties) {
    const Picture half = render(before_the_sky(camera("persp_camera", " filtermap \"map\"")) +
                                node("flat", "map", " color 0.5 0.25 0.75"));
    EXPECT_TRUE(check_constant(half, "RGBA", Color::grey(0.5F), 1e-5));
    EXPECT_EQ(half.mean_alpha("RGBA"), 1);
    // A checkerboard of 2 x 2: the lower left is black, and nothing is traced there.
    const Picture cells = render(before_the_sky(camera("persp_camera", " filtermap \"map\"")) +
                                 node("checkerboard", "map", " color1 1 1 1\n color2 0 0 0"));
    const auto at = [&](std::size_t x, std::size_t y) { return y * 16 + x; };
    EXPECT_EQ(cells.color("RGBA", at(2, 13)), kBlack);
    EXPECT_EQ(cells.alpha("RGBA", at(2, 13)), 0);
    EXPECT_EQ(cells.color("RGBA", at(13, 13)), kWhite);
    EXPECT_EQ(cells.color("RGBA", at(2, 2)), kWhite);
    EXPECT_EQ(cells.alpha("RGBA", at(2, 2)), 1);
}

TEST(CamerasInPictures, RemapThroughALink) {
    // Everywhere the same place of the film, where a small bright wall stands.
    const std::string wall =
        node("flat", "glow", " color 1 2 3") +
        quad("wall", {1, 0.9F, -5}, {1.2F, 0.9F, -5}, {1.2F, 1.1F, -5}, {1, 1.1F, -5}, "glow");
    const std::string head =
        frame_text(8, 8, 2, camera("persp_camera", " fov 90\n uv_remap \"map\""));
    // Film 0.61, 0.6 is (1.1, 1) of a frame that reaches from -5 to 5 there.
    const Picture there = render(head + wall + node("flat", "map", " color 0.61 0.6 0"));
    EXPECT_TRUE(check_constant(there, "RGBA", {1, 2, 3}, 1e-5));
    EXPECT_TRUE(
        check_black(render(head + wall + node("flat", "map", " color 0.5 0.6 0")), "RGBA"));
}

TEST(CamerasInPictures, FisheyesAreEmptyOutsideOfTheirCircle) {
    const Picture round = render(before_the_sky(camera("fisheye_camera", " fov 180"), 32, 32));
    // The circle's part of the frame is pi / 4.
    EXPECT_NEAR(round.mean_alpha("RGBA"), kPi / 4, 0.01);
    EXPECT_NEAR(round.mean("RGBA").r, kPi / 4, 0.01);
    const Picture full =
        render(before_the_sky(camera("fisheye_camera", " fov 180\n autocrop on"), 32, 32));
    EXPECT_TRUE(check_constant(full, "RGBA", kWhite, 1e-5));
}

TEST(CamerasInPictures, APanoramaShowsALatlongSkyAsItIs) {
    // A spherical camera shows the sky's own picture, turned by half a turn: its middle looks along -Z, that of the sky
    // along +Z.
    const Picture seen = render(frame_text(32, 16, 2, camera("spherical_camera", "")) +
                                node("skydome_light", "sky", " color \"cells\"") +
                                node("checkerboard", "cells",
                                     " color1 1 0 0\n color2 0 1 0\n "
                                     "u_frequency 1\n v_frequency 1"));
    const auto at = [&](std::size_t x, std::size_t y) { return seen.color("RGBA", y * 32 + x); };
    // Our upper left lies at u 0.64, v 0.78 of the sky: cell 1 + 1, the second colour.
    const Color red{1, 0, 0}, green{0, 1, 0};
    EXPECT_EQ(at(4, 3), green);
    EXPECT_EQ(at(28, 3), red);
    EXPECT_EQ(at(4, 12), red);
    EXPECT_EQ(at(28, 12), green);
}

TEST(CamerasInPictures, RollingShuttersLeanMovingThings) {
    // An upright bar that moves from -4 to 4; lines are exposed one after the other, from the top.
    const auto middle_of_rows = [](std::string_view rolling) {
        const Picture picture = render(
            frame_text(32, 32, 4,
                       camera("ortho_camera",
                              " screen_window_min -8 -8\n screen_window_max 8 8\n "
                              "shutter_start 0\n shutter_end 1\n" +
                                  std::string(rolling))) +
            node("flat", "glow", " color 1 1 1") +
            quad("bar", {-0.5F, -9, -5}, {0.5F, -9, -5}, {0.5F, 9, -5}, {-0.5F, 9, -5}, "glow",
                 " matrix 1 2 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 -4 0 0 1 1 0 0 0 0 1 0 0 0 0 "
                 "1 0 4 0 0 1\n motion_start 0\n motion_end 1"));
        std::vector<double> middles;
        for (std::size_t y = 0; y < 32; ++y) {
            double sum = 0, moment = 0;
            for (std::size_t x = 0; x < 32; ++x) {
                const double v = static_cast<double>(picture.color("RGBA", y * 32 + x).r);
                sum += v;
                moment += v * ((static_cast<double>(x) + 0.5) / 2 - 8);
            }
            middles.push_back(moment / sum);
        }
        return middles;
    };
    const std::vector<double> off = middle_of_rows(""),
                              top = middle_of_rows(" rolling_shutter top"),
                              half = middle_of_rows(
                                  " rolling_shutter bottom\n rolling_shutter_duration 0.5");
    for (std::size_t y = 0; y < 32; ++y) {
        const double down = (static_cast<double>(y) + 0.5) / 32;
        EXPECT_NEAR(off[y], 0, 0.6);
        EXPECT_NEAR(top[y], -4 + 8 * down, 0.3) << y;
        EXPECT_NEAR(half[y], -4 + 8 * (0.5 * (1 - down) + 0.25), 0.6) << y;
    }
}

TEST(AovRead, SeesWhatTheSurfaceWrote) {
    const std::string scene =
        frame_text(4, 4, 1, from_above(1), " aov_shaders \"again\"") +
        node("aov_write_rgb", "ground_shader",
             " passthrough \"grey\"\n aov_input 0.25 0.5 0.75\n aov_name \"first\"") +
        lambert("grey", 0.5F) + floor("ground", 0, 1, "ground_shader") +
        node("aov_read_rgb", "read", " aov_name \"first\"") +
        node("aov_write_rgb", "again", " aov_input \"read\"\n aov_name \"second\"");
    const Picture picture = render(scene, in_memory({"first", "second"}));
    EXPECT_TRUE(check_constant(picture, "first", {0.25F, 0.5F, 0.75F}, 1e-6));
    EXPECT_TRUE(check_identical(picture, "first", picture, "second"));
}

}  // namespace
}  // namespace lightsieve::testing
