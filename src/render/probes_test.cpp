// Nodes that send rays of their own, and what shaders write into AOVs.
#include <gtest/gtest.h>

#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

TEST(AmbientOcclusion, OfAFloorBesideAWall) {
    // Half of the directions, weighted by the cosine, of a floor's point at the foot of an endless wall.
    const std::string corner =
        frame_text(8, 8, 4, ortho_camera({1e-3F, 5, 0}, {1e-3F, 0, 0}, 1e-3F, {0, 0, -1})) +
        floor("ground", 0, 200, "ao") +
        quad("wall", {0, -1, 200}, {0, 200, 200}, {0, 200, -200}, {0, -1, -200}, "ao");
    const auto seen = [&](const std::string& more) {
        return render(corner +
                      node("ambient_occlusion", "ao", " samples 4\n far_clip 150\n" + more))
            .mean("RGBA")
            .r;
    };
    // 64 pixels of 16 samples of 16 rays: standard deviation 0.004, less by the strata.
    EXPECT_NEAR(seen(""), 0.5, 0.02);
    EXPECT_EQ(seen(" self_only on"), 1);
    EXPECT_EQ(seen(" far_clip 1e-4"), 1);
    EXPECT_GT(seen(" falloff 1000"), 0.55F);
    EXPECT_NEAR(seen(" black 1 0 0\n white 0 0 0"), 0.5, 0.02);
}

TEST(TraceSets, ChooseWhatProbesMeet) {
    const auto seen = [&](const std::string& ao) {
        return render(frame_text(4, 4, 2, ortho_camera({0, 1, 0}, {0, 0, 0}, 0.01F, {0, 0, -1})) +
                      floor("ground", 0, 5, "ao") +
                      floor("lid", 2, 100, "ao", " trace_sets \"lids\"") +
                      node("ambient_occlusion", "ao", " samples 3\n" + ao))
            .mean("RGBA")
            .r;
    };
    EXPECT_LT(seen(""), 0.1F);
    EXPECT_LT(seen(" trace_set \"lids\""), 0.1F);
    EXPECT_EQ(seen(" trace_set \"lids\"\n inclusive off"), 1);
    EXPECT_EQ(seen(" trace_set \"others\""), 1);
}

TEST(RoundCorners, TurnNormalsNearEdges) {
    // The edge of a step: a floor that ends at x = 0 and a side that goes down from there.
    const auto normal = [&](float x) {
        return render(frame_text(4, 4, 4, ortho_camera({x, 5, 0}, {x, 0, 0}, 1e-4F, {0, 0, -1})) +
                      quad("top", {-2, 0, -2}, {-2, 0, 2}, {0, 0, 2}, {0, 0, -2}, "paint") +
                      quad("side", {0, 0, -2}, {0, 0, 2}, {0, -2, 2}, {0, -2, -2}, "paint") +
                      node("round_corners", "round", " radius 0.1\n samples 8") +
                      node("vector_to_rgb", "paint", " input round\n mode \"canonical\""))
            .mean("RGBA");
    };
    const Color at_the_edge = normal(-1e-3F), far = normal(-0.2F), near = normal(-0.05F);
    EXPECT_NEAR(at_the_edge.r, 0.5 + 0.5 * std::sqrt(0.5), 0.02) << "half way between both";
    EXPECT_NEAR(at_the_edge.g, 0.5 + 0.5 * std::sqrt(0.5), 0.02);
    EXPECT_NEAR(far.g, 1, 1e-5);
    EXPECT_GT(near.r, far.r + 0.02F);
    EXPECT_LT(near.r, at_the_edge.r);
}

TEST(Curvature, TellsEdgesFromCreases) {
    const auto seen = [&](const char* output, float y) {
        // A step down (edge) or up (crease) at x = 0.
        return render(frame_text(4, 4, 4,
                                 ortho_camera({-0.01F, 5, 0}, {-0.01F, 0, 0}, 1e-4F, {0, 0, -1})) +
                      quad("top", {-2, 0, -2}, {-2, 0, 2}, {0, 0, 2}, {0, 0, -2}, "bends") +
                      (y < 0
                           ? quad("side", {0, 0, -2}, {0, 0, 2}, {0, y, 2}, {0, y, -2}, "bends")
                           : quad("side", {0, 0, 2}, {0, y, 2}, {0, y, -2}, {0, 0, -2}, "bends")) +
                      node("curvature", "bends",
                           std::string(" radius 0.2\n samples 4\n output \"") + output + '"'))
            .mean("RGBA")
            .r;
    };
    EXPECT_GT(seen("convex", -2), 0.2F);
    EXPECT_EQ(seen("concave", -2), 0);
    EXPECT_GT(seen("concave", 2), 0.2F);
    EXPECT_EQ(seen("convex", 2), 0);
}

