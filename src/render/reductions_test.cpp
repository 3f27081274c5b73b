// Filters that are no means: farthest, variance, differences, heat.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/deep_sums.h"
#include "render/mattes.h"
#include "render/sample_spread.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

TEST(SampleSpread, IsTheVarianceOfTheSamples) {
    SampleSpread spread(0, Reduction::Variance);
    spread.begin(2);
    // 1, 3, 8 and 1e6 more: mean 4, squared distances 9 + 1 + 16 over 2.
    for (const double v : {1.0, 3.0, 8.0})
        spread.add(1, {v, v + 1e6, 2 * v, 0}, 0.5);
    const SampleSpread::Values found = spread.spread(1);
    EXPECT_DOUBLE_EQ(found[0], 13);
    EXPECT_NEAR(found[1], 13, 1e-6);
    EXPECT_DOUBLE_EQ(found[2], 52);
    EXPECT_EQ(found[3], 0);
    EXPECT_EQ(spread.spread(0)[0], 0) << "no samples";
    spread.add(0, {5, 5, 5, 5}, 1);
    EXPECT_EQ(spread.spread(0)[0], 0) << "one sample";
}

TEST(SampleSpread, LeavesOutSamplesWithoutWeight) {
    SampleSpread range(0, Reduction::Range);
    range.begin(1);
    range.add(0, {9, 0, 0, 0}, 0);
    range.add(0, {2, -1, 0, 0}, 1);
    EXPECT_EQ(range.spread(0)[0], 0);
    range.add(0, {5, -4, 0, 0}, 0.1);
    EXPECT_EQ(range.spread(0)[0], 3);
    EXPECT_EQ(range.spread(0)[1], 3);
}

TEST(SpecialSums, ComeBackFromACheckpoint) {
    const auto fill = [](auto& spread, auto& matte, auto& deep) {
        spread.begin(2);
        matte.begin(2);
        deep.begin(2);
        for (int i = 0; i < 5; ++i) {
            spread.add(1, {i * 0.5, 1, 2, 3}, 0.5);
            const std::vector<MatteHit> hits{{4, 7, 0.5F},
                                             {4, static_cast<std::uint32_t>(i), 0.25F}};
            matte.add(1, hits, 0.5);
            const std::array<double, 2> values{1.0 * i, 3};
            deep.add(1, static_cast<float>(i), Color::grey(0.1F), values, 0.5);
        }
    };
    SampleSpread spread(0, Reduction::Variance), other_spread(0, Reduction::Variance);
    MatteSums matte(4), other_matte(4);
    DeepSums deep(0, 2), other_deep(0, 2);
    fill(spread, matte, deep);
    ByteWriter out;
    spread.save(out);
    matte.save(out);
    deep.save(out);
    const std::vector<std::byte> bytes = out.take();
    other_spread.begin(2);
    other_matte.begin(2);
    other_deep.begin(2);
    ByteReader in(bytes);
    EXPECT_TRUE(other_spread.load(in) && other_matte.load(in) && other_deep.load(in) && in.done());
    EXPECT_EQ(spread.spread(1), other_spread.spread(1));
    for (std::size_t first = 0; first < 6; first += 2) {
        const auto a = matte.ranks(1, first, 0.4), b = other_matte.ranks(1, first, 0.4);
        EXPECT_EQ(a[0].id, b[0].id);
        EXPECT_EQ(a[1].coverage, b[1].coverage);
    }
    const std::vector<double> norms{0, 0.4};
    EXPECT_EQ(deep.resolve(norms).values, other_deep.resolve(norms).values);
    EXPECT_EQ(deep.resolve(norms).ends, other_deep.resolve(norms).ends);
    // Sums of another bucket do not fit.
    MatteSums small(4);
    small.begin(1);
    ByteReader again(bytes);
    EXPECT_FALSE(small.load(again));
}

std::string outputs(const std::vector<const char*>& strings) {
    std::string out = " outputs " + std::to_string(strings.size()) + " 1 STRING";
    for (const char* s : strings)
        out += std::string(" \"") + s + '"';
    return out + '\n';
}

