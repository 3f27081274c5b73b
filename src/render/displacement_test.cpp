// Subdivision and displacement as pictures: heights, normals, bumps, user data against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

const std::string kGrey = lambert("grey", 0.5F);

/// A square from -1 to 1 that faces up; u runs along x.
std::string square(std::string_view more) {
    return quad("square", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, "grey", more);
}

/// The height sin(2 pi u) in a node `wave`.
const std::string kWave = node("state_float", "along", " variable u") +
                          node("trigo", "wave",
                               " input along\n function sin\n units radians\n frequency "
                               "6.28318531");
const char* const kFine = " smoothing on\n subdiv_type linear\n subdiv_iterations 7\n";

Picture seen(const std::string& scene, const std::vector<std::string>& warnings = {},
             std::string_view options = "") {
    return render(TestScene(frame_text(24, 24, 1, from_above(1.9F), options) + kGrey + scene,
                            in_memory({"P VECTOR", "N VECTOR"}), warnings));
}

Vec3f normal_at(const Picture& picture, std::size_t pixel) {
    const Color n = picture.color("N", pixel);
    return {n.r, n.g, n.b};
}

/// Every pixel shows the wave with that height, and its normals.
void expect_wave(const Picture& picture, float height, float normal_tolerance) {
    for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
        const Color p = picture.color("P", i), n = picture.color("N", i);
        const float phase = kPi * (p.r + 1);
        EXPECT_NEAR(p.g, height * std::sin(phase), 2e-3F * std::abs(height)) << i;
        const Vec3f truth = normalize(Vec3f{-height * kPi * std::cos(phase), 1, 0});
        EXPECT_LT(length(Vec3f{n.r, n.g, n.b} - truth), normal_tolerance) << i;
    }
}

TEST(Displacement, NumbersMoveAlongTheNormal) {
    expect_wave(seen(kWave + square(std::string(kFine) + " disp_map wave\n disp_height 0.1")),
                0.1F, 0.02F);
    // Upward of the mesh as it is modelled, not of where the viewer is.
    const Picture tilted = seen(
        kWave +
        square(std::string(kFine) +
               " disp_map wave\n disp_height 0.1\n matrix 1 0 0 0  0 -1 0 0  0 0 1 0  0 0 0 1"));
    expect_wave(tilted, -0.1F, 0.02F);
}

TEST(Displacement, HeightAndZeroValue) {
    // (1 - 0.25) * 0.4 everywhere.
    const std::string one = node("float_to_rgb", "one", " r 1\n g 1\n b 1");
    const Picture picture =
        seen(one + square(std::string(kFine) +
                          " disp_map one\n disp_height 0.4\n disp_zero_value 0.25"));
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        EXPECT_NEAR(picture.color("P", i).g, 0.3F, 1e-5F);
    EXPECT_NEAR(picture.color("N", 77).g, 1, 1e-5F);
}

TEST(Displacement, VectorsMoveInObjectSpace) {
    // The object is turned by a quarter: its x axis is the world's -z axis.
    const char* turned = " matrix 0 0 -1 0  0 1 0 0  1 0 0 0  0 0 0 1";
    const auto moved = [&](std::string_view input, std::string_view space) {
        const Picture picture = render(frame_text(16, 16, 2, from_above(4)) + kGrey +
                                           node("vector_map", "v",
                                                " order XYZ\n input " + std::string(input) +
                                                    "\n tangent_space " + std::string(space)) +
                                           square(std::string(kFine) + " disp_map v\n" + turned),
                                       in_memory({"P VECTOR"}));
        const auto n = static_cast<float>(picture.mean_alpha("RGBA"));
        const Color p = picture.mean("P");
        return Vec3f{p.r, p.g, p.b} / n;
    };
    EXPECT_LT(length(moved("0.5 0 0", "off") - Vec3f{0, 0, -0.5F}), 5e-3F);
    EXPECT_LT(length(moved("0 0.25 0", "off") - Vec3f{0, 0.25F, 0}), 5e-3F);
    // In tangent space the last axis is the normal, the first runs along u: the object's x axis.
    EXPECT_LT(length(moved("0.5 0 0.25", "on") - Vec3f{0, 0.25F, -0.5F}), 5e-3F);
}

