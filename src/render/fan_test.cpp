// Where a path splits: means stay, noise falls as GI_*_samples and light samples say, and the number of rays has bounds.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

std::string gi_samples(int n) {
    std::string out;
    for (const char* kind : {"diffuse", "specular", "transmission", "sss", "volume"})
        out += std::string(" GI_") + kind + "_samples " + std::to_string(n) + '\n';
    return out;
}

/// The same file with other numbers of samples in its options.
std::string with_samples(std::string text, int n) {
    text.insert(text.find("AA_samples"), gi_samples(n).substr(1) + ' ');
    return text;
}

/// Variance of a pixel, for pictures whose pixels all estimate the same.
double variance(const Picture& picture, const std::string& layer) {
    const double error = estimate(picture, layer, 1).error;
    return error * error * static_cast<double>(picture.n_pixels());
}

class SplitScenes : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Files, SplitScenes,
                         ::testing::Values("laws_lobes.ass", "laws_media.ass", "laws_room.ass"));

TEST_P(SplitScenes, SplittingMovesNoMean) {
    const std::vector<std::string> aovs{"diffuse_direct",    "diffuse_indirect", "specular_direct",
                                        "specular_indirect", "transmission",     "volume"};
    RenderOptions options = in_memory(aovs);
    options.spp = 16;
    const std::string text = scene_file(GetParam());
    const Picture one = render(with_samples(text, 1), options),
                  nine = render(with_samples(text, 3), options);
    EXPECT_FALSE(check_identical(one, "RGBA", nine, "RGBA")) << "splitting must have acted";
    EXPECT_TRUE(check_same_mean(one, "RGBA", nine, "RGBA"));
    for (const std::string& aov : aovs)
        EXPECT_TRUE(check_same_mean(one, aov, nine, aov)) << aov;
}

/// A point of a floor below a ceiling whose halves glow unlike.
std::string under_glowing_halves(const std::string& options) {
    return frame_text(32, 32, 1, ortho_camera({0.7F, 0.5F, 0.4F}, {0, 0, 0}, 1e-3F),
                      " GI_diffuse_depth 1\n" + options) +
           lambert("grey", 0.5F) + floor("ground", 0, 3, "grey") +
           node("flat", "bright", " color 1 1 1") +
           quad("half", {-50, 1, -50}, {0, 1, -50}, {0, 1, 50}, {-50, 1, 50}, "bright");
}

TEST(Splitting, NoiseOfIndirectLightFallsWithTheRays) {
    const Picture one = render(under_glowing_halves(gi_samples(1))),
                  nine = render(under_glowing_halves(gi_samples(3)));
    EXPECT_TRUE(check_same_mean(one, "RGBA", nine, "RGBA"));
    // Nine rays each: a ninth, or less where they are well spread. Four standard errors of a variance of 1024 pixels: 18 %.
    EXPECT_LT(variance(nine, "RGBA"), variance(one, "RGBA") / 9 * 1.2);
}

TEST(Splitting, NoiseOfLightsFallsWithTheirSamples) {
    // A blocker hides half of a lamp.
    const auto lit = [](int samples) {
        return render(
            frame_text(32, 32, 1, ortho_camera({0.7F, 0.5F, 0.4F}, {0, 0, 0}, 1e-3F)) +
            lambert("grey", 0.5F) + floor("ground", 0, 3, "grey") +
            quad("blocker", {-5, 1, -5}, {0, 1, -5}, {0, 1, 5}, {-5, 1, 5}, "grey") +
            node("quad_light", "lamp",
                 " vertices 4 1 VECTOR -1 2 -1  1 2 -1  1 2 1  -1 2 1\n intensity 20\n samples " +
                     std::to_string(samples)));
    };
    const Picture one = lit(1), nine = lit(3);
    ASSERT_TRUE(check_lit(one, "RGBA"));
    EXPECT_TRUE(check_same_mean(one, "RGBA", nine, "RGBA"));
    EXPECT_LT(variance(nine, "RGBA"), variance(one, "RGBA") / 5);
}

TEST(Splitting, EveryLightIsAskedWhereThereAreFew) {
    // Point lights without anything in their way leave nothing to chance.
    std::string text = frame_text(8, 8, 1, ortho_camera({0.7F, 0.5F, 0.4F}, {0, 0, 0}, 1e-3F),
                                  " low_light_threshold 0") +
                       lambert("grey", 0.5F) + floor("ground", 0, 3, "grey");
    for (int i = 0; i < 5; ++i)
        text += node("point_light", "lamp" + std::to_string(i),
                     " position 0 " + std::to_string(i + 1) + " 0");
    const Picture picture = render(text);
    double irradiance = 0;
    for (int i = 1; i <= 5; ++i)
        irradiance += 1.0 / (i * i);
    EXPECT_TRUE(check_constant(picture, "RGBA",
                               Color::grey(static_cast<float>(0.5 / kPi * irradiance)), 1e-4));
}

