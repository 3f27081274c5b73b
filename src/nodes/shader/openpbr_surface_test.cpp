#include <gtest/gtest.h>

#include <array>
#include <map>

#include "bsdf/closure.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {

NodeType node_openpbr_surface();

namespace {

enum Lobe {
    kDiffuse,
    kFuzz,
    kSpecular,
    kMetal,
    kCoat,
    kTransmission,
    kSubsurface,
    kEmission,
    kInterior,
    kLobes
};

struct Shaded {
    Shaded(const TestNode& node, float cosine, bool entering = true) {
        ShadePoint at;
        at.wo = {safe_sqrt(1 - cosine * cosine), 0, cosine};
        at.geometric_normal = entering ? Vec3f{0, 0, 1} : Vec3f{0, 0, -1};
        at.entering = entering;
        set.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
        set.set_records(records);
        node.type().eval_closure(node.block(), at, set);
        for (std::size_t i = 0; i < set.closures().size(); ++i)
            index[set.closures()[i].record - records.data()] = i;
    }
    [[nodiscard]] bool has(int lobe) const { return index.contains(lobe); }
    [[nodiscard]] Color weight(int lobe) const {
        return has(lobe) ? set.closures()[index.at(lobe)].weight : kBlack;
    }
    [[nodiscard]] Color total_albedo() const {
        Color sum = set.transparency();
        for (std::size_t i = 0; i < set.closures().size(); ++i)
            sum += set.albedo(i);
        for (const SubsurfaceClosure& s : set.subsurfaces())
            sum += s.albedo();
        return sum;
    }
    std::array<LobeRecord, kLobes> records;
    ClosureSet set;
    std::map<std::ptrdiff_t, std::size_t> index;
};

constexpr std::array<float, 4> kCosines{1, 0.7F, 0.3F, 0.05F};

TEST(OpenPbr, WhiteKeepsAllLight) {
    // Every layer white and no coat darkening: each cosine returns exactly what arrives.
    TestNode node(node_openpbr_surface());
    node.set("base_color", kWhite).set("fuzz_weight", 0.7F).set("subsurface_color", kWhite);
    for (const float subsurface : {0.0F, 0.6F})
        for (const float cosine : kCosines) {
            node.set("subsurface_weight", subsurface);
            EXPECT_NEAR(Shaded(node, cosine).total_albedo().g, 1, 5e-3) << cosine;
        }
}

TEST(OpenPbr, NeverGainsEnergy) {
    TestNode node(node_openpbr_surface());
    node.set("base_color", kWhite);
    for (const float metalness : {0.0F, 0.5F, 1.0F})
        for (const float coat : {0.0F, 0.5F, 1.0F})
            for (const float transmission : {0.0F, 1.0F})
                for (const float cosine : kCosines) {
                    node.set("base_metalness", metalness).set("coat_weight", coat);
                    node.set("transmission_weight", transmission).set("fuzz_weight", 0.3F);
                    for (const bool entering : {true, false})
                        EXPECT_LE(max_component(Shaded(node, cosine, entering).total_albedo()),
                                  1.005F);
                }
}

TEST(OpenPbr, SpecularWeightScalesTheReflectanceFaceOn) {
    TestNode node(node_openpbr_surface());
    node.set("base_weight", 0.0F).set("specular_roughness", 0.0F);
    const float whole = Shaded(node, 1).total_albedo().g;
    EXPECT_NEAR(whole, 0.04F, 1e-3);
    node.set("specular_weight", 0.25F);
    EXPECT_NEAR(Shaded(node, 1).total_albedo().g, 0.25F * whole, 3e-4);
    node.set("specular_weight", 0.0F);
    EXPECT_NEAR(Shaded(node, 1).total_albedo().g, 0, 1e-5);
}

TEST(OpenPbr, MetalsAreTheirColourFaceOn) {
    TestNode node(node_openpbr_surface());
    const Color gold{0.9F, 0.6F, 0.2F};
    node.set("base_metalness", 1.0F).set("base_color", gold).set("specular_roughness", 0.0F);
    const Color seen = Shaded(node, 1).total_albedo();
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], gold[c], 5e-3);
    EXPECT_FALSE(Shaded(node, 1).has(kDiffuse));
}

TEST(OpenPbr, TheCoatDarkensByWhatItSendsBack) {
    // (1 - K) / (1 - E K) with K of a rough base below index 1.6; the layer's own tint and reflection come on top.
    TestNode node(node_openpbr_surface());
    node.set("coat_weight", 1.0F)
        .set("specular_weight", 0.0F)
        .set("base_color", Color::grey(0.5F));
    node.set("coat_darkening", 0.0F);
    const float plain = Shaded(node, 1).weight(kDiffuse).g;
    node.set("coat_darkening", 1.0F);
    const float facing = square(0.6F / 2.6F), k = 1 - (1 - facing) / square(1.6F);
    EXPECT_NEAR(Shaded(node, 1).weight(kDiffuse).g, plain * (1 - k) / (1 - 0.5F * k), 2e-3);
}

