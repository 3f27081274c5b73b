// complex_ior and thin_film: the colours that the old `standard` shader takes.
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/common/node_test_support.h"
#include "scene/shade_point.h"

namespace lightsieve {

NodeType node_complex_ior();
NodeType node_thin_film();

namespace {

/// The colour seen under an angle to the normal.
Color seen(const TestNode& node, float angle_deg) {
    ShadePoint at;
    const float angle = deg_to_rad(angle_deg);
    at.wo = {std::sin(angle), 0, std::cos(angle)};
    return node.type().eval_value(node.block(), at).rgb;
}
void expect_near(Color is, Color wanted, float tolerance) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(is[c], wanted[c], tolerance) << c;
}

TEST(ComplexIor, ArtisticColoursAreThoseFaceOn) {
    TestNode node(node_complex_ior());
    node.set<Color>("reflectivity", {0.9F, 0.5F, 0.2F}).set<Color>("edgetint", {1, 0.5F, 0});
    expect_near(seen(node, 0), {0.9F, 0.5F, 0.2F}, 1e-4F);
    expect_near(seen(node, 89.99F), kWhite, 0.01F);
}

TEST(ComplexIor, PhysicalConstantsGiveFresnel) {
    TestNode node(node_complex_ior());
    // Without extinction a dielectric of 1.5: 4 %. With n 0.2, k 3.5 the formula at normal incidence.
    node.set_enum("mode", 1).set<Vec3f>("n", {1.5F, 0.2F, 1}).set<Vec3f>("k", {0, 3.5F, 0});
    const float metal = (0.64F + 12.25F) / (1.44F + 12.25F);
    expect_near(seen(node, 0), {0.04F, metal, 0}, 1e-5F);
    node.set<Vec3f>("n", {std::nanf(""), -1, 1e30F});
    EXPECT_TRUE(is_finite(seen(node, 30)));
}

TEST(ComplexIor, PresetsAndThoseWithoutFigures) {
    TestNode node(node_complex_ior());
    node.set_enum("material", 3);  // gold
    const Color gold = seen(node, 0);
    EXPECT_GT(gold.r, 0.9F);
    EXPECT_LT(gold.b, 0.5F * gold.r);
    node.set_enum("material", 10);  // silver
    EXPECT_GT(seen(node, 0).b, 0.9F);
    TestContext context;
    node.type().prepare(node.block(), context);
    EXPECT_EQ(context.diagnostics().items().size(), 0U);
    node.set_enum("material", 8);  // nickel
    node.type().prepare(node.block(), context);
    EXPECT_EQ(context.count(Code::ParamPending), 1U);
    EXPECT_FALSE(is_black(seen(node, 0)));
}

TEST(ThinFilm, ThicknessMovesTheColours) {
    TestNode node(node_thin_film());
    node.set("thickness", 0.0F);
    const Color thin = seen(node, 0);
    node.set("thickness", 1.0F);
    const Color thick = seen(node, 0);
    EXPECT_GT(std::abs(thin.r / thin.b - thick.r / thick.b), 0.2F);
    // Between the ends by interpolation: 0.5 of 200..400 is 300.
    node.set("thickness", 0.5F).set("thickness_min", 200.0F).set("thickness_max", 400.0F);
    const Color middle = seen(node, 20);
    node.set("thickness_min", 300.0F).set("thickness_max", 300.0F);
    expect_near(seen(node, 20), middle, 1e-6F);
    // A film that is no other medium than both sides shows nothing.
    node.set("ior_medium", 1.5F).set("ior_internal", 1.5F);
    expect_near(seen(node, 30), kBlack, 1e-4F);
    // Nonsense stays within 0 and 1.
    node.set("thickness", std::nanf("")).set("ior_film", -4.0F).set("ior_medium", 1e30F);
    const Color c = seen(node, 45);
    EXPECT_TRUE(is_finite(c));
    EXPECT_LE(max_component(c), 1);
}

}  // namespace
}  // namespace lightsieve