TEST(Splitting, NoSamplesIsNoIndirectLight) {
    EXPECT_TRUE(check_black(render(under_glowing_halves(" GI_diffuse_samples 0")), "RGBA"));
    // Lights need no such rays.
    const Picture lit = render(under_glowing_halves(" GI_diffuse_samples 0") +
                               node("distant_light", "sun", " direction -1 -1 0"));
    EXPECT_TRUE(check_constant(lit, "RGBA", Color::grey(0.5F / kPi * std::sqrt(0.5F)), 1e-4));
}

/// A point of a glossy floor.
std::string glossy_point(const std::string& options) {
    return frame_text(16, 16, 1, ortho_camera({0.7F, 0.5F, 0.4F}, {0, 0, 0}, 1e-3F),
                      " low_light_threshold 0\n" + options) +
           node("standard_surface", "glossy",
                " base 0.8\n base_color 1 1 1\n specular 1\n specular_roughness 0.3") +
           floor("ground", 0, 3, "glossy");
}

TEST(Splitting, KindsHaveRaysOfTheirOwn) {
    // Rays and light samples with a cosine density, alone, are all worth the same; those of the gloss would not be.
    const std::string text =
        glossy_point(gi_samples(2)) + node("skydome_light", "sky", " intensity 1");
    const Picture picture = render(text, in_memory({"diffuse", "specular"}));
    const Estimate diffuse = estimate(picture, "diffuse", 1);
    ASSERT_TRUE(check_lit(picture, "specular"));
    EXPECT_LT(diffuse.error, 1e-4 * diffuse.mean);
}

TEST(Splitting, NoSamplesOfAKindIsNoneOfItsIndirectLightInOthersRays) {
    const std::string around =
        node("flat", "bright", " color 1 1 1") +
        quad("wall", {-50, 1, -50}, {50, 1, -50}, {50, 1, 50}, {-50, 1, 50}, "bright");
    const std::string depths = " GI_diffuse_depth 1\n GI_specular_depth 1\n";
    for (const int n : {1, 2}) {
        const Picture picture =
            render(glossy_point(depths + " GI_specular_samples 0\n GI_diffuse_samples " +
                                std::to_string(n) + '\n') +
                       around,
                   in_memory({"diffuse", "specular"}));
        EXPECT_TRUE(check_lit(picture, "diffuse"));
        EXPECT_TRUE(check_black(picture, "specular"));
    }
}

TEST(Splitting, WhatIsSeenThroughHolesIsExact) {
    // A path goes on behind every hole and scatters at it as well: opacity leaves no noise.
    const Picture picture =
        render(frame_text(8, 8, 1, ortho_camera({0.7F, 0.5F, 0.4F}, {0, 0, 0}, 1e-3F),
                          " low_light_threshold 0") +
               node("lambert", "sheet", " Kd 0\n opacity 0.25 0.5 0.75") +
               node("flat", "glow", " color 1 2 4") + floor("upper", 0.1F, 3, "sheet") +
               floor("lower", 0, 3, "glow"));
    EXPECT_TRUE(check_constant(picture, "RGBA", {0.75F, 1, 1}, 1e-6));
}

TEST(Splitting, AHallOfGlassDoesNotMakeEverMoreRays) {
    std::string text = frame_text(4, 4, 2, ortho_camera({0.2F, 9, 0.3F}, {0, 0, 0}, 1e-3F),
                                  " GI_transmission_depth 60\n GI_specular_depth 60\n "
                                  "GI_total_depth 60") +
                       node("standard_surface", "glass",
                            " transmission 1\n specular_roughness 0\n thin_walled on\n "
                            "specular_color 1 1 1\n specular_IOR 3\n caustics on") +
                       node("skydome_light", "sky", "");
    for (int i = 0; i < 20; ++i)
        text += floor("pane" + std::to_string(i), 0.2F * static_cast<float>(i), 50, "glass");
    RenderOptions options = in_memory();
    options.roulette_depth = -1;
    // 64 samples that split in two at the first pane only; each of the two meets at most 60 panes.
    EXPECT_LT(render(text, options).result().rays, std::uint64_t{64} * 2 * 61 * 2);
}

}  // namespace
}  // namespace lightsieve::testing
