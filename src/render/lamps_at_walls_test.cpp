// Lamps in walls shine; lamps behind walls do not, however thin the gap beside the distance.
#include <gtest/gtest.h>
#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A black ceiling at height 0 seen from below, with a lamp `gap` behind it.
std::string lamp_behind(float gap, float distance, std::string_view more) {
    return frame_text(8, 8, 2, ortho_camera({0, -distance, 0}, {0, 0, 0}, 1, {0, 0, 1})) +
           node("flat", "black", " color 0 0 0") + floor("ceiling", 0, 50, "black") +
           square_light("key", gap, 5, " intensity 1e4\n camera 1\n" + std::string(more));
}
TEST(LampsAtWalls, ALampBehindAWallIsHiddenFromTheCamera) {
    for (const float distance : {10.0F, 1000.0F})
        for (const float gap : {0.005F, 0.05F})
            EXPECT_TRUE(check_black(render(lamp_behind(gap, distance, "")), "RGBA"))
                << distance << ' ' << gap;
}
TEST(LampsAtWalls, ALampBehindAWallLightsNothing) {
    // The floor is 100 below; the lamp 5 mm above the ceiling.
    const std::string scene =
        frame_text(8, 8, 2, ortho_camera({30, -99, 0}, {0, -100, 0}, 1, {0, 0, 1}),
                   " low_light_threshold 0") +
        node("flat", "black", " color 0 0 0") + lambert("grey", 0.5F) +
        floor("ceiling", 0, 500, "black") + floor("ground", -100, 500, "grey") +
        square_light("key", 0.005F, 5, " intensity 1e6");
    EXPECT_TRUE(check_black(render(scene), "RGBA"));
}
/// A room far from the origin, lit by a lamp in its ceiling; the picture shows the floor up to shallow angles.
Picture lit_room(float gap) {
    const Vec3f o{53.1F, 2.7F, 31.7F};
    const float h = 0.5F, y = o.y + gap;
    const auto at = [&](float x, float z) { return text_of(Vec3f{o.x + x, y, o.z + z}); };
    const std::string lamp = node("quad_light", "key",
                                  " vertices 4 1 VECTOR " + at(-h, -h) + "  " + at(h, -h) + "  " +
                                      at(h, h) + "  " + at(-h, h) + "\n intensity 100");
    const auto square = [&](std::string_view name, float level, std::string_view shader, bool up) {
        const float r = 60;
        const Vec3f a{o.x - r, level, o.z - r}, b{o.x - r, level, o.z + r},
            c{o.x + r, level, o.z + r}, d{o.x + r, level, o.z - r};
        return up ? quad(name, a, b, c, d, shader) : quad(name, a, d, c, b, shader);
    };
    return render(
        frame_text(64, 8, 4, ortho_camera({o.x + 25, 2, o.z}, {o.x + 25, 0, o.z}, 50, {0, 0, -1}),
                   " low_light_threshold 0") +
            lambert("grey", 0.5F) + square("ceiling", o.y, "grey", false) +
            square("ground", 0, "grey", true) + lamp,
        in_memory({"direct"}));
}
TEST(LampsAtWalls, ALampInTheWallShinesAsOneBeforeIt) {
    const Picture in = lit_room(0), before = lit_room(-1e-3F);
    double worst = 0;
    for (std::size_t i = 0; i < in.n_pixels(); ++i) {
        const double a = static_cast<double>(in.color("direct", i).g),
                     b = static_cast<double>(before.color("direct", i).g);
        worst = std::max(worst, std::abs(a - b) / b);
    }
    EXPECT_LT(worst, 0.02);
}
}  // namespace
}  // namespace lightsieve::testing
