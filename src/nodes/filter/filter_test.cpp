// Pixel filters: shapes at known places, and samples against them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "nodes/common/node_test_support.h"
#include "scene/pixel_filter.h"

namespace lightsieve {

NodeType node_blackman_harris_filter();
NodeType node_box_filter();
NodeType node_catrom_filter();
NodeType node_closest_filter();
NodeType node_contour_filter();
NodeType node_cryptomatte_filter();
NodeType node_diff_filter();
NodeType node_farthest_filter();
NodeType node_heatmap_filter();
NodeType node_variance_filter();
NodeType node_gaussian_filter();
NodeType node_mitnet_filter();
NodeType node_sinc_filter();
NodeType node_triangle_filter();

namespace {

/// kind  of those of a cryptomatte_filter; others have none
std::unique_ptr<PixelFilter> make(NodeType type, float width, int kind = -1) {
    TestContext context;
    TestNode node(std::move(type));
    node.set("width", width);
    if (kind >= 0) node.set_enum("filter", kind);
    return node.type().make_filter(node.block(), context);
}

struct Case {
    const char* name;
    NodeType (*type)();
    float width;
    bool is_signed;
    int kind = -1;
};

class EveryFilter : public testing::TestWithParam<Case> {
  protected:
    std::unique_ptr<PixelFilter> filter_ =
        make(GetParam().type(), GetParam().width, GetParam().kind);

    /// Integral of g over the filter's square, by the midpoint rule.
    template <class G>
    [[nodiscard]] double integrate(const G& g, int steps = 400) const {
        const double r = double{filter_->radius()}, step = 2 * r / steps;
        double sum = 0;
        for (int y = 0; y < steps; ++y) {
            for (int x = 0; x < steps; ++x)
                sum += g(Vec2f{static_cast<float>((x + 0.5) * step - r),
                               static_cast<float>((y + 0.5) * step - r)});
        }
        return sum * step * step;
    }
};

TEST_P(EveryFilter, HasADensityOfIntegralOne) {
    EXPECT_FLOAT_EQ(filter_->radius(), GetParam().width / 2);
    EXPECT_NEAR(integrate([&](Vec2f p) { return double{filter_->pdf(p)}; }), 1, 2e-3);
    EXPECT_EQ(filter_->eval({filter_->radius() * 1.01F, 0}), 0);
    EXPECT_EQ(filter_->pdf({0, filter_->radius() * -1.01F}), 0);
}

TEST_P(EveryFilter, WeighsSamplesByTheFilterOverTheDensity) {
    const double integral = integrate([&](Vec2f p) { return double{filter_->eval(p)}; });
    const float first = std::abs(filter_->sample({0.31F, 0.77F}).weight);
    for (int i = 0; i < 2000; ++i) {
        const Vec2f u{static_cast<float>(i % 50) / 50, static_cast<float>(i / 50) / 40};
        const PixelFilter::Sample s = filter_->sample(u);
        ASSERT_LE(std::abs(s.offset.x), filter_->radius());
        ASSERT_LE(std::abs(s.offset.y), filter_->radius());
        ASSERT_EQ(std::abs(s.weight), first);  // a constant, but for the sign
        const double density = double{filter_->pdf(s.offset)};
        if (density > 1e-3) {
            ASSERT_NEAR(double{s.weight}, double{filter_->eval(s.offset)} / (integral * density),
                        4e-3);
        }
    }
    if (GetParam().is_signed) {
        EXPECT_GT(first, 1);
    } else {
        EXPECT_EQ(first, 1);
    }
}

/// Pearson's test over a grid of cells. The seed is fixed: the outcome is always the same.
TEST_P(EveryFilter, SamplesFollowTheDensity) {
    constexpr int kCells = 20, kSamples = 200000, kSubsteps = 20;
    const double r = double{filter_->radius()};
    std::vector<double> expected(kCells * kCells, 0.0), counted(kCells * kCells, 0.0);
    const int steps = kCells * kSubsteps;
    for (int y = 0; y < steps; ++y) {
        for (int x = 0; x < steps; ++x) {
            const Vec2f p{static_cast<float>(((x + 0.5) / steps * 2 - 1) * r),
                          static_cast<float>(((y + 0.5) / steps * 2 - 1) * r)};
            expected[static_cast<std::size_t>(y / kSubsteps * kCells + x / kSubsteps)] +=
                double{filter_->pdf(p)};
        }
    }
    double total = 0;
    for (const double e : expected)
        total += e;
    std::mt19937 random(1234);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int i = 0; i < kSamples; ++i) {
        const Vec2f p = filter_->sample({uniform(random), uniform(random)}).offset;
        const auto cell = [&](float v) {
            return std::clamp(static_cast<int>((double{v} / r + 1) * 0.5 * kCells), 0, kCells - 1);
        };
        counted[static_cast<std::size_t>(cell(p.y) * kCells + cell(p.x))] += 1;
    }
    // Cells that expect few samples are pooled.
    double chi2 = 0, pooled_expected = 0, pooled_counted = 0;
    int degrees = -1;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double e = expected[i] / total * kSamples;
        if (e < 10) {
            pooled_expected += e;
            pooled_counted += counted[i];
            continue;
        }
        chi2 += (counted[i] - e) * (counted[i] - e) / e;
        ++degrees;
    }
    if (pooled_expected > 5) {
        chi2 += (pooled_counted - pooled_expected) * (pooled_counted - pooled_expected) /
                pooled_expected;
        ++degrees;
    }
    ASSERT_GT(degrees, 10);
    // Wilson and Hilferty 1931: the cube root of chi2/n is nearly normal. 4 sigma: a false alarm in 30,000 for a free seed.
    const double n = degrees,
                 z = (std::cbrt(chi2 / n) - (1 - 2 / (9 * n))) / std::sqrt(2 / (9 * n));
    EXPECT_LT(z, 4) << chi2 << " of " << degrees;
}

