// Fresnel reflectance: values known from books, limits, and the artist's parameters of metals.
#include "bsdf/fresnel.h"

#include <gtest/gtest.h>

#include "bsdf/conductor.h"
#include "bsdf/schlick.h"

namespace lightsieve {
namespace {

TEST(Fresnel, DielectricKnownValues) {
    EXPECT_NEAR(fresnel_dielectric(1, 1.5F).reflectance, 0.04F, 1e-6F);
    EXPECT_NEAR(fresnel_dielectric(1, 1 / 1.5F).reflectance, 0.04F, 1e-6F);
    EXPECT_NEAR(fresnel_dielectric_facing(1.5F), 0.04F, 1e-6F);
    EXPECT_EQ(fresnel_dielectric(0, 1.5F).reflectance, 1);
    // 60 degrees onto glass: Rs = 0.1770, Rp = 0.0018 (Hecht, Optics, section 4.6).
    EXPECT_NEAR(fresnel_dielectric(0.5F, 1.5F).reflectance, 0.0892F, 1e-4F);
    // Brewster's angle: only the perpendicular half is left, ((1 - n^2) / (1 + n^2))^2 / 2.
    const float brewster = std::cos(std::atan(1.5F));
    EXPECT_NEAR(fresnel_dielectric(brewster, 1.5F).reflectance, 0.5F * square(1.25F / 3.25F),
                1e-6F);
}

TEST(Fresnel, TotalInternalReflection) {
    const float eta = 1 / 1.5F, critical = std::sqrt(1 - eta * eta);
    EXPECT_EQ(fresnel_dielectric(critical - 1e-3F, eta).reflectance, 1);
    EXPECT_EQ(fresnel_dielectric(critical - 1e-3F, eta).cos_far, 0);
    EXPECT_LT(fresnel_dielectric(critical + 1e-3F, eta).reflectance, 0.9F);
    EXPECT_GT(fresnel_dielectric(critical + 1e-3F, eta).cos_far, 0);
}

TEST(Fresnel, SameFromBothSides) {
    for (const float c : {0.1F, 0.4F, 0.8F, 1.0F}) {
        const FresnelDielectric outside = fresnel_dielectric(c, 1.7F);
        const FresnelDielectric inside = fresnel_dielectric(outside.cos_far, 1 / 1.7F);
        EXPECT_NEAR(inside.reflectance, outside.reflectance, 1e-5F);
        EXPECT_NEAR(inside.cos_far, c, 1e-5F);
    }
}

TEST(Fresnel, MatchedIndicesReflectNothing) {
    for (const float c : {0.01F, 0.5F, 1.0F}) {
        EXPECT_EQ(fresnel_dielectric(c, 1).reflectance, 0);
        EXPECT_EQ(fresnel_dielectric(c, 1).cos_far, c);
    }
}

TEST(Fresnel, ConductorWithoutExtinctionIsDielectric) {
    for (const float c : {0.05F, 0.3F, 0.7F, 1.0F})
        EXPECT_NEAR(fresnel_conductor(c, 1.5F, 0), fresnel_dielectric(c, 1.5F).reflectance, 1e-5F);
}

TEST(Fresnel, ConductorKnownValues) {
    // Facing: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2). Gold at 650 nm: n = 0.166, k = 3.15.
    EXPECT_NEAR(fresnel_conductor(1, 0.166F, 3.15F),
                (square(0.834F) + square(3.15F)) / (square(1.166F) + square(3.15F)), 1e-5F);
    EXPECT_NEAR(fresnel_conductor(0, 0.166F, 3.15F), 1, 1e-6F);
}

TEST(Fresnel, ArtisticMetalHasTheReflectivityThatWasAskedFor) {
    for (const float r : {0.0F, 0.05F, 0.5F, 0.9F, 0.999F})
        for (const float g : {0.0F, 0.5F, 1.0F}) {
            const ConductorReflect m =
                ConductorReflect::from_artistic(GgxAlpha(0), Color::grey(r), Color::grey(g));
            EXPECT_NEAR(fresnel_conductor(1, m.n.r, m.k.r), r, 2e-4F) << r << " " << g;
        }
}

TEST(Fresnel, EdgeTintBrightensTheEdge) {
    const ConductorReflect dark =
        ConductorReflect::from_artistic(GgxAlpha(0), Color::grey(0.5F), kBlack);
    const ConductorReflect bright =
        ConductorReflect::from_artistic(GgxAlpha(0), Color::grey(0.5F), kWhite);
    EXPECT_GT(fresnel_conductor(0.2F, bright.n.r, bright.k.r),
              fresnel_conductor(0.2F, dark.n.r, dark.k.r) + 0.05F);
}

TEST(Fresnel, SchlickCurveGoesThroughItsPoints) {
    const SchlickCurve curve =
        SchlickCurve::through(Color(0.2F, 0.5F, 0.9F), Color(0.3F, 0.4F, 0.9F));
    const float near_82_degrees = SchlickCurve::kDipCos;
    EXPECT_NEAR(curve.value(1).r, 0.2F, 1e-6F);
    EXPECT_NEAR(curve.value(0).g, 1, 1e-6F);
    EXPECT_NEAR(curve.value(near_82_degrees).r, 0.3F, 1e-6F);
    EXPECT_NEAR(curve.value(near_82_degrees).g, 0.4F, 1e-6F);
}

}  // namespace
}  // namespace lightsieve