TEST(Displacement, AutobumpShadesAsTheFinerMeshWould) {
    // Two by two quads: their vertices lie where the wave is 0, so the mesh stays flat, and only normals tell.
    const std::string coarse =
        " smoothing on\n subdiv_type linear\n subdiv_iterations 1\n disp_map wave\n disp_height "
        "0.1\n";
    const Picture bumped = seen(kWave + square(coarse + " disp_autobump on"));
    const Picture flat = seen(kWave + square(coarse));
    const Picture hidden =
        seen(kWave + square(coarse + " disp_autobump on\n autobump_visibility 254"));
    for (std::size_t i = 0; i < bumped.n_pixels(); ++i) {
        const Color p = bumped.color("P", i), n = bumped.color("N", i);
        EXPECT_NEAR(p.g, 0, 1e-6F);
        const float slope = 0.1F * kPi * std::cos(kPi * (p.r + 1));
        const Vec3f truth = normalize(Vec3f{-slope, 1, 0});
        // The slope is measured over half of what the ray sees.
        EXPECT_LT(length(Vec3f{n.r, n.g, n.b} - truth), 0.03F) << i;
        EXPECT_LT(length(normal_at(flat, i) - Vec3f{0, 1, 0}), 1e-5F);
        EXPECT_LT(length(normal_at(hidden, i) - Vec3f{0, 1, 0}), 1e-5F);
    }
    // The light that it sends: of the fine mesh and of the bumps, the same but for what the waves hide from one another.
    const std::string sun = node("distant_light", "sun", " direction 0 -1 0\n intensity 3");
    const Picture fine =
        seen(kWave + sun + square(std::string(kFine) + " disp_map wave\n disp_height 0.1"));
    const Picture bumps = seen(kWave + sun + square(coarse + " disp_autobump on"));
    EXPECT_NEAR(fine.mean("RGBA").g, bumps.mean("RGBA").g, 0.01F * fine.mean("RGBA").g);
    EXPECT_LT(fine.mean("RGBA").g, 0.99F * 1.5F * kInvPi);
}

TEST(Displacement, AutobumpLeavesSmoothSurfacesSmooth) {
    // A displacement of nothing: normals are those of the smooth surface, not of its quads.
    const std::string zero = node("float_to_rgb", "zero", " r 0\n g 0\n b 0");
    const std::string ball =
        " nsides 6 1 UINT 4 4 4 4 4 4\n vidxs 24 1 UINT 0 4 6 2  1 3 7 5  0 1 5 4  2 6 7 3  0 "
        "2 3 1  4 5 7 6\n vlist 8 1 VECTOR -1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 "
        "1  -1 1 1  1 1 1\n smoothing on\n subdiv_type catclark\n subdiv_iterations 4\n "
        "shader grey\n disp_map zero\n disp_autobump ";
    const auto round = [&](const char* bump) {
        return render(frame_text(16, 16, 1, from_above(1, 3)) + kGrey + zero +
                          node("polymesh", "ball", ball + bump),
                      in_memory({"N VECTOR"}));
    };
    const Picture on = round("on"), off = round("off");
    for (std::size_t i = 0; i < on.n_pixels(); ++i)
        EXPECT_LT(length(normal_at(on, i) - normal_at(off, i)), 0.02F) << i;
    EXPECT_GT(length(normal_at(off, 0) - normal_at(off, 255)), 0.3F);
}

TEST(Displacement, SeamsStayClosed) {
    // Two squares with a seam of texture coordinates between them: u = 0..0.25 left of it, 0.75..1 right of it. Without
    // care the vertices of the seam would come apart, and the background would show.
    const std::string mesh =
        " nsides 2 1 UINT 4 4\n vidxs 8 1 UINT 0 1 4 3  1 2 5 4\n vlist 6 1 VECTOR -1 0 1  0 "
        "0 1  1 0 1  -1 0 -1  0 0 -1  1 0 -1\n uvlist 8 1 VECTOR2 0 0  0.25 0  0.25 1  0 1  "
        "0.75 0  1 0  1 1  0.75 1\n uvidxs 8 1 UINT 0 1 2 3 4 5 6 7\n shader grey\n "
        "disp_map wave\n disp_height 0.3\n";
    const Picture picture = seen(kWave + node("polymesh", "two", mesh + kFine));
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        EXPECT_EQ(picture.alpha("RGBA", i), 1);
}

TEST(Displacement, OptionsSwitchItOff) {
    const std::string scene =
        kWave + square(std::string(kFine) + " disp_map wave\n disp_height 0.1");
    const Picture flat = seen(scene, {}, " ignore_displacement on");
    for (std::size_t i = 0; i < flat.n_pixels(); ++i)
        EXPECT_EQ(flat.color("P", i).g, 0);
    // Without subdivision only the corners are moved, where the wave is 0.
    const Picture coarse = seen(scene, {}, " ignore_subdivision on");
    for (std::size_t i = 0; i < coarse.n_pixels(); ++i)
        EXPECT_NEAR(coarse.color("P", i).g, 0, 1e-5F);
    const auto triangles = [&](std::string_view options) {
        return TestScene(frame_text(4, 4, 1, from_above(1), options) + kGrey + scene)
            .scene()
            .summary.n_triangles;
    };
    EXPECT_EQ(triangles(""), 2U << 14U);
    EXPECT_EQ(triangles(" max_subdivisions 2"), 32U);
    EXPECT_EQ(triangles(" ignore_subdivision on"), 2U);
}

