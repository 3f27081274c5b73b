// What becomes of an output string: cameras, filters, regions, types, and the layers that are no light.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

const std::string kRed = node("flat", "red", " color 1 0 0"),
                  kBlue = node("flat", "blue", " color 0 0 1");

TEST(Outputs, ASecondCameraSeesItsOwnView) {
    const std::string side = node("ortho_camera", "side",
                                  " position 2 0 0\n look_at 0 0 0\n screen_window_min -0.1 "
                                  "-0.1\n screen_window_max 0.1 0.1");
    const Picture picture =
        render(frame_text(6, 6, 2, ortho_camera({0, 2, 0}, {0, 0, 0}, 0.2F, {0, 0, -1}),
                          outputs({"RGBA RGBA f d", "side RGBA RGBA f d from_side",
                                   "side Z FLOAT f d depth", "emission RGB f d"})) +
               side + kRed + kBlue + floor("plane", 0, 0.5F, "red") +
               quad("wall", {1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}, "blue"));
    EXPECT_TRUE(check_constant(picture, "RGBA", {1, 0, 0}, 1e-6));
    EXPECT_TRUE(check_constant(picture, "from_side", {0, 0, 1}, 1e-6));
    EXPECT_TRUE(check_constant(picture, "depth", kWhite, 1e-5));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "emission"));
}

TEST(Outputs, ACameraFromTheCommandLineReplacesTheScenes) {
    RenderOptions options = in_memory();
    options.camera = "side";
    const std::string side = node("ortho_camera", "side",
                                  " position 2 0 0\n look_at 0 0 0\n screen_window_min -0.1 "
                                  "-0.1\n screen_window_max 0.1 0.1");
    const Picture picture =
        render(frame_text(4, 4, 2, ortho_camera({0, 2, 0}, {0, 0, 0}, 0.2F, {0, 0, -1})) + side +
                   kRed + kBlue + floor("plane", 0, 0.5F, "red") +
                   quad("wall", {1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}, "blue"),
               options);
    EXPECT_TRUE(check_constant(picture, "RGBA", {0, 0, 1}, 1e-6));
}

// Filters ----------------------------------------------------------------------------------------------------------------

/// An edge down the picture: red for x < 0.13, nothing beyond. 16 x 16 pixels over 16 x 16 units.
std::string edge_scene(const std::string& options) {
    return frame_text(16, 16, 8, ortho_camera({0, 2, 0}, {0, 0, 0}, 16, {0, 0, -1}), options) +
           kRed +
           quad("half", {-20, 0, -20}, {-20, 0, 20}, {0.13F, 0, 20}, {0.13F, 0, -20}, "red");
}

/// Mean of a column.
double column(const Picture& picture, const std::string& layer, std::size_t x) {
    double sum = 0;
    for (std::size_t y = 0; y < 16; ++y)
        sum += static_cast<double>(picture.color(layer, y * 16 + x).r) / 16;
    return sum;
}

/// Part of a filter's weight that lies left of the edge, for the column whose centre is `distance` right of it.
template <class Weight>
double share(double distance, double radius, const Weight& weight) {
    double left = 0, all = 0;
    for (int i = 0; i < 4000; ++i) {
        const double at = ((i + 0.5) / 2000 - 1) * radius;
        all += weight(at);
        left += distance + at < 0 ? weight(at) : 0;
    }
    return left / all;
}

TEST(Filters, EachOutputHasItsOwn) {
    const std::string filters = node("gaussian_filter", "g", " width 2") +
                                node("triangle_filter", "t", " width 2") +
                                node("box_filter", "wide", " width 3");
    const Picture picture = render(
        edge_scene(outputs({"RGBA RGBA g d", "emission RGB f d boxed", "emission RGB t d tented",
                            "emission RGB wide d wide", "emission RGB g d same"})) +
        filters);
    // The gaussian of Arnold is separable in d only over a disc of radius 1: integrate it over the disc.
    const auto gaussian = [](double x) {
        double sum = 0;
        for (int i = -200; i <= 200; ++i) {
            const double y = i / 200.0, d2 = x * x + y * y;
            sum += d2 <= 1 ? std::exp(-2 * d2) : 0;
        }
        return sum;
    };
    EXPECT_TRUE(check_identical(picture, "RGBA", picture, "RGBA"));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "same")) << "one filter, one set of samples";
    for (std::size_t x = 5; x < 11; ++x) {
        const double distance = static_cast<double>(x) + 0.5 - 8 - 0.13;
        // 1024 stratified samples a column: noise stays below 0.01; without stratification it would be 0.016.
        EXPECT_NEAR(column(picture, "boxed", x), share(distance, 0.5, [](double) { return 1; }),
                    0.015)
            << "box, column " << x;
        EXPECT_NEAR(column(picture, "tented", x),
                    share(distance, 1, [](double d) { return 1 - std::abs(d); }), 0.03)
            << "triangle, column " << x;
        EXPECT_NEAR(column(picture, "wide", x), share(distance, 1.5, [](double) { return 1; }),
                    0.015)
            << "wide box, column " << x;
        EXPECT_NEAR(column(picture, "RGBA", x), share(distance, 1, gaussian), 0.015)
            << "gaussian, column " << x;
    }
}

