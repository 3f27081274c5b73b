// The tables against Monte-Carlo integration of the lobes, at points that are no nodes of the tables.
#include "bsdf/albedo_table.h"

#include <gtest/gtest.h>

#include "bsdf/fresnel.h"
#include "bsdf/lobe_cases.h"

namespace lightsieve {
namespace {

constexpr float kCosines[] = {0.02F, 0.07F, 0.15F, 0.3F, 0.5F, 0.65F, 0.745F, 0.8F, 0.93F, 1.0F};
constexpr float kAlphas[] = {0.0023F, 0.012F, 0.05F, 0.13F, 0.31F, 0.62F, 0.97F};
/// Stratified samples along each axis; their own error is about 3e-4.
constexpr int kSamples = 100;

/// Mean and largest of the errors of a table.
struct Errors {
    float sum = 0, worst = 0;
    int n = 0;
    void add(float error) {
        sum += std::abs(error);
        worst = std::max(worst, std::abs(error));
        ++n;
    }
    [[nodiscard]] float mean() const { return sum / static_cast<float>(n); }
};

Errors dielectric_errors(float eta) {
    Random random(1);
    Errors errors;
    for (const float c : kCosines)
        for (const float alpha : kAlphas)
            errors.add(dielectric_albedo(c, alpha, eta) -
                       measured_albedo(DielectricReflect(GgxAlpha(alpha), eta), direction(c, 0),
                                       kSamples, random)
                           .r);
    return errors;
}

TEST(AlbedoTable, WhiteMicrofacets) {
    // A white Schlick lobe is compensated by 1 / E: what it really returns is E / table.
    Random random(1);
    for (const float c : kCosines)
        for (const float alpha : kAlphas) {
            const SchlickReflect white(GgxAlpha(alpha), kWhite, kWhite);
            EXPECT_NEAR(measured_albedo(white, direction(c, 0), kSamples, random).r, 1, 4e-3F)
                << c << " " << alpha;
        }
}

TEST(AlbedoTable, ReflectionFromOutside) {
    for (const float eta : {1.1F, 1.33F, 1.5F, 1.8F, 2.4F, 3.5F}) {
        const Errors errors = dielectric_errors(eta);
        EXPECT_LT(errors.mean(), 1.5e-3F) << eta;
        EXPECT_LT(errors.worst, 6e-3F) << eta;
    }
}

TEST(AlbedoTable, ReflectionFromInside) {
    for (const float eta : {1.1F, 1.33F, 1.5F, 1.8F, 2.4F, 3.5F}) {
        const Errors errors = dielectric_errors(1 / eta);
        EXPECT_LT(errors.mean(), 2.5e-3F) << eta;
        EXPECT_LT(errors.worst, 1.3e-2F) << eta;
    }
}

TEST(AlbedoTable, NarrowLobesTendToFresnel) {
    for (const float eta : {1.3F, 1.5F, 2.0F, 1 / 1.5F})
        for (const float c : {0.3F, 0.6F, 0.9F, 1.0F}) {
            const float exact = fresnel_dielectric(c, eta).reflectance;
            EXPECT_EQ(dielectric_albedo(c, 0, eta), exact);
            EXPECT_NEAR(dielectric_albedo(c, 1.1F * kSmoothAlpha, eta), exact, 2e-3F)
                << eta << " " << c;
        }
}

TEST(AlbedoTable, NeverOutOfRange) {
    Random random(2);
    for (int i = 0; i < 20000; ++i) {
        // Squares and cubes reach the edges; the last ones are the edges.
        const float c = i % 7 == 0 ? 1 : std::max(1e-6F, square(random.unit()) * random.unit());
        const float alpha = i % 11 == 0 ? 1 : square(random.unit());
        const float stretch =
            1 + (kMaxEta - 1) * (i % 13 == 0 ? 1 : square(square(random.unit())));
        const float eta = i % 2 == 0 ? stretch : 1 / stretch;
        const DielectricShares shares = dielectric_shares(c, alpha, eta);
        ASSERT_TRUE(shares.reflected >= 0 && shares.reflected <= 1)
            << c << " " << alpha << " " << eta;
        ASSERT_TRUE(shares.refracted >= 0 && shares.refracted <= 1.05F)
            << c << " " << alpha << " " << eta << " " << shares.refracted;
        const float e = ggx_albedo(c, alpha);
        ASSERT_TRUE(e > 0.2F && e <= 1.001F) << c << " " << alpha;
        const float sheen = sheen_albedo(c, random.between(0.07F, 1));
        ASSERT_TRUE(sheen >= 0 && sheen <= 1) << c;
    }
}

}  // namespace
}  // namespace lightsieve