TEST(OpenPbr, LayersLieInOrder) {
    TestNode node(node_openpbr_surface());
    node.set("fuzz_weight", 1.0F).set("coat_weight", 1.0F).set("emission_luminance", 2.0F);
    node.set("coat_color", Color{1, 0.5F, 0});
    const Shaded s(node, 0.5F);
    EXPECT_TRUE(s.has(kFuzz) && s.has(kCoat) && s.has(kSpecular) && s.has(kDiffuse));
    EXPECT_EQ(s.weight(kFuzz), kWhite);
    EXPECT_LT(s.weight(kCoat).g, 1);                  // below the fuzz
    EXPECT_EQ(s.weight(kCoat).g, s.weight(kCoat).b);  // but not tinted by itself
    EXPECT_EQ(s.set.emissions()[0].radiance.b, 0);    // emission is seen through the coat
    EXPECT_EQ(s.weight(kDiffuse).b, 0);
}

TEST(OpenPbr, ThinWallsHaveNoInterior) {
    TestNode node(node_openpbr_surface());
    node.set("transmission_weight", 1.0F).set("transmission_depth", 2.0F);
    node.set("transmission_color", Color{0.5F, 0.25F, 1});
    const Color inside = Shaded(node, 1).set.interior().medium.extinction;
    EXPECT_NEAR(inside.r, std::log(2.0F) / 2, 1e-5);
    EXPECT_NEAR(inside.g, std::log(4.0F) / 2, 1e-5);
    EXPECT_EQ(inside.b, 0);
    node.set("geometry_thin_walled", true);
    EXPECT_TRUE(is_black(Shaded(node, 1).set.interior().medium.extinction));
    EXPECT_NEAR(Shaded(node, 1).weight(kTransmission).g / Shaded(node, 1).weight(kTransmission).b,
                0.25F, 1e-5);
    // Blurred by two interfaces: alpha * (ior - 1) * sqrt(3) / 2.
    node.set("specular_roughness", 0.5F).set("specular_ior", 1.4F).set("specular_weight", 0.0F);
    const Shaded glass(node, 1);
    const Closure* through = nullptr;
    for (const Closure& c : glass.set.closures())
        if (c.record == &glass.records[kTransmission]) through = &c;
    ASSERT_NE(through, nullptr);
    EXPECT_NEAR(std::get<ThinTransmit>(through->model).alpha.x, 0.25F * 0.4F * std::sqrt(0.75F),
                1e-6F);
    EXPECT_NEAR(through->weight.b, 1, 1e-6F) << "without a reflection nothing is lost";
    node.set("transmission_weight", 0.0F).set("subsurface_weight", 1.0F);
    const Shaded sheet(node, 1);
    EXPECT_TRUE(sheet.set.subsurfaces().empty());
    EXPECT_EQ(sheet.weight(kSubsurface), sheet.weight(kDiffuse));
}

TEST(OpenPbr, OpacityLetsRaysThrough) {
    TestNode node(node_openpbr_surface());
    node.set("geometry_opacity", 0.25F);
    const Shaded s(node, 0.8F);
    EXPECT_EQ(s.set.transparency(), Color::grey(0.75F));
    node.set("geometry_opacity", 0.0F);
    EXPECT_TRUE(Shaded(node, 0.8F).set.closures().empty());
}

TEST(OpenPbr, FilmCoversAPart) {
    TestNode node(node_openpbr_surface());
    node.set("specular_roughness", 0.3F)
        .set("base_metalness", 0.5F)
        .set("thin_film_thickness", 0.4F)
        .set("thin_film_ior", 1.33F);
    const Shaded plain(node, 0.8F);
    node.set("thin_film_weight", 0.25F);
    const Shaded filmed(node, 0.8F);
    std::size_t dielectric = 0, metal = 0;
    for (const Closure& c : filmed.set.closures()) {
        if (const auto* f = std::get_if<FilmReflect>(&c.model)) {
            EXPECT_NEAR(f->film.thickness, 400, 1e-3F);
            EXPECT_EQ(f->film.ior, 1.33F);
            EXPECT_NEAR(c.weight.g, 0.25F * plain.weight(kSpecular).g, 1e-6F);
            ++dielectric;
        }
        if (const auto* f = std::get_if<FilmedSchlickReflect>(&c.model)) {
            EXPECT_NEAR(f->film.thickness, 400, 1e-3F);
            EXPECT_NEAR(c.weight.g, 0.25F * plain.weight(kMetal).g, 1e-6F);
            ++metal;
        }
    }
    EXPECT_EQ(dielectric, 1U);
    EXPECT_EQ(metal, 1U);
    EXPECT_LE(max_component(filmed.total_albedo()), 1.003F);
    // Inside of a body and on thin walls there is none.
    node.set("transmission_weight", 1.0F).set("base_metalness", 0.0F);
    for (const bool inside : {true, false}) {
        node.set("geometry_thin_walled", !inside);
        const Shaded shaded(node, 0.8F, !inside);
        for (const Closure& c : shaded.set.closures())
            EXPECT_FALSE(std::holds_alternative<FilmReflect>(c.model));
    }
}

}  // namespace
}  // namespace lightsieve
