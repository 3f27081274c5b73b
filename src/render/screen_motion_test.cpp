// The AOV motionvector: things that move by a known way over the picture, in pixels, x to the right and y up.
#include "render/screen_motion.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

constexpr int kSize = 32;
const std::string kShutter = "\n shutter_start 0\n shutter_end 1";
const std::string kMotion = "\n motion_start 0\n motion_end 1";
const std::string kGlow = node("flat", "glow", " color 1 1 1");

/// 16 units wide: a unit is two pixels.
std::string parallel(const std::string& more = kShutter) {
    return frame_text(kSize, kSize, 2,
                      node("ortho_camera", "cam",
                           " screen_window_min -8 -8\n screen_window_max 8 8" + more)) +
           kGlow;
}

std::string two_matrices(Vec3f from, Vec3f to) {
    const auto matrix = [](Vec3f p) { return " 1 0 0 0 0 1 0 0 0 0 1 0 " + text_of(p) + " 1"; };
    return "\n matrix 1 2 MATRIX" + matrix(from) + matrix(to) + kMotion;
}

std::string wall(float z, const std::string& more = "") {
    return quad("wall", {-99, -99, z}, {99, -99, z}, {99, 99, z}, {-99, 99, z}, "glow", more);
}

/// Every pixel that shows one thing alone moves by `truth`.
void expect_motion(const Picture& picture, Vec2f truth, float tolerance = 2e-3F) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
        if (picture.color("A", i).r < 1) continue;  // averages over an edge
        ++n;
        const Color seen = picture.color("motionvector", i);
        ASSERT_NEAR(seen.r, truth.x, tolerance) << "pixel " << i;
        ASSERT_NEAR(seen.g, truth.y, tolerance) << "pixel " << i;
        ASSERT_EQ(seen.b, 0);
    }
    EXPECT_GT(n, 0U);
}

Picture seen(const std::string& text) {
    return render(text, in_memory({"motionvector RGB", "A FLOAT"}));
}

TEST(MotionVector, IsTheWayOverThePictureWhileTheShutterIsOpen) {
    expect_motion(seen(parallel() + wall(-5, two_matrices({-1, 0, 0}, {2, 0.5F, 0}))), {6, 1});
    // The shutter opens for the second half of the way.
    expect_motion(seen(parallel("\n shutter_start 0.5\n shutter_end 1") +
                       wall(-5, two_matrices({-1, 0, 0}, {2, 0.5F, 0}))),
                  {3, 0.5F});
    expect_motion(seen(parallel() + wall(-5)), {0, 0}, 0);
}

TEST(MotionVector, IsThatOfTheCameraToo) {
    // A field of view of 90 degrees is ten units wide at a distance of five.
    const std::string camera =
        node("persp_camera", "cam", " fov 90" + kShutter + two_matrices({0, 0, 0}, {1, -0.5F, 0}));
    expect_motion(seen(frame_text(kSize, kSize, 2, camera) + kGlow + wall(-5)),
                  {-kSize / 10.0F, kSize / 20.0F});
}

TEST(MotionVector, FollowsEveryKindOfShapeThatChangesByItself) {
    const std::string up = " 2 VECTOR ";
    // From x = 0 to x = 1: two pixels.
    const std::array shapes{
        node("polymesh", "m",
             " nsides 1 1 UINT 4\n vidxs 4 1 UINT 0 1 2 3\n vlist 4" + up +
                 "-3 -3 -5 3 -3 -5 3 3 -5 -3 3 -5 -2 -3 -5 4 -3 -5 4 3 -5 -2 3 -5\n shader "
                 "\"glow\"" +
                 kMotion),
        node("points", "p",
             " points 1" + up + "0 0 -5 1 0 -5\n radius 3\n mode sphere\n shader \"glow\"" +
                 kMotion),
        node("curves", "c",
             " num_points 4\n points 4" + up +
                 "0 -6 -5 0 -2 -5 0 2 -5 0 6 -5 1 -6 -5 1 -2 -5 1 2 -5 1 6 -5\n radius 1\n mode "
                 "thick\n shader \"glow\"" +
                 kMotion),
        sphere("s", {0, 0, -5}, 3, "glow", two_matrices({}, {1, 0, 0})),
        node("box", "b",
             " min -2 -2 -7\n max 2 2 -5\n shader \"glow\"" + two_matrices({}, {1, 0, 0}))};
    for (const std::string& shape : shapes) {
        SCOPED_TRACE(shape);
        expect_motion(seen(parallel() + shape), {2, 0});
    }
}

