// clip_geo: what lies inside of the shape is not there, for any ray.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// Parallel rays along -z onto a square of width 4.
const std::string kFront = frame_text(32, 32, 6, ortho_camera({0, 0, 9}, {0, 0, 0}, 4)) +
                           node("flat", "white", "") + node("flat", "red", " color 1 0 0");
const std::string kBall = node("sphere", "ball", " radius 1\n shader white\n");
constexpr double kBallArea = 3.14159265 / 16;

std::string knife(Vec3f low, Vec3f high, const std::string& shader = "",
                  const std::string& more = "") {
    const auto text = [](Vec3f v) {
        return text_of(v.x) + ' ' + text_of(v.y) + ' ' + text_of(v.z);
    };
    return node("box", "knife",
                " min " + text(low) + "\n max " + text(high) + "\n shader cut\n" + more) +
           node("clip_geo", "cut", shader);
}

TEST(ClipGeo, CutsAHole) {
    const std::string wall = node("plane", "wall", " point 0 0 0\n normal 0 0 1\n shader white");
    EXPECT_NEAR(render(kFront + wall + knife({-1, -1, -1}, {1, 0, 1})).mean_alpha("RGBA"),
                1 - 2.0 / 16, 1e-3);
    // The knife itself is not seen, and cuts nothing that lies before it.
    EXPECT_EQ(render(kFront + knife({-1, -1, -1}, {1, 0, 1})).mean_alpha("RGBA"), 0);
    EXPECT_EQ(render(kFront + wall + knife({-1, -1, -2}, {1, 0, -1})).mean_alpha("RGBA"), 1);
}

TEST(ClipGeo, ShowsTheInsideOrTheFaceOfTheCut) {
    // The near half of a ball is cut off.
    const Vec3f low{-2, -2, 0}, high{2, 2, 2};
    const Picture open = render(kFront + kBall + knife(low, high));
    EXPECT_NEAR(open.mean("RGBA").g, kBallArea, 2e-3);
    const Picture closed = render(kFront + kBall + knife(low, high, " intersection red"));
    EXPECT_NEAR(closed.mean("RGBA").r, kBallArea, 2e-3);
    EXPECT_NEAR(closed.mean("RGBA").g, 0, 2e-3);
    // A quarter: half of the face is seen, and half of the ball.
    const Picture quarter = render(kFront + kBall + knife({0, -2, 0}, high, " intersection red"));
    EXPECT_NEAR(quarter.mean("RGBA").r, kBallArea, 2e-3);
    EXPECT_NEAR(quarter.mean("RGBA").g, kBallArea / 2, 2e-3);
}

TEST(ClipGeo, TraceSetsSayWhatIsCut) {
    const auto alpha = [](const std::string& ball, const std::string& cut) {
        return render(kFront + node("sphere", "ball", " radius 1\n shader white\n" + ball) +
                      knife({-2, -2, -2}, {2, 2, 2}, cut))
            .mean_alpha("RGBA");
    };
    const std::string soft = " trace_sets \"soft\"\n", in = " trace_set \"soft\"\n";
    EXPECT_EQ(alpha("", ""), 0);
    EXPECT_EQ(alpha(soft, in), 0);
    EXPECT_NEAR(alpha("", in), kBallArea, 2e-3);
    EXPECT_NEAR(alpha(soft, in + " inclusive off"), kBallArea, 2e-3);
    EXPECT_EQ(alpha("", in + " inclusive off"), 0);
}

TEST(ClipGeo, LightComesThroughTheHole) {
    const auto lit = [](const std::string& more) {
        return render(frame_text(4, 4, 4, ortho_camera({0, 1, 0}, {0, 0, 0}, 1, {0, 0, -1})) +
                      node("plane", "floor", " point 0 0 0\n normal 0 1 0\n shader grey") +
                      node("plane", "lid", " point 0 2 0\n normal 0 1 0\n shader grey") +
                      node("lambert", "grey", " Kd 1") +
                      node("distant_light", "sun", " direction 0 -1 0\n intensity 3.1415927") +
                      more)
            .mean("RGBA")
            .g;
    };
    EXPECT_EQ(lit(""), 0);
    EXPECT_NEAR(lit(knife({-1, 1.5F, -1}, {1, 2.5F, 1})), 1, 1e-3);
    // Instances cut, too, and move with their matrices.
    EXPECT_NEAR(lit(knife({-1, -0.5F, -1}, {1, 0.5F, 1}, "", " visibility 0\n") +
                    node("ginstance", "copy",
                         " node knife\n visibility 255\n matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 2 0 1")),
                1, 1e-3);
}

}  // namespace
}  // namespace lightsieve::testing
