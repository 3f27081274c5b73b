// Diagnostics, matrices, sampling: the things that everything else leans on.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/diagnostics.h"
#include "core/float4.h"
#include "core/matrix.h"
#include "core/parallel.h"
#include "core/sampling.h"
#include "core/sobol.h"

namespace lightsieve {
namespace {

TEST(Diagnostics, RendersPlaceCaretAndHint) {
    const auto source = std::make_shared<const SourceText>(
        SourceText{"shot.ass", "lambert\n{\n base_colour 1 0 0\n}\n"});
    const Error error{Code::FileFormat,
                      "no parameter \"base_colour\"",
                      {source, 11, 11},
                      "did you mean \"base_color\"?",
                      {{"node starts here", {source, 0, 7}}},
                      Severity::Warning};
    EXPECT_EQ(error.render(),
              "shot.ass:3:2: warning[file-format]: no parameter \"base_colour\"\n"
              "    3 |  base_colour 1 0 0\n"
              "      |  ^~~~~~~~~~~\n"
              "  hint: did you mean \"base_color\"?\n"
              "  note: node starts here at shot.ass:1:1");
}

TEST(Diagnostics, CountsColumnsInCharacters) {
    const auto source = std::make_shared<const SourceText>(SourceText{"e", "\xc3\xa4\xc3\xb6x"});
    EXPECT_EQ((SourceSpan{source, 4, 1}.line_column().column), 3U);
}

TEST(Diagnostics, PlaceAtEndOfFile) {
    const auto source = std::make_shared<const SourceText>(SourceText{"e", "ab\n"});
    const SourceSpan end{source, 3, 0};
    EXPECT_EQ(end.line_column().line, 2U);
    EXPECT_EQ(end.line(), "");
}

TEST(Diagnostics, NearestNames) {
    EXPECT_EQ(did_you_mean("base_colour", {"base", "base_color", "coat_color"}),
              "did you mean \"base_color\"?");
    EXPECT_EQ(did_you_mean("zzz", {"base", "base_color"}), "");
    EXPECT_EQ(nearest_names("caot", {"coat", "sheen"}).front(), "coat");
}

TEST(Diagnostics, SameReportOnce) {
    Diagnostics diagnostics;
    diagnostics.warning(Code::FileFormat, "x");
    diagnostics.warning(Code::FileFormat, "x");
    EXPECT_EQ(diagnostics.n_warnings(), 1U);
}

TEST(Frames, LevelOnesAreOrthonormalAndLevel) {
    for (int i = 0; i <= 40; ++i)
        for (int k = 0; k < 40; ++k) {
            const float theta = kPi * static_cast<float>(i) / 40,
                        phi = 2 * kPi * static_cast<float>(k) / 40;
            const Vec3f n{std::sin(theta) * std::sin(phi), std::cos(theta),
                          std::sin(theta) * std::cos(phi)};
            const Frame f = Frame::from_z_level(n);
            EXPECT_NEAR(f.x.y, 0, 1e-6F);
            EXPECT_NEAR(length(f.x), 1, 2e-6F);
            EXPECT_NEAR(length(f.y - cross(f.z, f.x)), 0, 2e-6F);
            EXPECT_NEAR(dot(f.x, f.z), 0, 2e-6F);
        }
    const Frame up = Frame::from_z_level({0, 1, 0}), down = Frame::from_z_level({0, -1, 0});
    EXPECT_EQ(up.y, cross(up.z, up.x));
    EXPECT_EQ(down.y, cross(down.z, down.x));
}

TEST(Colors, BlackAndFiniteAreAskedOfEveryChannel) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    for (int channel = 0; channel < 3; ++channel) {
        const auto with = [&](float v) {
            Color c;
            c[channel] = v;
            return c;
        };
        for (const float v : {1.0F, -1.0F, 1.2e-38F, kInfinity, -kInfinity, kNan})
            EXPECT_FALSE(is_black(with(v))) << v << " in channel " << channel;
        for (const float v : {0.0F, -0.0F, 1e-40F, -1e-40F})
            EXPECT_TRUE(is_black(with(v))) << v << " in channel " << channel;
        for (const float v : {kInfinity, -kInfinity, kNan})
            EXPECT_FALSE(is_finite(with(v))) << v << " in channel " << channel;
        for (const float v : {0.0F, -1e-40F, 3e38F, -3e38F})
            EXPECT_TRUE(is_finite(with(v))) << v << " in channel " << channel;
    }
    EXPECT_TRUE(is_finite(Color(3e38F, 3e38F, 3e38F)));
    EXPECT_FALSE(is_finite(Color(kInfinity, -kInfinity, 0)));
}

TEST(Sampling, DiscIsTheMapOfShirleyAndChiu) {
    for (int i = 0; i <= 32; ++i)
        for (int k = 0; k <= 32; ++k) {
            const Vec2f u{static_cast<float>(i) / 32, static_cast<float>(k) / 32};
            // Squares go to circles: the radius is the larger coordinate, the angle goes evenly along the side.
            const double x = 2.0 * i / 32 - 1, y = 2.0 * k / 32 - 1;
            const bool wide = std::abs(x) > std::abs(y);
            const double r = wide ? x : y, quarter = std::acos(-1.0) / 4;
            const double angle =
                wide ? quarter * y / x : (y == 0 ? 0 : 2 * quarter - quarter * x / y);
            const Vec2f d = sample_concentric_disk(u);
            EXPECT_NEAR(d.x, r * std::cos(angle), 1.2e-7);
            EXPECT_NEAR(d.y, r * std::sin(angle), 1.2e-7);
        }
}

TEST(Float4, LanesAreWhatFloatsWouldBe) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const Float4 a{1, kNan, -0.0F, 9}, b{2, 5, 3, kNan};
    const Float4 most = larger(a, b), least = smaller(a, b), roots = root(all(2)),
                 sizes = magnitude(Float4{-1, -0.0F, 2, -kInfinity});
    for (int i = 0; i < 4; ++i) {
        const float larger_one = a[i] > b[i] ? a[i] : b[i],
                    smaller_one = a[i] < b[i] ? a[i] : b[i];
        EXPECT_TRUE(most[i] == larger_one || (std::isnan(most[i]) && std::isnan(larger_one))) << i;
        EXPECT_TRUE(least[i] == smaller_one || (std::isnan(least[i]) && std::isnan(smaller_one)))
            << i;
        EXPECT_EQ(roots[i], std::sqrt(2.0F));
    }
    EXPECT_EQ(sizes[0], 1);
    EXPECT_FALSE(std::signbit(sizes[1]));
    EXPECT_EQ(sizes[3], kInfinity);
    // Rounded pairs first.
    EXPECT_EQ(sum_of(Float4{0x1p24F, 1, -0x1p24F, 1}), (0x1p24F + 1) + (-0x1p24F + 1));
    for (int i = 0; i < 4; ++i) {
        Float4 one{};
        one[i] = 1;
        EXPECT_TRUE(any(one > 0)) << i;
    }
    EXPECT_FALSE(any(all(kNan) > 0));
}

