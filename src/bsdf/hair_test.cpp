// The fibre against the published model: where its lobes lie, and that nothing is lost.
#include <gtest/gtest.h>

#include <array>

#include "bsdf/fresnel.h"
#include "bsdf/lobe_cases.h"

namespace lightsieve {
namespace {

constexpr std::array kPaths{HairPath::R, HairPath::TT, HairPath::TRT, HairPath::Rest};

/// Direction by angle along the fibre and around it, counted from z toward y.
Vec3f fibre_direction(float theta, float phi) {
    return {std::sin(theta), std::cos(theta) * std::sin(phi), std::cos(theta) * std::cos(phi)};
}

/// Angles of the brightest direction of a lobe, found on a grid.
struct Angles {
    float theta = 0, phi = 0;
};
Angles brightest(const HairLobe& lobe, Vec3f wo) {
    constexpr int kSteps = 720;
    Angles best;
    float most = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const Angles a{(static_cast<float>(i) + 0.5F) * kPi / kSteps - 0.5F * kPi,
                           (static_cast<float>(j) + 0.5F) * 2 * kPi / kSteps - kPi};
            const float value = lobe.eval(wo, fibre_direction(a.theta, a.phi)).pdf;
            if (value > most) {
                most = value;
                best = a;
            }
        }
    return best;
}

TEST(Hair, PathsWithoutAbsorptionAddUpToEverything) {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const float ior = random.between(1, 2), offset = random.between(-1, 1),
                    shift = random.between(-0.2F, 0.2F);
        const Vec3f wo = direction(random.between(0.01F, 1), random.between(0, 2 * kPi));
        float sum = 0;
        for (const HairPath path : kPaths)
            sum += HairLobe(path, HairWidth(), ior, kBlack, shift, offset).albedo(wo).r;
        EXPECT_NEAR(sum, 1, 2e-6F);
    }
}

TEST(Hair, PeaksLieWhereTheModelSays) {
    // Marschner et al. 2003: around the fibre at 2 p gamma_t - 2 gamma_o + p pi, along it at minus the angle of the viewer,
    // moved by -2 alpha (to the root), alpha and 4 alpha (Chiang et al. 2016). Narrow lobes have their peak there.
    constexpr float kIor = 1.55F, kShift = 0.05F;
    constexpr float kGrid = 2 * kPi / 720;
    const HairWidth narrow{4e-4F, 0.02F};
    for (const float offset : {-0.7F, 0.2F})
        for (const float theta : {-0.4F, 0.0F, 0.3F}) {
            const Vec3f wo = fibre_direction(theta, 0);
            const float across =
                std::sqrt(kIor * kIor - square(std::sin(theta))) / std::cos(theta);
            const float gamma_o = std::asin(offset), gamma_t = std::asin(offset / across);
            const std::array<float, 3> around{2 * gamma_o, kPi + 2 * gamma_o - 2 * gamma_t,
                                              2 * gamma_o - 4 * gamma_t};
            const std::array<float, 3> moved{-2, 1, 4};
            for (std::size_t p = 0; p < 3; ++p) {
                const HairLobe lobe(kPaths[p], narrow, kIor, kBlack, kShift, offset);
                const Angles found = brightest(lobe, wo);
                EXPECT_NEAR(found.theta, -theta + moved[p] * kShift, kGrid) << p << " " << theta;
                EXPECT_NEAR(std::remainder(found.phi - around[p], 2 * kPi), 0, 1.5F * kGrid)
                    << p << " " << theta << " " << offset;
            }
        }
}

TEST(Hair, ReflectionIsFresnelsAtTheTiltedNormal) {
    // In the plane of the cross-section the fibre is a mirror: R turns by twice the angle to the normal at the offset.
    for (const float offset : {-0.9F, 0.0F, 0.5F}) {
        const HairLobe lobe(HairPath::R, HairWidth(), 1.55F, kWhite, 0, offset);
        EXPECT_NEAR(lobe.albedo({0, 0, 1}).r,
                    fresnel_dielectric(std::sqrt(1 - offset * offset), 1.55F).reflectance, 1e-6F);
    }
}

TEST(Hair, AbsorptionTakesByLength) {
    // Through the middle light goes one diameter, TRT two: exp(-2) and exp(-4) at an absorption of 1 a radius.
    const float f = fresnel_dielectric(1, 1.55F).reflectance;
    const auto left = [](HairPath path) {
        return HairLobe(path, HairWidth(), 1.55F, Color::grey(1), 0, 0).albedo({0, 0, 1}).r;
    };
    EXPECT_NEAR(left(HairPath::TT), square(1 - f) * std::exp(-2.0F), 1e-6F);
    EXPECT_NEAR(left(HairPath::TRT), square(1 - f) * f * std::exp(-4.0F), 1e-6F);
    EXPECT_NEAR(left(HairPath::R), f, 1e-6F);
}

TEST(Hair, ColourSurvivesTheWayToAbsorption) {
    // Chiang et al. 2016, eq. 9, at a roughness of 0.3: log(0.5) over the polynomial's value there.
    const float fit = 5.969F - 0.215F * 0.3F + 2.532F * 0.09F - 10.73F * 0.027F +
                      5.574F * 0.0081F + 0.245F * 0.00243F;
    EXPECT_NEAR(hair_absorption_from_color(Color::grey(0.5F), 0.3F).g,
                square(std::log(0.5F) / fit), 1e-6F);
    EXPECT_EQ(hair_absorption_from_color(kWhite, 0.3F), kBlack);
}

TEST(Hair, PigmentDarkensBlueMostAndRednessWarms) {
    EXPECT_EQ(hair_absorption_from_melanin(0, 0.5F), kBlack);
    const Color brown = hair_absorption_from_melanin(0.5F, 0),
                red = hair_absorption_from_melanin(0.5F, 1);
    EXPECT_LT(brown.r, brown.g);
    EXPECT_LT(brown.g, brown.b);
    EXPECT_NEAR(brown.g, 0.697F * std::log(2.0F), 1e-5F);
    EXPECT_GT(red.b / red.r, brown.b / brown.r);
    // Black is very dark, not infinitely so.
    EXPECT_LT(hair_absorption_from_melanin(1, 0).b, 20);
}

}  // namespace
}  // namespace lightsieve