TEST(Wireframe, DrawsEdgesOfTrianglesOrPolygons) {
    const auto seen = [&](const std::string& wires) {
        return render(frame_text(16, 16, 4, from_above(2)) + floor("ground", 0, 1, "wires") +
                      node("wireframe", "wires", " raster_space off\n line_width 0.2\n" + wires))
            .mean("RGBA")
            .r;
    };
    // A frame of 0.1 within a square of 2, and a diagonal of width 0.2 that crosses it.
    const double frame = (4 - 1.8 * 1.8) / 4, diagonal = 0.2 * std::sqrt(2.0) * 1.8 / 4;
    EXPECT_NEAR(1 - seen(" edge_type \"polygons\""), frame, 0.02);
    EXPECT_NEAR(1 - seen(" edge_type \"triangles\""), frame + diagonal, 0.03);
}

TEST(Utility, OcclusionAndWires) {
    const auto seen = [&](const std::string& utility) {
        return render(frame_text(8, 8, 4, from_above(2, 1)) + floor("ground", 0, 1, "shows") +
                      node("flat", "black", " color 0 0 0") +
                      floor("lid", 2, 100, "black", " visibility 32") +
                      node("utility", "shows", utility))
            .mean("RGBA")
            .r;
    };
    EXPECT_LT(seen(" shade_mode \"ambocc\""), 0.1F);
    EXPECT_EQ(seen(" shade_mode \"ambocc\"\n ao_distance 1"), 1);
    EXPECT_EQ(seen(" shade_mode \"flat\""), 1);
    const float polygons = seen(" shade_mode \"flat\"\n overlay_mode \"polywire\""),
                triangles = seen(" shade_mode \"flat\"\n overlay_mode \"wire\"");
    EXPECT_LT(polygons, 1);
    EXPECT_LT(triangles, polygons);
}

TEST(WrittenAovs, HoldWhatShadersWrite) {
    const std::string scene =
        frame_text(4, 4, 2, from_above(1),
                   " outputs 4 1 STRING \"RGBA RGBA f d\" \"mask RGB f d\" \"number FLOAT f d\" "
                   "\"way VECTOR f d\"") +
        node("flat", "red", " color 1 0 0") +
        node("aov_write_rgb", "first",
             " passthrough red\n aov_input 0.1 0.2 0.3\n aov_name \"mask\"") +
        node("aov_write_float", "second",
             " passthrough first\n aov_input 7\n aov_name \"number\"") +
        node("state_vector", "p", " variable \"P\"") +
        node("aov_write_vector", "third", " passthrough second\n aov_input p\n aov_name \"way\"") +
        floor("ground", 0.5F, 5, "third");
    const Picture picture = render(scene);
    EXPECT_TRUE(check_constant(picture, "RGBA", {1, 0, 0}, 1e-6));
    EXPECT_TRUE(check_constant(picture, "mask", {0.1F, 0.2F, 0.3F}, 1e-6));
    EXPECT_TRUE(check_constant(picture, "number", Color::grey(7), 1e-5));
    EXPECT_NEAR(picture.color("way", 3).g, 0.5, 1e-5);
}

TEST(WrittenAovs, GoOnBehindTransparentSurfaces) {
    const auto seen = [](const char* blend) {
        return render(frame_text(4, 4, 8, from_above(1),
                                 " outputs 2 1 STRING \"RGBA RGBA f d\" \"mask RGB f d\"") +
                      node("lambert", "veil", " opacity 0.25 0.25 0.25") +
                      node("aov_write_rgb", "above",
                           std::string(" passthrough veil\n aov_input 1 0 0\n aov_name \"mask\"\n "
                                       "blend_opacity ") +
                               blend) +
                      node("aov_write_rgb", "below", " aov_input 0 1 0\n aov_name \"mask\"") +
                      floor("upper", 1, 5, "above") + floor("lower", 0, 5, "below"))
            .mean("mask");
    };
    EXPECT_NEAR(seen("on").r, 0.25, 1e-5);
    // Rays go on by chance: 1024 draws, standard deviation 0.0135; five of them.
    EXPECT_NEAR(seen("on").g, 0.75, 0.07);
}

TEST(WrittenAovs, ByShadersOfTheScene) {
    const Picture picture = render(
        frame_text(
            4, 4, 1, from_above(1),
            " outputs 2 1 STRING \"RGBA RGBA f d\" \"mask RGB f d\"\n aov_shaders \"writes\"") +
        node("flat", "red", " color 1 0 0") +
        node("aov_write_rgb", "writes", " aov_input 0 0 1\n aov_name \"mask\"") +
        floor("ground", 0, 5, "red"));
    EXPECT_TRUE(check_constant(picture, "mask", {0, 0, 1}, 1e-6));
    EXPECT_TRUE(check_constant(picture, "RGBA", {1, 0, 0}, 1e-6));
}

}  // namespace
}  // namespace lightsieve::testing