TEST(Displacement, ShadersThatGiveNoNumberAreReported) {
    const Picture picture =
        seen(square(std::string(kFine) + " disp_map grey"), {"gives no number"});
    EXPECT_EQ(picture.color("P", 5).g, 0);
}

TEST(Subdivision, UserDataAndShadersGoThrough) {
    // Values that are linear over the mesh look the same however it is cut.
    const auto scene = [](std::string_view how) {
        return frame_text(16, 16, 2, from_above(2)) + node("flat", "paint", " color sum") +
               node("flat", "red", " color 1 0 0") +
               node("add", "sum", " input1 sum2\n input2 i") +
               node("add", "sum2", " input1 v\n input2 u") +
               node("user_data_rgb", "v", " attribute vary") +
               node("user_data_rgb", "u", " attribute face") +
               node("user_data_rgb", "i", " attribute corner") +
               node("polymesh", "m",
                    " nsides 3 1 UINT 4 3 3\n vidxs 10 1 UINT 0 1 4 3  1 2 5  1 5 4\n vlist 6 1 "
                    "VECTOR -1 0 1  0 0 1  1 0 1  -1 0 -1  0 0 -1  1 0 -1\n shader 2 1 NODE "
                    "paint red\n shidxs 3 1 BYTE 0 0 1\n declare vary varying RGB\n vary 6 1 RGB "
                    "0 0 0  0.1 0 0  0.2 0 0  0 0.2 0  0.1 0.2 0  0.2 0.2 0\n declare face "
                    "uniform RGB\n face 3 1 RGB 0 0 0.1  0 0 0.2  0 0 0.3\n declare corner "
                    "indexed RGB\n corner 3 1 RGB 0 0.1 0  0.3 0.1 0  0.3 0.1 0.3\n corneridxs 10 "
                    "1 UINT 0 1 1 0  0 1 2  0 1 2\n" +
                        std::string(how));
    };
    const Picture whole = render(scene("")),
                  cut = render(scene(" subdiv_type linear\n subdiv_iterations 3\n"));
    EXPECT_GT(whole.mean("RGBA").b, 0.05F);
    EXPECT_TRUE(check_equal(whole, "RGBA", cut, "RGBA", 1e-4));
}

TEST(Subdivision, AdaptiveErrorCountsPixels) {
    const auto triangles = [](std::string_view camera, std::string_view more) {
        return TestScene(frame_text(100, 100, 1, camera) + kGrey +
                         square(" subdiv_type catclark\n subdiv_iterations 6\n "
                                "subdiv_adaptive_metric edge_length\n" +
                                std::string(more)))
            .scene()
            .summary.n_triangles;
    };
    // The square is 50 pixels wide: 3 steps make edges of 6.25 pixels, 4 of 3.1.
    EXPECT_EQ(triangles(from_above(4), " subdiv_adaptive_error 7"), 2U << 6U);
    EXPECT_EQ(triangles(from_above(4), " subdiv_adaptive_error 6"), 2U << 8U);
    EXPECT_EQ(triangles(from_above(40), " subdiv_adaptive_error 6"), 2U);
    EXPECT_EQ(triangles(from_above(4), " subdiv_adaptive_error 0.001"), 2U << 12U);
    // Perspective: at distance 10 with 90 degrees the picture is 20 units wide.
    EXPECT_EQ(
        triangles(persp_camera({0, 10, 0}, {0, 0, 0}, 90, {0, 0, -1}), " subdiv_adaptive_error 6"),
        2U << 2U);
    EXPECT_EQ(
        triangles(from_above(4), " subdiv_adaptive_error 0.6\n subdiv_adaptive_space object"),
        2U << 4U);
    // Another camera than the one of the frame.
    const std::string far = node("ortho_camera", "far",
                                 " position 0 2 0\n look_at 0 0 0\n up 0 0 -1\n screen_window_min "
                                 "-20 -20\n screen_window_max 20 20");
    EXPECT_EQ(TestScene(frame_text(100, 100, 1, from_above(4)) + kGrey + far +
                        square(" subdiv_type catclark\n subdiv_iterations 6\n "
                               "subdiv_adaptive_metric edge_length\n subdiv_adaptive_error 6\n "
                               "subdiv_dicing_camera far"))
                  .scene()
                  .summary.n_triangles,
              2U);
}

}  // namespace
}  // namespace lightsieve::testing
