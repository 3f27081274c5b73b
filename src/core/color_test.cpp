// Colour spaces: matrices against published numbers, curves, names.
#include "core/color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightsieve {
namespace {

TEST(ColorSpaceTest, Ap1ToRec709AgreesWithThePublishedMatrix) {
    // Source: ACES, "ACEScg to Rec.709 with Bradford adaptation", as OCIO configurations carry it.
    constexpr double kExpected[3][3] = {{1.7050510, -0.6217921, -0.0832589},
                                        {-0.1302564, 1.1408047, -0.0105483},
                                        {-0.0240033, -0.1289690, 1.1529723}};
    const ColorMatrix m = rgb_to_rgb(Primaries::Ap1, Primaries::Rec709);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            EXPECT_NEAR(m[i][j], kExpected[i][j], 2e-6) << i << ' ' << j;
    }
}

TEST(ColorSpaceTest, WhiteStaysWhiteBetweenAllPrimaries) {
    for (const Primaries from : {Primaries::Ap1, Primaries::Ap0, Primaries::Rec709,
                                 Primaries::Rec2020, Primaries::P3D65, Primaries::AdobeRgb}) {
        for (const auto& row : rgb_to_rgb(from, Primaries::Ap1))
            EXPECT_NEAR(row[0] + row[1] + row[2], 1, 1e-12);
    }
}

TEST(ColorSpaceTest, CurvesInvertEachOtherAndAreOdd) {
    for (const Transfer transfer :
         {Transfer::Linear, Transfer::Srgb, Transfer::Gamma18, Transfer::Gamma22}) {
        for (const float v : {0.0F, 0.002F, 0.03F, 0.18F, 0.5F, 1.0F, 7.0F, -0.25F})
            EXPECT_NEAR(decode(transfer, encode(transfer, v)), v, 4e-6F * std::max(1.0F, v));
    }
    EXPECT_NEAR(decode(Transfer::Srgb, 0.5F), 0.21404114F, 1e-6F);
    EXPECT_NEAR(encode(Transfer::Srgb, 0.18F), 0.46135613F, 1e-6F);
    EXPECT_FLOAT_EQ(decode(Transfer::Srgb, -0.5F), -decode(Transfer::Srgb, 0.5F));
    EXPECT_TRUE(std::isnan(encode(Transfer::Srgb, std::nanf(""))));
}

TEST(ColorSpaceTest, GreenOfTheRenderingSpaceIsGreenAfterClipping) {
    const Color c = ColorConversion(kRenderingSpace, kSrgb)({0, 1, 0});
    EXPECT_LT(c.r, 0);
    EXPECT_GT(c.g, 1);
    EXPECT_LT(c.b, 0);
}

TEST(ColorSpaceTest, ConversionsGoThereAndBack) {
    const Color c{0.2F, 0.7F, 0.05F};
    const Color back =
        ColorConversion(kSrgb, kRenderingSpace)(ColorConversion(kRenderingSpace, kSrgb)(c));
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(back[i], c[i], 2e-6F);
    EXPECT_TRUE(ColorConversion(kRawSpace, kSrgb).identity());
    EXPECT_TRUE(ColorConversion(kSrgb, kRawSpace).identity());
    EXPECT_TRUE(ColorConversion(kSrgb, kSrgb).identity());
}

TEST(ColorSpaceTest, NamesAreFoundWithoutRegardToCase) {
    EXPECT_EQ(find_color_space(""), kRawSpace);
    EXPECT_EQ(find_color_space("RAW"), kRawSpace);
    EXPECT_EQ(find_color_space("acescg"), kRenderingSpace);
    EXPECT_EQ(find_color_space("linear"), kRenderingSpace);
    EXPECT_EQ(find_color_space("sRGB"), kSrgb);
    EXPECT_EQ(find_color_space("sRGB - Texture"), kSrgb);
    EXPECT_EQ(find_color_space("lin_rec709"),
              (ColorSpace{Primaries::Rec709, Transfer::Linear, false}));
    EXPECT_EQ(find_color_space("Utility - sRGB - Texture"), kSrgb);
    EXPECT_EQ(find_color_space("auto"), std::nullopt);
    EXPECT_EQ(color_space_text(kSrgb), "sRGB - Texture");
    EXPECT_EQ(color_space_text(kRawSpace), "raw");
}

TEST(ColorSpaceTest, UnknownNamesWarnAndSayWhatIsAssumed) {
    Diagnostics diagnostics;
    EXPECT_EQ(ColorSpaces::built_in().resolve("auto", kSrgb, diagnostics, {}), kSrgb);
    EXPECT_EQ(diagnostics.n_warnings(), 0U);
    EXPECT_EQ(ColorSpaces::built_in().resolve("ACEScq", kRenderingSpace, diagnostics, {}),
              kRenderingSpace);
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::UnknownColorSpace);
    EXPECT_EQ(diagnostics.items()[0].message,
              "unknown colour space \"ACEScq\"; taken for \"ACEScg\"");
    EXPECT_NE(diagnostics.items()[0].hint.find("\"ACEScg\""), std::string::npos);
}

}  // namespace
}  // namespace lightsieve
