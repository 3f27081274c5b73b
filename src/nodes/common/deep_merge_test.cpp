// Deep samples: composited again they are what came, and few where few will do.
#include "nodes/common/deep_merge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightsieve {
namespace {

/// What a compositing program makes of a pixel: every sample over what is behind it.
struct Flat {
    double alpha = 0, value = 0;
};
Flat flatten(const DeepRun& run) {
    Flat out;
    for (std::size_t i = 0; i < run.front.size(); ++i) {
        out.value += (1 - out.alpha) * double{run.values[i]};
        out.alpha += (1 - out.alpha) * double{run.alpha[i]};
    }
    return out;
}

/// Samples of one value each.
struct Samples {
    std::vector<float> depths;
    std::vector<Color> opacities;
    std::vector<float> values;
    void add(float depth, float opacity, float value) {
        depths.push_back(depth);
        opacities.push_back(Color::grey(opacity));
        values.push_back(value);
    }
    [[nodiscard]] DeepRun merged(const DeepTolerance& tolerance) const {
        return merge_deep(depths, opacities, values, 1, tolerance);
    }
};

TEST(DeepMerge, GivesTheFlatPixelBack) {
    Samples samples;
    samples.add(3, 0.5F, 4);
    samples.add(1, 0.25F, 1);
    samples.add(1e30F, 0, 0.125F);
    const DeepRun run = samples.merged({});
    ASSERT_EQ(run.front, (std::vector<float>{1, 3, 1e30F}));
    EXPECT_FLOAT_EQ(run.alpha[0], 0.25F);
    EXPECT_FLOAT_EQ(run.alpha[1], 0.5F / 0.75F) << "of what the first lets through";
    EXPECT_FLOAT_EQ(run.values[1], 4 / 0.75F);
    EXPECT_NEAR(flatten(run).alpha, 0.75, 1e-6);
    EXPECT_NEAR(flatten(run).value, 5.125, 1e-6);
}

TEST(DeepMerge, MergesOneSurfaceIntoOneSample) {
    Samples samples;
    for (int i = 0; i < 64; ++i)
        samples.add(2 + 1e-4F * static_cast<float>(i % 8), 1.0F / 64, 0.5F / 64);
    EXPECT_EQ(samples.merged({}).front.size(), 1U);
    EXPECT_NEAR(samples.merged({}).back[0], 2.0007F, 1e-6);
    EXPECT_NEAR(flatten(samples.merged({})).alpha, 1, 1e-5);
    DeepTolerance none;
    none.merge = false;
    EXPECT_EQ(samples.merged(none).front.size(), 8U) << "samples of one depth are one";
}

TEST(DeepMerge, KeepsSlopesAsOneAndStepsApart) {
    // A slope: opacity grows evenly from depth 1 to 2. Then nothing, then a wall at 5.
    Samples samples;
    for (int i = 0; i <= 50; ++i)
        samples.add(1 + static_cast<float>(i) / 50, 0.5F / 51, 0);
    samples.add(5, 0.5F, 1);
    DeepTolerance tolerance;
    const DeepRun run = samples.merged(tolerance);
    ASSERT_EQ(run.front.size(), 2U);
    EXPECT_FLOAT_EQ(run.back[0], 2);
    EXPECT_FLOAT_EQ(run.front[1], 5);
    tolerance.alpha = -1;
    EXPECT_EQ(samples.merged(tolerance).front.size(), 1U) << "nothing keeps them apart";
    tolerance.alpha = 0;
    EXPECT_GT(samples.merged(tolerance).front.size(), 10U);
}

TEST(DeepMerge, LooksAtValuesWhereAskedTo) {
    Samples samples;
    for (int i = 0; i <= 20; ++i)
        samples.add(1 + 0.1F * static_cast<float>(i), 0.005F, i == 10 ? 1.0F : 0.0F);
    DeepTolerance tolerance;
    EXPECT_EQ(samples.merged(tolerance).front.size(), 1U);
    const std::vector<float> strict{0.01F};
    tolerance.values = strict;
    EXPECT_GE(samples.merged(tolerance).front.size(), 2U);
}

TEST(DeepMerge, HidesNothingBehindWhatIsOpaque) {
    Samples samples;
    samples.add(1, 1, 2);
    samples.add(4, 0.2F, 3);  // noise: more than all is hidden
    const DeepRun run = samples.merged({});
    ASSERT_EQ(run.front.size(), 1U);
    EXPECT_FLOAT_EQ(run.alpha[0], 1);
    EXPECT_NEAR(flatten(run).value, 5, 1e-6) << "light is kept";
    EXPECT_TRUE(Samples().merged({}).front.empty());
}

TEST(DeepMerge, StaysFiniteWhateverComes) {
    Samples samples;
    samples.add(1, -0.5F, -1);
    samples.add(2, 3, 1e30F);
    samples.add(2, 0, 0);
    samples.add(1e30F, 1, 1);
    const DeepRun run = samples.merged({});
    for (std::size_t i = 0; i < run.front.size(); ++i) {
        EXPECT_TRUE(std::isfinite(run.alpha[i]) && std::isfinite(run.values[i]));
        EXPECT_GE(run.alpha[i], 0);
        EXPECT_LE(run.alpha[i], 1);
    }
}

}  // namespace
}  // namespace lightsieve