/// The mean of weight * g(offset) is the filtered g.
TEST_P(EveryFilter, FiltersAPictureWithoutBias) {
    const auto picture = [](Vec2f p) {
        return 1 + double{p.x} + 3 * double{p.x} * double{p.x} + double{p.y} * double{p.y};
    };
    const double integral = integrate([&](Vec2f p) { return double{filter_->eval(p)}; });
    const double expected =
        integrate([&](Vec2f p) { return double{filter_->eval(p)} * picture(p); }) / integral;
    // Hammersley points: the signs of the weights change along lines of u, which these points divide evenly.
    constexpr std::uint32_t kPoints = 65536;
    double sum = 0, weights = 0;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        std::uint32_t reversed = 0;
        for (int bit = 0; bit < 16; ++bit)
            reversed |= (i >> bit & 1U) << (15 - bit);
        const PixelFilter::Sample s =
            filter_->sample({(static_cast<float>(i) + 0.5F) / kPoints,
                             (static_cast<float>(reversed) + 0.5F) / kPoints});
        sum += double{s.weight} * picture(s.offset);
        weights += double{s.weight};
    }
    EXPECT_NEAR(weights / kPoints, 1, 1e-3);
    EXPECT_NEAR(sum / kPoints, expected, 8e-3 * std::max(1.0, std::abs(expected)));
}

INSTANTIATE_TEST_SUITE_P(
    Filters, EveryFilter,
    testing::Values(
        Case{"box", &node_box_filter, 1, false}, Case{"wide_box", &node_box_filter, 3, false},
        Case{"closest", &node_closest_filter, 1, false},
        Case{"gaussian", &node_gaussian_filter, 2, false},
        Case{"wide_gaussian", &node_gaussian_filter, 5, false},
        Case{"triangle", &node_triangle_filter, 2, false},
        Case{"variance", &node_variance_filter, 3, false},
        Case{"diff", &node_diff_filter, 2, false}, Case{"heatmap", &node_heatmap_filter, 2, false},
        Case{"matte_blackman_harris", &node_cryptomatte_filter, 2, false, 0},
        Case{"matte_box", &node_cryptomatte_filter, 1, false, 1},
        Case{"matte_cone", &node_cryptomatte_filter, 2, false, 2},
        Case{"matte_disk", &node_cryptomatte_filter, 3, false, 3},
        Case{"matte_gaussian", &node_cryptomatte_filter, 2, false, 4},
        Case{"matte_triangle", &node_cryptomatte_filter, 2, false, 5},
        Case{"blackman_harris", &node_blackman_harris_filter, 3, false},
        Case{"catrom", &node_catrom_filter, 4, true}, Case{"mitnet", &node_mitnet_filter, 4, true},
        Case{"sinc", &node_sinc_filter, 6, true}),
    [](const testing::TestParamInfo<Case>& filter) { return filter.param.name; });