TEST(Matrix, RowVectorsAndInverse) {
    const Mat4f m = Mat4f::scale({2, 3, 4}) * Mat4f::translation({1, 2, 3});
    EXPECT_EQ(m.point({1, 1, 1}), (Vec3f{3, 5, 7}));
    bool ok = false;
    const Mat4f inverse = m.inverse(&ok);
    ASSERT_TRUE(ok);
    EXPECT_EQ(inverse.point({3, 5, 7}), (Vec3f{1, 1, 1}));
    (void)Mat4f::scale({0, 1, 1}).inverse(&ok);
    EXPECT_FALSE(ok);
}

TEST(Sobol, FirstPowersOfTwoAreStratified) {
    // A (0,2)-sequence puts one of the first 16 points into each elementary interval 4x4, 2x8, 16x1.
    for (std::uint32_t pair : {0U, 5U}) {
        std::set<int> cells, columns, slabs;
        for (std::uint32_t i = 0; i < 16; ++i) {
            const Vec2f p = Sampler(3, 7, i, 1).at2(pair);
            cells.insert(static_cast<int>(p.x * 4) * 4 + static_cast<int>(p.y * 4));
            columns.insert(static_cast<int>(p.x * 16));
            slabs.insert(static_cast<int>(p.x * 2) * 8 + static_cast<int>(p.y * 8));
        }
        EXPECT_EQ(cells.size(), 16U);
        EXPECT_EQ(columns.size(), 16U);
        EXPECT_EQ(slabs.size(), 16U);
    }
}

TEST(Sobol, PixelsAndPairsDiffer) {
    EXPECT_NE(Sampler(0, 0, 0, 1).at2(0), Sampler(1, 0, 0, 1).at2(0));
    EXPECT_NE(Sampler(0, 0, 0, 1).at2(0), Sampler(0, 0, 0, 2).at2(0));
    EXPECT_NE(Sampler(0, 0, 0, 1).at2(0), Sampler(0, 0, 0, 1).at2(1));
}

TEST(Sobol, FourPairsAtOnceAreTheSame) {
    for (std::uint32_t i = 0; i < 100; ++i) {
        const Sampler sampler(i * 7, 11, i * i, 3);
        const std::array<Vec2f, 4> four = sampler.at2x4(i);
        for (std::uint32_t k = 0; k < 4; ++k)
            EXPECT_EQ(four[k], sampler.at2(i + k)) << i;
    }
}

TEST(Distribution, SamplesMatchDensities) {
    const std::vector<float> values{1, 0, 3, 4};
    const Distribution1D d{values};
    std::vector<int> counts(4);
    for (int i = 0; i < 8000; ++i) {
        const auto s = d.sample((static_cast<float>(i) + 0.5F) / 8000);
        ++counts[s.index];
        EXPECT_EQ(s.pdf, d.pdf(s.index));
    }
    EXPECT_EQ(counts, (std::vector<int>{1000, 0, 3000, 4000}));
    EXPECT_FLOAT_EQ(d.integral(), 2);
}

TEST(Distribution, TwoDimensional) {
    const std::vector<float> values{0, 1, 2, 1};
    const Distribution2D d(values, 2, 2);
    EXPECT_FLOAT_EQ(d.pdf({0.75F, 0.25F}), 1);
    EXPECT_FLOAT_EQ(d.pdf({0.25F, 0.75F}), 2);
    EXPECT_FLOAT_EQ(d.pdf({0.25F, 0.25F}), 0);
    const auto s = d.sample({0.1F, 0.9F});
    EXPECT_FLOAT_EQ(s.pdf, d.pdf(s.uv));
}

TEST(Parallel, EveryItemOnceAndErrorsArrive) {
    std::vector<int> hits(1000);
    parallel_for(1000, 2, [&](std::size_t i) { ++hits[i]; });
    EXPECT_EQ(hits, std::vector<int>(1000, 1));
    EXPECT_THROW(parallel_for(10, 2,
                              [](std::size_t i) {
                                  if (i == 3) throw InputError({Code::FileFormat, "x"});
                              }),
                 InputError);
}

}  // namespace
}  // namespace lightsieve