/// Red on the left of x = 0.25, blue farther below on the right: the pixel [0,1] has a quarter and three quarters.
std::string halves(const std::string& options) {
    return frame_text(2, 1, 16, from_above(2, 4), options) + node("flat", "red", " color 2 0 0") +
           node("flat", "blue", " color 0 0 1") +
           quad("left", {-5, 1, -5}, {-5, 1, 5}, {0.25F, 1, 5}, {0.25F, 1, -5}, "red") +
           quad("right", {-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, "blue") +
           node("variance_filter", "v", " width 1 filter_weights \"box\"") +
           node("variance_filter", "y", " width 1 filter_weights \"box\" scalar_mode on") +
           node("diff_filter", "r", " width 1 filter_weights \"box\"") +
           node("closest_filter", "near", "") + node("farthest_filter", "far", "") +
           node("heatmap_filter", "hot", " width 1 filter_weights \"box\" minimum 3 maximum 4");
}

TEST(Reductions, OfAnEdge) {
    const Picture picture = render(
        halves(outputs({"RGBA RGBA f d", "RGBA RGBA v d variance", "emission RGB v d parts",
                        "RGB RGB y d luma", "RGBA RGBA r d range", "RGBA RGBA near d near",
                        "RGBA RGBA far d far", "Z FLOAT far d", "Z FLOAT v d depths",
                        "Z FLOAT hot d heat", "ID UINT far d", "emission FLOAT r d grey"})));
    // 256 samples in strata: exactly a quarter of them on red but for columns of strata at the edge.
    const double p = double{picture.color("RGBA", 1).r} / 2;
    EXPECT_NEAR(p, 0.25, 0.01);
    const double bernoulli = p * (1 - p) * 256 / 255;
    const Color variance = picture.color("variance", 1);
    EXPECT_NEAR(double{variance.r}, 4 * bernoulli, 1e-5);
    EXPECT_NEAR(double{variance.b}, bernoulli, 1e-5);
    EXPECT_TRUE(check_equal(picture, "variance", picture, "parts"));
    const double step = double{luminance({2, 0, 0}) - luminance({0, 0, 1})};
    EXPECT_NEAR(double{picture.color("luma", 1).g}, step * step * bernoulli, 1e-5);
    EXPECT_EQ(picture.color("range", 1), Color(2, 0, 1));
    EXPECT_NEAR(picture.color("grey", 1).r, std::abs(step), 1e-6);
    EXPECT_NEAR(double{picture.color("depths", 1).r}, bernoulli, 1e-4);
    EXPECT_EQ(picture.color("near", 1), Color(2, 0, 0));
    EXPECT_EQ(picture.color("far", 1), Color(0, 0, 1));
    EXPECT_NEAR(picture.color("Z", 1).r, 4, 1e-5);
    // Depth 4 - p in the mean: from blue (3) to red (4), so 3.75 is yellow.
    const double x = 4 * (1 - p);
    EXPECT_NEAR(double{picture.color("heat", 1).r}, std::clamp(x - 2, 0.0, 1.0), 1e-4);
    EXPECT_NEAR(double{picture.color("heat", 1).g}, std::clamp(4 - x, 0.0, 1.0), 1e-4);
    // The left pixel is red all over.
    EXPECT_EQ(picture.color("variance", 0), kBlack);
    EXPECT_EQ(picture.color("range", 0), kBlack);
    EXPECT_EQ(picture.color("far", 0), Color(2, 0, 0));
    EXPECT_EQ(picture.color("heat", 0), Color(0, 0, 1));
}

TEST(Reductions, LeaveThePictureAlone) {
    const Picture alone = render(halves(outputs({"RGBA RGBA f d"}))),
                  both = render(halves(outputs({"RGBA RGBA f d", "RGBA RGBA wide d variance"})) +
                                node("variance_filter", "wide", " width 3"));
    EXPECT_TRUE(check_identical(alone, "RGBA", both, "RGBA"));
    EXPECT_EQ(alone.result().rays, both.result().rays) << "a variance costs no rays";
}

TEST(Reductions, FarthestTakesNothingLast) {
    const Picture picture =
        render(frame_text(1, 1, 8, from_above(1), outputs({"RGBA RGBA far d", "Z FLOAT far d"})) +
               node("farthest_filter", "far", "") + node("flat", "red", " color 2 0 0") +
               quad("half", {0, 0, -5}, {0, 0, 5}, {5, 0, 5}, {5, 0, -5}, "red"));
    EXPECT_EQ(picture.color("RGBA", 0), Color(2, 0, 0));
    EXPECT_NEAR(picture.color("Z", 0).r, 2, 1e-5);
}

}  // namespace
}  // namespace lightsieve::testing