TEST(Filters, HaveTheirShapes) {
    const auto gaussian = make(node_gaussian_filter(), 2);
    EXPECT_FLOAT_EQ(gaussian->eval({0, 0}), 1);
    EXPECT_FLOAT_EQ(gaussian->eval({0.3F, -0.4F}), std::exp(-0.5F));
    EXPECT_EQ(gaussian->eval({0.8F, 0.8F}), 0);  // round, not square
    EXPECT_FLOAT_EQ(make(node_triangle_filter(), 2)->eval({0.25F, -0.5F}), 0.75F * 0.5F);
    EXPECT_FLOAT_EQ(make(node_blackman_harris_filter(), 3)->eval({0, 0}), 1);
    const auto catrom = make(node_catrom_filter(), 4);
    EXPECT_FLOAT_EQ(catrom->eval({0, 0}), 1);
    EXPECT_NEAR(catrom->eval({1, 0}), 0, 1e-6F);
    EXPECT_FLOAT_EQ(catrom->eval({1.5F, 0}), -0.0625F);
    const auto mitnet = make(node_mitnet_filter(), 4);
    EXPECT_FLOAT_EQ(mitnet->eval({0, 0}), 64.0F / 81);
    EXPECT_FLOAT_EQ(mitnet->eval({1, 0}), 8.0F / 9 / 18);
    EXPECT_NEAR(make(node_sinc_filter(), 6)->eval({2, 0}), 0, 1e-6F);
    EXPECT_EQ(gaussian->reduction(), Reduction::Mean);
    EXPECT_EQ(make(node_closest_filter(), 1)->reduction(), Reduction::Closest);
    EXPECT_EQ(make(node_farthest_filter(), 1)->reduction(), Reduction::Farthest);
    EXPECT_EQ(make(node_variance_filter(), 3)->reduction(), Reduction::Variance);
    EXPECT_EQ(make(node_diff_filter(), 2)->reduction(), Reduction::Range);
}

TEST(Filters, ShowHeatFromBlueToRed) {
    TestContext context;
    TestNode node(node_heatmap_filter());
    node.set("minimum", 2.0F).set("maximum", 6.0F);
    const auto filter = node.type().make_filter(node.block(), context);
    EXPECT_TRUE(filter->shows_heat());
    EXPECT_EQ(filter->heat(1), Color(0, 0, 1));
    EXPECT_EQ(filter->heat(2), Color(0, 0, 1));
    EXPECT_EQ(filter->heat(3), Color(0, 1, 1));
    EXPECT_EQ(filter->heat(4), Color(0, 1, 0));
    EXPECT_EQ(filter->heat(5), Color(1, 1, 0));
    EXPECT_EQ(filter->heat(6.5F), Color(1, 0, 0));
    node.set("maximum", 2.0F);
    const auto step = node.type().make_filter(node.block(), context);
    EXPECT_EQ(step->heat(2), Color(0, 0, 1));
    EXPECT_EQ(step->heat(2.1F), Color(1, 0, 0));
}

TEST(Filters, SayThatContoursAreMissing) {
    TestContext context;
    const TestNode node(node_contour_filter());
    EXPECT_NE(node.type().make_filter(node.block(), context), nullptr);
    EXPECT_EQ(context.count(Code::ParamPending), 1U);
}

}  // namespace
}  // namespace lightsieve