TEST(Filters, OfOneOutputNeverChangesTheBeauty) {
    const std::string filters = node("gaussian_filter", "g", " width 2") +
                                node("blackman_harris_filter", "b", " width 3") +
                                node("closest_filter", "c", "");
    const Picture alone = render(edge_scene(outputs({"RGBA RGBA g d"})) + filters),
                  company = render(edge_scene(outputs({"emission RGB b d e", "Z FLOAT c d",
                                                       "RGBA RGBA g d", "emission RGB f d f"})) +
                                   filters);
    EXPECT_TRUE(check_identical(alone, "RGBA", company, "RGBA"));
}

TEST(Filters, WithNegativeLobesKeepEvenPictures) {
    const std::string scene =
        frame_text(8, 8, 6, ortho_camera({0, 2, 0}, {0, 0, 0}, 1, {0, 0, -1}),
                   outputs({"RGBA RGBA s d", "emission RGB c d c", "emission RGB m d m"})) +
        kRed + floor("plane", 0, 5, "red") + node("sinc_filter", "s", "") +
        node("catrom_filter", "c", "") + node("mitnet_filter", "m", "");
    const Picture picture = render(scene);
    for (const char* layer : {"RGBA", "c", "m"})
        EXPECT_TRUE(check_constant(picture, layer, {1, 0, 0}, 1e-5));
}

TEST(Filters, ClosestTakesTheNearestSample) {
    // A thin rod in front of a wall: wherever any sample meets the rod, Z is the rod's.
    const std::string rod =
        quad("rod", {-0.02F, 1, -9}, {-0.02F, 1, 9}, {0.02F, 1, 9}, {0.02F, 1, -9}, "red");
    const Picture picture = render(
        frame_text(
            9, 9, 10, ortho_camera({0, 3, 0}, {0, 0, 0}, 1, {0, 0, -1}),
            outputs({"RGBA RGBA f d", "Z FLOAT c d", "ID UINT c d", "Z FLOAT f d mean_z"})) +
        kRed + kBlue + node("closest_filter", "c", "") + floor("wall", 0, 9, "blue", " id 7") +
        rod);
    for (std::size_t y = 0; y < 9; ++y) {
        EXPECT_FLOAT_EQ(picture.color("Z", y * 9 + 4).r, 2);
        EXPECT_FLOAT_EQ(picture.color("Z", y * 9 + 2).r, 3);
        EXPECT_GT(picture.color("mean_z", y * 9 + 4).r, 2.1F);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(picture.color("ID", y * 9 + 2).r), 7U);
        EXPECT_NE(std::bit_cast<std::uint32_t>(picture.color("ID", y * 9 + 4).r), 7U);
    }
}

TEST(Filters, ClosestOfLightIsTheNearestSamplesLight) {
    // Light layers cannot be averaged under such a filter; they show the sample that Z shows.
    const std::string rod =
        quad("rod", {-0.02F, 1, -9}, {-0.02F, 1, 9}, {0.02F, 1, 9}, {0.02F, 1, -9}, "red");
    const Picture picture =
        render(frame_text(9, 9, 10, ortho_camera({0, 3, 0}, {0, 0, 0}, 1, {0, 0, -1}),
                          outputs({"RGBA RGBA c d", "emission RGB c d"})) +
               kRed + kBlue + node("closest_filter", "c", "") + floor("wall", 0, 9, "blue") + rod);
    for (std::size_t y = 0; y < 9; ++y)
        for (const char* layer : {"RGBA", "emission"}) {
            EXPECT_EQ(picture.color(layer, y * 9 + 4), Color(1, 0, 0)) << layer;
            EXPECT_EQ(picture.color(layer, y * 9 + 2), Color(0, 0, 1)) << layer;
        }
}

// Types and data ---------------------------------------------------------------------------------------------------------

