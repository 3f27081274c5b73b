// Oren and Nayar's diffuse reflection against the formula of their paper, and its albedo against the integral.
#include "bsdf/oren_nayar.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightsieve {
namespace {

Vec3f direction(float theta_deg, float phi_deg) {
    const float t = deg_to_rad(theta_deg), p = deg_to_rad(phi_deg);
    return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

/// f over color / pi by the paper's angles.
float by_angles(float roughness, float theta_i, float theta_o, float phi) {
    const float r2 = roughness * roughness, a = 1 - 0.5F * r2 / (r2 + 0.57F),
                b = 0.45F * r2 / (r2 + 0.09F);
    const float alpha = deg_to_rad(std::max(theta_i, theta_o)),
                beta = deg_to_rad(std::min(theta_i, theta_o));
    return a + b * std::max(0.0F, std::cos(deg_to_rad(phi))) * std::sin(alpha) * std::tan(beta);
}

TEST(OrenNayar, IsTheFormulaOfThePaper) {
    for (const float roughness : {0.0F, 0.3F, 1.0F})
        for (const float theta_i : {10.0F, 40.0F, 70.0F})
            for (const float theta_o : {5.0F, 60.0F})
                for (const float phi : {0.0F, 50.0F, 120.0F, 180.0F}) {
                    const OrenNayarReflect lobe({1, 0.5F, 0}, roughness);
                    const Vec3f wi = direction(theta_i, phi);
                    const LobeEval e = lobe.eval(direction(theta_o, 0), wi);
                    const float expected =
                        by_angles(roughness, theta_i, theta_o, phi) * kInvPi * wi.z;
                    EXPECT_NEAR(e.f.r, expected, 1e-5F) << roughness << " " << theta_i;
                    EXPECT_NEAR(e.f.g, 0.5F * expected, 1e-5F);
                    EXPECT_EQ(e.f.b, 0);
                }
}

TEST(OrenNayar, AlbedoIsTheIntegral) {
    constexpr int kSteps = 400;
    for (const float roughness : {0.1F, 0.5F, 1.0F})
        for (const float theta_o : {0.0F, 45.0F, 80.0F, 89.0F}) {
            const OrenNayarReflect lobe(kWhite, roughness);
            const Vec3f wo = direction(theta_o, 20);
            double sum = 0;
            for (int t = 0; t < kSteps; ++t)
                for (int p = 0; p < kSteps; ++p) {
                    const float theta = 90 * (static_cast<float>(t) + 0.5F) / kSteps;
                    const Vec3f wi =
                        direction(theta, 360 * (static_cast<float>(p) + 0.5F) / kSteps);
                    sum +=
                        static_cast<double>(lobe.eval(wo, wi).f.r * std::sin(deg_to_rad(theta)));
                }
            sum *= std::pow(static_cast<double>(kPi) / kSteps, 2);
            EXPECT_NEAR(lobe.albedo(wo).r, sum, 2e-3) << roughness << " " << theta_o;
            EXPECT_LE(lobe.albedo(wo).r, 1);
        }
}

}  // namespace
}  // namespace lightsieve
