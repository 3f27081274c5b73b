// min_pixel_width: thin curves and small points are drawn wider and more transparent.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// Pixels of 1/16 along -z.
const std::string kFront =
    frame_text(16, 16, 8, ortho_camera({0, 0, 5}, {0, 0, 0}, 1)) + node("flat", "white", "");
constexpr float kPixel = 1.0F / 16;

/// Something about a tenth of a pixel wide.
struct Thin {
    const char* name;
    std::string scene;
};
std::vector<Thin> thin_things(const std::string& more) {
    const std::string radius = " shader white\n radius " + text_of(0.05F * kPixel) + '\n' + more;
    const std::string line = " points 4 1 VECTOR 0 -2 0  0 -0.5 0  0 0.5 0  0 2 0\n" + radius;
    return {{"ribbon", node("curves", "thin", " basis linear\n mode ribbon\n" + line)},
            {"tube", node("curves", "thin", " basis b-spline\n mode thick\n" + line)},
            {"disk", node("points", "thin", " points 0.01 0.01 0\n" + radius)},
            {"ball", node("points", "thin", " mode sphere\n points 0.01 0.01 0\n" + radius)}};
}

TEST(PixelWidth, WiderThingsAreAsMuchMoreTransparent) {
    const std::vector<Thin> own = thin_things(""), wide = thin_things(" min_pixel_width 1\n");
    for (std::size_t i = 0; i < own.size(); ++i) {
        // The mean of a thing so thin needs many samples, that of the wide one few.
        const std::string many = frame_text(16, 16, 64, ortho_camera({0, 0, 5}, {0, 0, 0}, 1)) +
                                 node("flat", "white", "");
        const Picture truth = render(many + own[i].scene),
                      picture = render(kFront + wide[i].scene);
        const double expected = truth.mean_alpha("RGBA");
        EXPECT_NEAR(picture.mean_alpha("RGBA"), expected, 0.03 * expected) << own[i].name;
        EXPECT_NEAR(luminance(picture.mean("RGBA")), expected, 0.03 * expected) << own[i].name;
    }
}

TEST(PixelWidth, ShadowsKeepTheirMean) {
    // A row of threads, each a quarter of its distance to the next wide, between a lamp and a wall that the camera sees.
    const auto threads = [](const std::string& more) {
        std::string points;
        for (int i = -8; i < 8; ++i) {
            const std::string x = text_of((static_cast<float>(i) + 0.5F) * kPixel);
            points += "  " + x + " -2 1  " + x + " 2 1";
        }
        return node("curves", "threads",
                    " basis linear\n mode ribbon\n visibility 254\n shader white\n num_points 2\n "
                    "radius " +
                        text_of(0.125F * kPixel) + "\n points 32 1 VECTOR" + points + '\n' + more);
    };
    const std::string wall =
        node("plane", "wall", " point 0 0 0\n normal 0 0 1\n shader grey") +
        node("lambert", "grey", " Kd 1") +
        node("distant_light", "sun", " direction 0 0 -1\n intensity 3.1415927");
    const double own = render(kFront + wall + threads("")).mean("RGBA").g;
    EXPECT_NEAR(own, 0.75, 0.01);
    EXPECT_NEAR(render(kFront + wall + threads(" min_pixel_width 0.5\n")).mean("RGBA").g, own,
                0.01);
}

}  // namespace
}  // namespace lightsieve::testing
