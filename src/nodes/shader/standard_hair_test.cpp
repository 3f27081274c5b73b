// standard_hair, the older hair and the closure chiang_hair_bsdf.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

#include "bsdf/closure.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {

NodeType node_standard_hair();
NodeType node_hair();
NodeType node_chiang_hair_bsdf();

namespace {

/// A hit on a fibre along x, seen under an angle to the cross-section, off its middle.
ShadePoint hit(float theta, float offset) {
    ShadePoint at;
    at.wo = {std::sin(theta), 0, std::cos(theta)};
    at.on_curve = true;
    at.curve_uv = {0.5F + 0.5F * offset, 0.25F};
    at.curve_offset = offset;
    return at;
}

struct Shaded {
    Shaded(const TestNode& node, const ShadePoint& at) {
        set.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
        set.set_records(records);
        node.type().eval_closure(node.block(), at, set);
    }
    /// Weighted albedo of one lobe of the node.
    [[nodiscard]] Color albedo(std::ptrdiff_t lobe) const {
        Color sum;
        for (std::size_t i = 0; i < set.closures().size(); ++i)
            if (set.closures()[i].record - records.data() == lobe) sum += set.albedo(i);
        return sum;
    }
    [[nodiscard]] Color total() const {
        Color sum = set.transparency();
        for (std::size_t i = 0; i < set.closures().size(); ++i)
            sum += set.albedo(i);
        return sum;
    }
    std::array<LobeRecord, 5> records;
    ClosureSet set;
};

void randomise(TestNode& node, std::mt19937& rng, float low, float high) {
    std::uniform_real_distribution<float> u(low, high);
    for (const ParamInfo& p : node.type().params) {
        const std::string name = p.name.str();
        if (p.type == ParamType::Float)
            node.set(name.c_str(), u(rng));
        else if (p.type == ParamType::Rgb)
            node.set(name.c_str(), Color{u(rng), u(rng), u(rng)});
        else if (p.type == ParamType::Vector2)
            node.set(name.c_str(), Vec2f{u(rng), u(rng)});
        else if (p.type == ParamType::Bool)
            node.set(name.c_str(), u(rng) > 0.5F);
    }
}

TEST(StandardHair, EveryEventCarriesItsLabel) {
    for (const NodeType& type : {node_standard_hair(), node_hair(), node_chiang_hair_bsdf()})
        for (const LobeInfo& lobe : type.lobes)
            EXPECT_EQ(lobe.label, "hair") << type.name.view() << ' ' << lobe.index;
    const NodeType type = node_standard_hair();
    EXPECT_EQ(type.lobes[1].kind, EventKind::Transmission) << "TT";
    EXPECT_EQ(type.lobes[2].kind, EventKind::Reflection) << "TRT";
    EXPECT_EQ(type.lobes[3].lobe, EventLobe::Diffuse);
}

TEST(StandardHair, NeitherGainsNorLosesLight) {
    std::mt19937 rng(4);
    for (int k = 0; k < 40; ++k) {
        const float theta = std::uniform_real_distribution(-1.4F, 1.4F)(rng),
                    offset = std::uniform_real_distribution(-1.0F, 1.0F)(rng);
        TestNode any(node_standard_hair());
        randomise(any, rng, 0, 1);
        any.set("ior", 1.4F).set("emission", 0.0F);
        EXPECT_LE(max_component(Shaded(any, hit(theta, offset)).total()), 1 + 1e-5F) << k;
        TestNode white(node_standard_hair());
        white.set("melanin", 0.0F).set("diffuse", 0.1F * static_cast<float>(k % 11));
        white.set("opacity", Color{1, 0.5F, 0});
        const Color total = Shaded(white, hit(theta, offset)).total();
        EXPECT_NEAR(total.r, 1, 1e-5F) << k;
        EXPECT_NEAR(total.g, 1, 1e-5F) << k;
        EXPECT_NEAR(total.b, 1, 1e-5F) << k;
    }
}

TEST(StandardHair, TintsBelongToTheirPaths) {
    TestNode node(node_standard_hair());
    node.set("melanin", 0.2F);
    const Shaded plain(node, hit(0.2F, 0.3F));
    node.set("specular_tint", Color{1, 0, 0})
        .set("transmission_tint", Color{0, 1, 0})
        .set("specular2_tint", Color{0, 0, 1});
    const Shaded tinted(node, hit(0.2F, 0.3F));
    for (int lobe = 0; lobe < 3; ++lobe)
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(tinted.albedo(lobe)[c], c == lobe ? plain.albedo(lobe)[c] : 0.0F) << lobe;
}

TEST(StandardHair, DefaultHairIsBlack) {
    // Melanin 1: only the surface reflects.
    const Shaded s(TestNode(node_standard_hair()), hit(0, 0));
    EXPECT_NEAR(s.albedo(0).g, 0.0465, 1e-3);
    EXPECT_LT(max_component(s.albedo(1)), 0.02F);
}

TEST(StandardHair, StrandsDifferInPigmentOnlyWhenAsked) {
    TestNode node(node_standard_hair());
    node.set("melanin", 0.3F);
    const auto through = [&](std::uint32_t strand) {
        ShadePoint at = hit(0, 0);
        at.face = strand;
        return Shaded(node, at).albedo(1).g;
    };
    EXPECT_EQ(through(1), through(2));
    node.set("melanin_randomize", 1.0F);
    EXPECT_NE(through(1), through(2));
    EXPECT_EQ(through(1), through(1));
}

TEST(OldHair, RunsFromRootToTip) {
    TestNode node(node_hair());
    node.set("rootcolor", kBlack).set("tipcolor", kWhite).set("ambdiff", 1.0F);
    EXPECT_NEAR(Shaded(node, hit(0, 0)).albedo(3).g, 0.25F, 1e-6F);
}

TEST(ChiangHair, PathsHaveTheirOwnWidths) {
    TestNode node(node_chiang_hair_bsdf());
    node.set("roughness_R", Vec2f{0.01F, 0.3F}).set("roughness_TRT", Vec2f{0.04F, 0.3F});
    const Shaded s(node, hit(0.1F, 0.2F));
    ASSERT_EQ(s.set.closures().size(), 4U);
    EXPECT_NEAR(s.total().g, 1, 1e-5F);
    EXPECT_EQ(std::get<HairLobe>(s.set.closures()[0].model).width.variance, 0.01F);
    EXPECT_EQ(std::get<HairLobe>(s.set.closures()[3].model).width.variance, 0.04F);
}

TEST(HairShaders, WildValuesFromLinksDoNotBreakThem) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::mt19937 rng(5);
    for (int k = 0; k < 60; ++k) {
        const std::array makers{node_standard_hair, node_hair, node_chiang_hair_bsdf};
        TestNode node(makers[static_cast<std::size_t>(k % 3)]());
        randomise(node, rng, -1e4F, 1e4F);
        if (k % 3 == 0 && k % 2 == 0)
            node.set("ior", nan).set("roughness", nan).set("shift", nan).set("melanin", nan);
        const Shaded s(node, hit(0.4F, k % 2 == 0 ? nan : 0.9F));
        for (std::size_t i = 0; i < s.set.closures().size(); ++i) {
            EXPECT_TRUE(is_finite(s.set.albedo(i))) << k;
            const LobeSample sample = s.set.sample(i, {0.3F, 0.7F}, 0.5F);
            EXPECT_TRUE(sample.pdf == 0 || (is_finite(sample.f) && is_finite(sample.wi))) << k;
        }
    }
}

}  // namespace
}  // namespace lightsieve
