// Shaders that come with older scenes and with Maya: skin, maya_layered_shader, toon.
#include <gtest/gtest.h>

#include "nodes/shader/shaded_test_support.h"

namespace lightsieve {

NodeType node_maya_layered_shader();
NodeType node_skin();
NodeType node_toon();

namespace {

// Skin -------------------------------------------------------------------------------------------------------------------

TEST(Skin, HasThreeDepthsBelowAReflection) {
    TestNode node(node_skin());
    node.set("global_sss_radius_multiplier", 2.0F).set("fresnel_affect_sss", false);
    const Shaded s(node);
    ASSERT_EQ(s.set.subsurfaces().size(), 3U);
    const auto& deep = s.set.subsurfaces()[2];
    EXPECT_NEAR(deep.weight.g, 1, 1e-6);
    EXPECT_NEAR(deep.medium.reflectance.r, 0.7, 1e-4);
    EXPECT_NEAR(s.set.subsurfaces()[0].weight.g, 0.5, 1e-6);
    // Schlick's curve face on, (0.44 / 2.44)^2, times the weight; a rough lobe sees a little of the edge.
    EXPECT_NEAR(s.albedo(1).g, 0.8 * 0.0325, 0.003);
}

TEST(Skin, WhatIsReflectedIsMissingBelow) {
    TestNode node(node_skin());
    node.set("specular_weight", 1.0F).set("specular_ior", 3.0F);
    const Shaded s(node);
    EXPECT_NEAR(s.set.subsurfaces()[2].weight.g, 1 - s.albedo(1).g, 1e-5);
    EXPECT_LT(s.set.subsurfaces()[2].weight.g, 0.77);
    EXPECT_EQ(s.set.closures()[0].caustics, false);
}

TEST(Skin, OpacityIsAProduct) {
    TestNode node(node_skin());
    node.set("opacity", 0.5F).set("opacity_color", Color{1, 0.5F, 0});
    EXPECT_EQ(Shaded(node).set.transparency(), (Color{0.5F, 0.75F, 1}));
}

// Layers -----------------------------------------------------------------------------------------------------------------

/// A layer that shines, and lets the rest pass.
struct Layer {
    Color shine;
    float opacity;
    static void closures(const void* self, const ShadePoint&, ClosureSet& out) {
        const auto& layer = *static_cast<const Layer*>(self);
        out.emit(0, layer.shine * layer.opacity);
        out.transparent(Color::grey(1 - layer.opacity));
    }
    [[nodiscard]] ShaderRef ref() const {
        ShaderRef out;
        out.program = this;
        out.run = closures;
        return out;
    }
};

Color shine(const ClosureSet& set) {
    Color sum;
    for (const Emission& e : set.emissions())
        sum += e.radiance;
    return sum;
}

TEST(MayaLayeredShader, AddsOrMixes) {
    const Layer green{{0, 1, 0}, 1}, red{{1, 0, 0}, 1};
    TestNode node(node_maya_layered_shader());
    node.set("numInputs", 2U).set("color0", green.ref()).set("color1", red.ref());
    node.set("transparency0", Color::grey(0.25F)).set("transparency1", kBlack);
    EXPECT_EQ(shine(Shaded(node).set), (Color{0.25F, 1, 0}));
    EXPECT_EQ(Shaded(node).set.transparency(), kBlack);
    node.set_enum("compositingFlag", 1);
    EXPECT_EQ(shine(Shaded(node).set), (Color{0.25F, 0.75F, 0}));
    // What the lowest layer lets through is what lies behind.
    node.set("transparency1", Color::grey(0.5F));
    EXPECT_EQ(Shaded(node).set.transparency(), Color::grey(0.125F));
    // Layers beyond the count do not take part.
    node.set("numInputs", 1U);
    EXPECT_EQ(shine(Shaded(node).set), (Color{0, 0.75F, 0}));
}

TEST(MayaLayeredShader, GoesByTheOpacityOfAShader) {
    const Layer green{{0, 1, 0}, 0.75F}, red{{1, 0, 0}, 0.5F};
    TestNode node(node_maya_layered_shader());
    node.set("numInputs", 2U).set("color0", green.ref()).set("color1", red.ref());
    node.set("useTransparency0", false).set("useTransparency1", false);
    const Shaded s(node);
    EXPECT_EQ(shine(s.set), (Color{0.25F * 0.5F, 0.75F, 0}));
    EXPECT_EQ(s.set.transparency(), Color::grey(0.25F * 0.5F));
}

// Toon -------------------------------------------------------------------------------------------------------------------

TEST(Toon, IsDiffuseByDefault) {
    const Shaded s{TestNode(node_toon())};
    ASSERT_EQ(s.set.closures().size(), 1U);
    EXPECT_NEAR(s.albedo(0).g, 0.8, 1e-6);
    EXPECT_EQ(s.set.closures()[0].indirect, 0);
}

TEST(Toon, ReflectionTakesFromTheBaseIfEnergyIsKept) {
    TestNode node(node_toon());
    node.set("specular", 1.0F).set("specular_roughness", 0.3F).set("IOR", 2.0F);
    const Shaded kept(node);
    EXPECT_NEAR(kept.albedo(1).g, 1.0 / 9, 0.01);
    EXPECT_NEAR(kept.albedo(0).g, 0.8 * (1 - kept.albedo(1).g), 1e-5);
    node.set("energy_conserving", false);
    EXPECT_NEAR(Shaded(node).albedo(0).g, 0.8, 1e-5);
    node.set("sheen", 0.5F).set("emission", 2.0F).set("transmission", 0.25F);
    const Shaded all(node);
    EXPECT_NEAR(all.albedo(0).g, 0.8 * 0.75, 1e-5);
    EXPECT_GT(all.albedo(3).g, 0);
    EXPECT_EQ(shine(all.set), Color::grey(2));
    EXPECT_TRUE(all.set.interior().is_body);
}

}  // namespace
}  // namespace lightsieve
