#include "bsdf/dispersion.h"

#include <gtest/gtest.h>

namespace lightsieve {
namespace {

TEST(Dispersion, AbbeNumberIsWhatItSays) {
    for (const float ior : {1.33F, 1.5F, 1.9F})
        for (const float abbe : {20.0F, 35.0F, 64.0F}) {
            const float f = dispersed_ior(ior, abbe, kLineF), c = dispersed_ior(ior, abbe, kLineC);
            EXPECT_FLOAT_EQ(dispersed_ior(ior, abbe, kLineD), ior);
            EXPECT_NEAR((ior - 1) / (f - c), abbe, 1e-2F);
        }
}

TEST(Dispersion, NoneWithoutAnAbbeNumber) {
    for (const float abbe : {0.0F, -3.0F, std::nanf("")})
        EXPECT_EQ(dispersed_ior(1.5F, abbe, 450), 1.5F);
    EXPECT_NEAR(dispersed_ior(1.5F, 1e9F, 400), 1.5F, 1e-6F);
}

TEST(Dispersion, WavelengthsAreWhiteTogether) {
    constexpr int kSteps = 1 << 16;
    double r = 0, g = 0, b = 0;
    float last = 1e9F;
    for (int i = 0; i < kSteps; ++i) {
        const Wavelength w = sample_wavelength((static_cast<float>(i) + 0.5F) / kSteps);
        ASSERT_LT(w.nm, last) << "red first";
        last = w.nm;
        ASSERT_TRUE(w.nm > 400 && w.nm < 710);
        for (int c = 0; c < 3; ++c)
            ASSERT_TRUE(w.weight[c] >= 0 && w.weight[c] <= 3.0001F);
        r += static_cast<double>(w.weight.r), g += static_cast<double>(w.weight.g),
            b += static_cast<double>(w.weight.b);
    }
    EXPECT_NEAR(r / kSteps, 1, 1e-4);
    EXPECT_NEAR(g / kSteps, 1, 1e-4);
    EXPECT_NEAR(b / kSteps, 1, 1e-4);
}

TEST(Dispersion, ColoursOfTheRainbowInOrder) {
    const auto color = [](float nm) {
        Wavelength best = sample_wavelength(0);
        for (int i = 0; i < 4096; ++i)
            if (const Wavelength w = sample_wavelength(static_cast<float>(i) / 4096);
                std::abs(w.nm - nm) < std::abs(best.nm - nm))
                best = w;
        return best.weight;
    };
    const Color red = color(640), green = color(535), blue = color(455);
    EXPECT_TRUE(red.r > 2 * red.g && red.r > 10 * red.b);
    EXPECT_TRUE(green.g > 2 * green.r && green.g > 2 * green.b);
    EXPECT_TRUE(blue.b > 5 * blue.r && blue.b > 5 * blue.g);
    EXPECT_EQ(sample_wavelength(0).nm, 1e9F / 1.43e6F);
    EXPECT_GT(sample_wavelength(0x1.fffffep-1F).nm, 400);
}

}  // namespace
}  // namespace lightsieve