TEST(Outputs, HalfIsPassedOnAndNamesAreKept) {
    const Picture picture = render(
        frame_text(2, 2, 1, ortho_camera({0, 2, 0}, {0, 0, 0}, 1, {0, 0, -1}),
                   outputs({"RGBA RGBA f d", "emission RGB f d glow HALF", "diffuse RGB f d"})) +
        kRed + floor("plane", 0, 5, "red"));
    EXPECT_TRUE(picture.layer("glow").info.half);
    EXPECT_FALSE(picture.layer("diffuse").info.half);
    EXPECT_EQ(picture.layer("glow").info.aov, "emission");
    EXPECT_EQ(picture.layer("glow").info.expression, "C[LO]");
    EXPECT_TRUE(check_constant(picture, "glow", {1, 0, 0}, 1e-6));
}

TEST(Outputs, DataLayersDescribeTheFirstHit) {
    // A plane tilted by 3-4-5, seen from above at (0.3, *, -0.2): its height there is 0.75 * 0.3.
    const std::string plane =
        quad("slope", {-4, -3, -4}, {-4, -3, 4}, {4, 3, 4}, {4, 3, -4}, "red", " id 12");
    const Picture picture = render(
        frame_text(2, 2, 3, ortho_camera({0.3F, 5, -0.2F}, {0.3F, 0, -0.2F}, 1e-3F, {0, 0, -1}),
                   outputs({"RGBA RGBA f d", "Z FLOAT f d", "N VECTOR f d", "P VECTOR f d",
                            "A FLOAT f d", "ID UINT f d", "uv VECTOR2 f d", "opacity RGB f d"})) +
        kRed + plane);
    EXPECT_NEAR(picture.color("Z", 0).r, 5 - 0.225, 1e-3);
    const Color n = picture.color("N", 0), p = picture.color("P", 0);
    EXPECT_NEAR(n.r, -0.6, 1e-5);
    EXPECT_NEAR(n.g, 0.8, 1e-5);
    EXPECT_NEAR(p.r, 0.3, 1e-3);
    EXPECT_NEAR(p.g, 0.225, 1e-3);
    EXPECT_NEAR(p.b, -0.2, 1e-3);
    EXPECT_EQ(picture.color("A", 0).r, 1);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(picture.color("ID", 0).r), 12U);
    // uv of the quad: corner a is 0 0, b is 1 0, d is 0 1; a to b runs along z, a to d along x.
    const FrameLayer& uv = picture.layer("uv");
    EXPECT_NEAR(uv.pixels[0], 3.8 / 8, 1e-3);
    EXPECT_NEAR(uv.pixels[1], 4.3 / 8, 1e-3);
    EXPECT_EQ(picture.color("opacity", 0), kWhite);
}

TEST(Outputs, AskingForUvChangesNoLight) {
    // Uv are worked out only where somebody looks at them; frames of lobes must not depend on who does.
    const auto beauty = [](const std::vector<const char*>& asked) {
        const Picture picture = render(
            frame_text(12, 12, 2, ortho_camera({0, 3, 2}, {0, 0.4F, 0}, 1.5F), outputs(asked)) +
            node("standard_surface", "glossy", " specular_roughness 0.4\n coat 0.5") +
            floor("ground", 0, 3, "glossy") + sphere("ball", {0, 0.5F, 0}, 0.5F, "glossy") +
            square_light("key", 3, 1, " intensity 8"));
        return picture.layer("RGBA").pixels;
    };
    EXPECT_EQ(beauty({"RGBA RGBA f d"}), beauty({"RGBA RGBA f d", "uv VECTOR2 f d"}));
}

TEST(Outputs, DataLayersOfNothingAreZero) {
    const Picture picture = render(frame_text(
        2, 2, 2, ortho_camera({0, 2, 0}, {0, 0, 0}, 1, {0, 0, -1}),
        outputs({"RGBA RGBA f d", "Z FLOAT f d", "N VECTOR f d", "A FLOAT f d", "ID UINT f d"})));
    for (const char* layer : {"RGBA", "Z", "N", "A", "ID"})
        EXPECT_TRUE(check_black(picture, layer));
}

TEST(Outputs, TransparentSurfacesAreNotTheFirstHit) {
    const Picture picture =
        render(frame_text(2, 2, 2, ortho_camera({0, 3, 0}, {0, 0, 0}, 1, {0, 0, -1}),
                          outputs({"RGBA RGBA f d", "Z FLOAT f d"})) +
               kRed + node("standard_surface", "clear", " opacity 0 0 0") +
               floor("pane", 1, 5, "clear") + floor("plane", 0, 5, "red"));
    EXPECT_TRUE(check_constant(picture, "Z", Color::grey(3), 1e-5));
    EXPECT_TRUE(check_constant(picture, "RGBA", {1, 0, 0}, 1e-6));
    EXPECT_EQ(picture.mean_alpha("RGBA"), 1);
}

// Mistakes ---------------------------------------------------------------------------------------------------------------

