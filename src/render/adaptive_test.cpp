// Adaptive sampling: samples go where noise is, means stay, nothing depends on threads or tiles; and what layers say of
// their own noise is true.
#include "render/adaptive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(BlockNoise, IsTheErrorOverTheRootOfBrightness) {
    const std::vector<PixelNoise> pixels{{4, 0.04}, {1, 0.03}};
    EXPECT_NEAR(block_noise(pixels), std::sqrt((0.01 + 0.03) / 2), 1e-12);
    EXPECT_EQ(block_noise(std::vector<PixelNoise>{{0, 0}}), 0) << "black without noise is done";
    EXPECT_EQ(block_noise(std::vector<PixelNoise>{{1, kInf}, {1, 0}}), kInf);
}

/// The numbers of samples after each round of a bucket that never has enough.
std::vector<int> rounds(int least, int most) {
    SampleSchedule schedule(8, 8, least, most, 0.01);
    std::vector<int> out{schedule.target()};
    const std::vector<PixelNoise> noisy(64, {1, 1});
    for (schedule.next_round(noisy); !schedule.finished(); schedule.next_round(noisy))
        out.push_back(schedule.target());
    return out;
}

TEST(SampleSchedule, TakesTheLeastThenByHalvesAgainUpToTheMost) {
    EXPECT_EQ(rounds(9, 9), std::vector<int>{9});
    EXPECT_EQ(rounds(9, 25), (std::vector<int>{9, 16, 24, 25}));
    EXPECT_EQ(rounds(16, 100), (std::vector<int>{16, 32, 48, 80, 100}));
    EXPECT_EQ(rounds(150, 150), (std::vector<int>{64, 128, 150})) << "large numbers in goes";
}

TEST(SampleSchedule, HalvesAreRunsOfAboutEqualNumber) {
    for (const int least : {4, 9, 16, 25, 36}) {
        const SampleSchedule schedule(8, 8, least, 400, 0.01);
        int in_half = 0;
        for (int i = 0; i < least; ++i)
            in_half += schedule.in_half(i) ? 1 : 0;
        EXPECT_NEAR(in_half, least / 2.0, least / 4.0) << least;
        EXPECT_NE(in_half, least);
    }
}

TEST(SampleSchedule, BlocksStopByThemselves) {
    // Two blocks, the second of them cut off by the bucket's edge, and noisy.
    SampleSchedule schedule(11, 8, 4, 100, 0.01);
    std::vector<PixelNoise> noise(11 * 8, {1, 0});
    noise[3 * 11 + 9].variance = 1;
    schedule.next_round(noise);
    ASSERT_FALSE(schedule.finished());
    EXPECT_EQ(schedule.n_stopped(), 64);
    EXPECT_FALSE(schedule.goes_on(7, 7));
    EXPECT_TRUE(schedule.goes_on(8, 0));
    noise[3 * 11 + 9].variance = 0;
    schedule.next_round(noise);
    EXPECT_TRUE(schedule.finished());
    EXPECT_EQ(schedule.n_stopped(), 24);
}

/// A floor half of which glows evenly, while the other half lies below a ceiling that is bright in part: noise.
std::string half_noisy(const std::string& options, int size = 48) {
    return frame_text(size, size, 3, ortho_camera({0, 0.5F, 0}, {0, 0, 0}, 1),
                      " GI_diffuse_depth 1\n GI_diffuse_samples 1\n" + options) +
           lambert("grey", 0.5F) + node("flat", "even", " color 0.5 0.5 0.5") +
           quad("lit", {-9, 0, -9}, {-9, 0, 9}, {0, 0, 9}, {0, 0, -9}, "grey") +
           quad("glows", {0, 0, -9}, {0, 0, 9}, {9, 0, 9}, {9, 0, -9}, "even") +
           node("flat", "bright", " color 4 4 4") +
           quad("ceiling", {-50, 2, -50}, {-4, 2, -50}, {-4, 2, 50}, {-50, 2, 50}, "bright");
}

const std::string kAdaptive = " enable_adaptive_sampling on\n AA_samples_max 12\n";

TEST(AdaptiveSampling, GoesWhereNoiseIsAndMovesNoMean) {
    RenderOptions options = in_memory();
    const Picture least = render(half_noisy(""), options),
                  adaptive =
                      render(half_noisy(kAdaptive + " AA_adaptive_threshold 0.05\n"), options);
    options.spp = 144;
    const Picture most = render(half_noisy(""), options);
    const std::uint64_t n = adaptive.result().samples;
    EXPECT_GT(n, least.result().samples * 2);
    EXPECT_LT(n, most.result().samples * 6 / 10) << "the even half has no noise";
    EXPECT_TRUE(check_same_mean(adaptive, "RGBA", most, "RGBA"));
    ASSERT_EQ(adaptive.result().noise.size(), 1U);
    EXPECT_LT(adaptive.result().noise[0].error, 0.6 * least.result().noise[0].error);
    // Nothing is below no noise at all: everybody gets the most. And everything is below a lot.
    const Picture all = render(half_noisy(kAdaptive + " AA_adaptive_threshold 0\n"), in_memory());
    EXPECT_TRUE(check_identical(all, "RGBA", most, "RGBA"));
    const Picture strict =
        render(half_noisy(kAdaptive + " AA_adaptive_threshold 1000\n"), in_memory());
    EXPECT_TRUE(check_identical(strict, "RGBA", least, "RGBA"));
}

