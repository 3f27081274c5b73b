// The legacy surface: lobes beside each other.
#include <gtest/gtest.h>

#include "nodes/shader/shaded_test_support.h"

namespace lightsieve {

NodeType node_standard();

namespace {

enum Lobe { kDiffuse, kBacklight, kSpecular, kReflection, kRefraction, kSubsurface, kEmission };

TEST(Standard, DefaultIsSevenTenthsOfLambert) {
    const Shaded s{TestNode(node_standard())};
    ASSERT_EQ(s.set.closures().size(), 1U);
    EXPECT_NEAR(s.albedo(kDiffuse).g, 0.7, 1e-6);
}

TEST(Standard, LobesAreAdded) {
    TestNode node(node_standard());
    node.set("Ks", 0.5F).set("Ks_color", Color{1, 0.5F, 0}).set("Kr", 0.25F).set("Kb", 0.4F);
    const Shaded s(node);
    EXPECT_NEAR(s.albedo(kSpecular).r, 0.5, 5e-3);
    EXPECT_NEAR(s.albedo(kSpecular).g, 0.25, 5e-3);
    EXPECT_NEAR(s.albedo(kReflection).b, 0.25, 1e-5);
    EXPECT_NEAR(s.albedo(kDiffuse).g, 0.7, 1e-5);  // not weakened: no Fresnel
    EXPECT_NEAR(s.albedo(kBacklight).g, 0.7 * 0.4, 1e-5);
}

TEST(Standard, FresnelTakesFromTheDiffuseLight) {
    TestNode node(node_standard());
    node.set("Kr", 1.0F).set("Fresnel", true).set("Krn", 0.1F);
    EXPECT_NEAR(Shaded(node).albedo(kReflection).g, 0.1, 1e-4);
    EXPECT_NEAR(Shaded(node).albedo(kDiffuse).g, 0.7 * 0.9, 1e-4);
    const float edge = 0.1F + 0.9F * std::pow(0.8F, 5.0F);
    EXPECT_NEAR(Shaded(node, 0.2F).albedo(kReflection).g, edge, 1e-4);
    node.set("Fresnel_affect_diff", false);
    EXPECT_NEAR(Shaded(node).albedo(kDiffuse).g, 0.7, 1e-5);
    node.set("Fresnel_use_IOR", true).set("IOR", 1.5F);
    EXPECT_NEAR(Shaded(node).albedo(kReflection).g, 0.04, 1e-4);
}

TEST(Standard, ScattersBelowAndAbsorbsInside) {
    TestNode node(node_standard());
    node.set("Ksss", 0.5F).set("Ksss_color", Color{0.8F, 0.4F, 0.2F}).set("Kd", 0.0F);
    const Shaded skin(node);
    ASSERT_EQ(skin.set.subsurfaces().size(), 1U);
    EXPECT_NEAR(skin.set.subsurfaces()[0].albedo().r, 0.4, 1e-5);
    node.set("Ksss", 0.0F).set("Kt", 1.0F).set("IOR", 1.3F);
    node.set("transmittance", Color{0.5F, 1, 1});
    const Shaded glass(node);
    EXPECT_NEAR(glass.set.interior().medium.extinction.r, std::log(2.0F), 1e-5);
    EXPECT_EQ(glass.set.interior().medium.extinction.g, 0);
    EXPECT_NEAR(glass.set.shadow_transmission().g, 1, 1e-5);
}

}  // namespace
}  // namespace lightsieve