/// The errors of a scene with these outputs.
std::string errors_of(const std::string& options) {
    try {
        const TestScene scene(
            frame_text(2, 2, 1, ortho_camera({0, 2, 0}, {0, 0, 0}, 1, {0, 0, -1}), options) +
            node("driver_png", "png", " filename \"a.png\"") + kRed + floor("plane", 0, 5, "red"));
        return "";
    } catch (const std::runtime_error& e) {
        return e.what();
    }
}

TEST(Mistakes, InOutputsAreErrorsBeforeTheFirstRay) {
    struct Row {
        std::vector<const char*> outputs;
        const char* says;
    };
    const std::array<Row, 10> rows{Row{{"RGBA RGBA f"}, "too few words"},
                                   {{"RGBA COLOUR f d"}, "names no type"},
                                   {{"RGBA RGBA nofilter d"}, "no filter is called \"nofilter\""},
                                   {{"RGBA RGBA f nodriver"}, "no driver is called \"nodriver\""},
                                   {{"nocam RGBA RGBA f d name"}, "no camera is called \"nocam\""},
                                   {{"difuse RGB f d"}, "diffuse"},
                                   {{"RGBA RGBA f d", "RGBA RGBA f d"}, "a layer \"RGBA\""},
                                   {{"Z RGB f d"}, "cannot be of type RGB"},
                                   {{"diffuse VECTOR f d"}, "cannot be of type VECTOR"},
                                   {{"RGBA RGBA f png", "diffuse RGB f png"}, "holds one layer"}};
    for (const Row& row : rows) {
        const std::string errors = errors_of(outputs(row.outputs));
        EXPECT_NE(errors.find(row.says), std::string::npos) << row.says << " is missing in:\n"
                                                            << errors;
    }
}

TEST(Mistakes, AreAllReportedAtOnce) {
    const std::string errors =
        errors_of(outputs({"RGBA RGBA f d", "difuse RGB f d", "emission RGB nofilter d"}) +
                  " light_path_expressions 2 1 STRING \"a C<RD\" \"b C<RX>L\"");
    for (const char* says : {"difuse", "nofilter", "C<RD", "C<RX>L"})
        EXPECT_NE(errors.find(says), std::string::npos) << says << " is missing in:\n" << errors;
}

TEST(Mistakes, InExpressionsMayBeForgiven) {
    const Picture picture =
        render(frame_text(2, 2, 1, ortho_camera({0, 2, 0}, {0, 0, 0}, 1, {0, 0, -1}),
                          outputs({"RGBA RGBA f d", "wrong RGB f d", "emission RGB f d"}) +
                              " abort_on_error off\n light_path_expressions \"wrong C<RD\"") +
               kRed + floor("plane", 0, 5, "red"));
    EXPECT_TRUE(check_black(picture, "wrong"));
    EXPECT_TRUE(check_constant(picture, "emission", {1, 0, 0}, 1e-6));
}

// Regions ----------------------------------------------------------------------------------------------------------------

TEST(Regions, AreACutOutOfTheFullFrame) {
    const std::string text = scene_file("laws_lobes.ass");
    const Picture full = render(TestScene(text, in_memory({"diffuse"}), {"caustics"}));
    RenderOptions options = in_memory({"diffuse"});
    options.region = Region{5, 7, 20, 15};
    const Picture cut = render(TestScene(text, options, {"caustics"}));
    ASSERT_EQ(cut.width(), 16);
    ASSERT_EQ(cut.height(), 9);
    for (const char* layer : {"RGBA", "diffuse"})
        for (std::size_t y = 0; y < 9; ++y)
            for (std::size_t x = 0; x < 16; ++x)
                ASSERT_EQ(cut.color(layer, y * 16 + x), full.color(layer, (y + 7) * 32 + x + 5))
                    << layer;
}

TEST(Regions, OfTheSceneMayReachOutside) {
    const Picture picture =
        render(frame_text(4, 4, 2, ortho_camera({0, 2, 0}, {0, 0, 0}, 4, {0, 0, -1}),
                          " region_min_x -2\n region_max_x 5\n region_min_y 0\n region_max_y 3") +
               kRed + floor("plane", 0, 3, "red"));
    ASSERT_EQ(picture.width(), 8);
    // The plane is 6 wide, the frame 4: overscan shows one more pixel on each side, and nothing beyond.
    EXPECT_EQ(picture.color("RGBA", 0), kBlack);
    EXPECT_EQ(picture.color("RGBA", 1), Color(1, 0, 0));
    EXPECT_EQ(picture.color("RGBA", 6), Color(1, 0, 0));
    EXPECT_EQ(picture.color("RGBA", 7), kBlack);
}

}  // namespace
}  // namespace lightsieve::testing