TEST(AdaptiveSampling, DependsOnNeitherThreadsNorBuckets) {
    RenderOptions options = in_memory({"diffuse_indirect"});
    options.threads = 1;
    const std::string text = kAdaptive + " AA_adaptive_threshold 0.06\n";
    const Picture one = render(half_noisy(text + " bucket_size 64\n"), options);
    for (const int size : {8, 13, 32}) {
        options.threads = 2;
        const Picture other =
            render(half_noisy(text + " bucket_size " + std::to_string(size) + "\n"), options);
        EXPECT_EQ(one.result().samples, other.result().samples);
        EXPECT_TRUE(check_identical(one, "RGBA", other, "RGBA")) << size;
        EXPECT_TRUE(check_identical(one, "diffuse_indirect", other, "diffuse_indirect")) << size;
    }
}

TEST(AdaptiveSampling, LayersStillAddUp) {
    const Picture picture =
        render(half_noisy(kAdaptive), in_memory({"direct", "indirect", "emission"}));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"direct", "indirect", "emission"}));
}

TEST(AdaptiveSampling, MayGoByTheNoiseOfALayer) {
    // The emission is not noisy: nobody asks for more samples.
    const Picture least = render(half_noisy(""), in_memory({"emission", "indirect"}));
    const std::string text = kAdaptive + " AA_adaptive_threshold 0.02\n adaptive_aov \"";
    const Picture by_emission =
        render(half_noisy(text + "emission\"\n"), in_memory({"emission", "indirect"}));
    EXPECT_EQ(by_emission.result().samples, least.result().samples);
    const Picture by_indirect =
        render(half_noisy(text + "indirect\"\n"), in_memory({"emission", "indirect"}));
    EXPECT_GT(by_indirect.result().samples, 2 * least.result().samples);
}

TEST(AdaptiveSampling, OnlyMeansCanTell) {
    const std::string filters =
        node("variance_filter", "spread", "") + node("closest_filter", "one", "");
    const auto with = [&](const std::vector<const char*>& strings, const std::string& more = "") {
        return render(
            half_noisy(kAdaptive + " AA_adaptive_threshold 0.02\n" + outputs(strings) + more) +
            filters);
    };
    const std::uint64_t least = 48U * 48U * 9U;
    // The layer that adaptive_aov names is the one with a mean, wherever it stands.
    const std::uint64_t by_mean =
        with({"RGBA RGBA f d", "emission RGB f d", "emission RGB spread d e"},
             " adaptive_aov \"emission\"\n")
            .result()
            .samples;
    EXPECT_EQ(by_mean, least);
    EXPECT_GT(with({"RGBA RGBA f d", "emission RGB spread d"}).result().samples, least);
    // Nothing to go by: nobody gets more.
    EXPECT_EQ(with({"Z FLOAT one d"}).result().samples, least);
}

TEST(AdaptiveSampling, ALayerThatIsNoneIsReported) {
    const TestScene scene(half_noisy(kAdaptive + " adaptive_aov \"indrect\"\n", 8),
                          in_memory({"indirect"}), {"adaptive_aov"});
    EXPECT_NE(scene.diagnostics().render().find("did you mean \"indirect\"?"), std::string::npos)
        << scene.diagnostics().render();
}

TEST(LayerNoise, IsTheErrorThatPixelsHave) {
    // All pixels estimate the same: their spread is the error.
    const Picture picture =
        render(frame_text(64, 64, 4, ortho_camera({0.7F, 0.5F, 0.4F}, {0, 0, 0}, 1e-3F),
                          " GI_diffuse_depth 1\n GI_diffuse_samples 1\n") +
                   lambert("grey", 0.5F) + floor("ground", 0, 3, "grey") +
                   node("flat", "bright", " color 1 1 1") +
                   quad("part", {-50, 1, -50}, {30, 1, -50}, {-29, 1, 50}, {-50, 1, 50}, "bright"),
               in_memory({"indirect"}));
    const Estimate truth = estimate(picture, "indirect", 1);
    const double spread = truth.error * std::sqrt(static_cast<double>(picture.n_pixels()));
    for (const LayerNoise& layer : picture.result().noise) {
        // One pixel of 16 is looked at, 256 in all.
        EXPECT_NEAR(layer.mean, truth.mean, kZ * spread / 16) << layer.name;
        // Halves of a sequence know nothing of how well they go together: they say rather too much.
        EXPECT_GT(layer.error, 0.9 * spread) << layer.name;
        EXPECT_LT(layer.error, 2 * spread) << layer.name;
    }
    EXPECT_EQ(picture.result().noise.size(), 2U);
}

}  // namespace
}  // namespace lightsieve::testing