TEST(MotionVector, IsThatOfOneSurfaceThroughAFilterThatKeepsOneSample) {
    // A bar before a wall, slanted so that its edges cross pixels; they move by 2 and by 6 pixels.
    const std::string text =
        frame_text(kSize, kSize, 3,
                   node("ortho_camera", "cam",
                        " screen_window_min -8 -8\n screen_window_max 8 8" + kShutter),
                   outputs({"RGBA RGBA f d", "motionvector RGB one d"})) +
        node("closest_filter", "one", "") + kGlow + wall(-5, two_matrices({}, {1, 0, 0})) +
        quad("bar", {-3, -9, -4}, {2, -9, -4}, {5, 9, -4}, {0, 9, -4}, "glow",
             two_matrices({}, {3, 0, 0}));
    const Picture picture = render(text);
    std::array<int, 2> n{};
    for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
        const float x = picture.color("motionvector", i).r;
        const bool of_bar = x > 4;
        ++n[of_bar ? 1 : 0];
        ASSERT_NEAR(x, of_bar ? 6 : 2, 2e-3) << "pixel " << i;
    }
    EXPECT_GT(n[0], 100);
    EXPECT_GT(n[1], 100);
}

// What compositors blur by themselves: a sharp picture, and vectors of what would have blurred it.
TEST(MotionVector, IsThereWithoutMotionBlurToo) {
    const std::string bar = quad("bar", {-2, -9, -4}, {2, -9, -4}, {2, 9, -4}, {-2, 9, -4}, "glow",
                                 two_matrices({-1, 0, 0}, {3, 0, 0}));
    for (const auto& [time, left] : {std::pair{"0", 10}, {"0.5", 14}, {"1", 18}}) {
        SCOPED_TRACE(time);
        std::string text = parallel() + bar;
        text.insert(text.find("options") + 9,
                    std::string(" ignore_motion_blur on\n reference_time ") + time + "\n");
        const Picture picture = seen(text);
        for (int x = 0; x < kSize; ++x)
            EXPECT_EQ(picture.color("A", static_cast<std::size_t>(x)).r,
                      x >= left && x < left + 8 ? 1 : 0)
                << "column " << x;
        expect_motion(picture, {8, 0});
        EXPECT_TRUE(check_identical(render(text), "RGBA", picture, "RGBA"));
    }
}

TEST(MotionVector, ChangesNoBitOfTheBeauty) {
    const std::string text = parallel() + wall(-5, two_matrices({-1, 0, 0}, {2, 0.5F, 0}));
    EXPECT_TRUE(check_identical(render(text), "RGBA", seen(text), "RGBA"));
}

TEST(MotionVector, SaysWhenTheShutterIsTooShortForAny) {
    const TestScene still(parallel("") + wall(-5), in_memory({"motionvector RGB"}),
                          {"the shutter opens for no time"});
    ASSERT_EQ(still.diagnostics().n_warnings(), 1U);
    EXPECT_EQ(still.diagnostics().items()[0].code, Code::OutputStill);
    std::string outside = parallel() + wall(-5);
    outside.insert(outside.find("options") + 9, " ignore_motion_blur on\n reference_time 2\n");
    const TestScene closed(outside, in_memory({"motionvector RGB"}), {"opens for no time"});
    EXPECT_NE(closed.diagnostics().items()[0].hint.find("reference_time"), std::string::npos);
}

TEST(FilmOf, UndoesTheRaysOfEveryCamera) {
    const std::array cameras{
        node("persp_camera", "cam", " fov 70"),
        node("persp_camera", "cam", " fov 2\n lens_shift 0.2 -0.1"),
        node("persp_camera", "cam",
             " fov 60\n radial_distortion 0.2\n aperture_size 0.3\n focus_distance 4"),
        node("persp_camera", "cam", " fov 50\n lens_tilt_angle 10 -20"),
        node("ortho_camera", "cam", ""),
        node("fisheye_camera", "cam", " fov 170"),
        node("cyl_camera", "cam", ""),
        node("spherical_camera", "cam", "")};
    for (const std::string& text : cameras) {
        SCOPED_TRACE(text);
        const TestScene compiled(frame_text(kSize, kSize, 1, text));
        const Camera& camera = *compiled.scene().plan.passes[0].camera;
        for (int i = 0; i < 40; ++i) {
            const float a = static_cast<float>(i) / 40, b = std::fmod(a * 13.7F, 1.0F);
            const Vec2f film{0.25F + 0.5F * a, 0.25F + 0.5F * b}, lens{b, a};
            const CameraRay ray = camera.ray(film, lens, 0);
            const Vec3f point = ray.origin + ray.direction * (1 + 9 * b);
            const Vec2f guess{film.x + 0.1F * (b - 0.5F), film.y + 0.1F * (a - 0.5F)};
            const std::optional<Vec2f> found = film_of(camera, point, lens, 0, guess);
            ASSERT_TRUE(found);
            EXPECT_NEAR(found->x, film.x, 3e-5);
            EXPECT_NEAR(found->y, film.y, 3e-5);
        }
        const CameraRay middle = camera.ray({0.5F, 0.5F}, {0.5F, 0.5F}, 0);
        if (text.find("spherical") == std::string::npos && text.find("cyl") == std::string::npos) {
            EXPECT_FALSE(film_of(camera, middle.origin - middle.direction * 5, {0.5F, 0.5F}, 0,
                                 {0.5F, 0.5F}))
                << "behind the camera";
        }
    }
}

}  // namespace
}  // namespace lightsieve::testing
