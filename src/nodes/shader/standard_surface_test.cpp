#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "bsdf/closure.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {

NodeType node_standard_surface();

namespace {

enum Lobe {
    kDiffuse,
    kSheen,
    kSpecular,
    kMetal,
    kCoat,
    kTransmission,
    kSubsurface,
    kEmission,
    kInterior,
    kLobes
};

/// A hit seen under the given cosine, from outside unless said otherwise.
ShadePoint hit(double cos_view, bool entering = true) {
    ShadePoint at;
    const float c = static_cast<float>(cos_view);
    at.wo = {safe_sqrt(1 - c * c), 0, c};
    at.geometric_normal = entering ? Vec3f{0, 0, 1} : Vec3f{0, 0, -1};
    at.entering = entering;
    return at;
}

/// Closures of one evaluation, by lobe.
struct Shaded {
    Shaded(const TestNode& node, const ShadePoint& at) {
        set.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
        set.set_records(records);
        node.type().eval_closure(node.block(), at, set);
        for (std::size_t i = 0; i < set.closures().size(); ++i)
            index[set.closures()[i].record - records.data()] = i;
    }
    [[nodiscard]] bool has(int lobe) const { return index.contains(lobe); }
    [[nodiscard]] const Closure& closure(int lobe) const { return set.closures()[index.at(lobe)]; }
    [[nodiscard]] Color weight(int lobe) const {
        return has(lobe) ? closure(lobe).weight : kBlack;
    }
    [[nodiscard]] Color emitted() const {
        return set.emissions().empty() ? kBlack : set.emissions()[0].radiance;
    }
    [[nodiscard]] Color total_albedo() const {
        Color sum = set.transparency();
        for (std::size_t i = 0; i < set.closures().size(); ++i)
            sum += set.albedo(i);
        for (const SubsurfaceClosure& below : set.subsurfaces())
            sum += below.albedo();
        return sum;
    }

    std::array<LobeRecord, kLobes> records;
    ClosureSet set;
    std::map<std::ptrdiff_t, std::size_t> index;
};

void expect_color(Color is, Color expected, double tolerance = 1e-5) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(is[i], expected[i], tolerance) << "channel " << i;
}

/// Reflectance of a dielectric, from Snell's law and the two polarisations: not the code's own form.
double fresnel(double cos_i, double eta) {
    const double sin_t = std::sqrt(1 - cos_i * cos_i) / eta;
    if (sin_t >= 1) return 1;
    const double cos_t = std::sqrt(1 - sin_t * sin_t);
    const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t),
                 p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return (s * s + p * p) / 2;
}

TestNode smooth_surface() {
    TestNode node(node_standard_surface());
    node.set("specular_roughness", 0.0F).set("coat_roughness", 0.0F);
    return node;
}

TEST(StandardSurface, DefaultIsDiffuseBelowSpecular) {
    for (const double c : {1.0, 0.7, 0.2}) {
        const Shaded s(smooth_surface(), hit(c));
        ASSERT_EQ(s.set.closures().size(), 2U);
        expect_color(s.weight(kSpecular), kWhite);
        // base_color is the model's; the weight is what the specular layer lets through.
        expect_color(s.weight(kDiffuse), Color::grey(static_cast<float>(1 - fresnel(c, 1.5))));
        expect_color(s.set.albedo(s.index.at(kDiffuse)),
                     Color::grey(static_cast<float>(0.8 * (1 - fresnel(c, 1.5)))));
        EXPECT_TRUE(is_black(s.set.transparency()));
        EXPECT_TRUE(is_black(s.emitted()));
    }
}

TEST(StandardSurface, AllLayersAreWeightedAsSpecified) {
    const float coat = 0.6F, metalness = 0.3F, specular = 0.9F, transmission = 0.4F,
                subsurface = 0.25F, emission = 2;
    const Color opacity{0.9F, 0.8F, 0.7F}, coat_color{0.5F, 0.9F, 1},
        specular_color{1, 0.6F, 0.3F}, transmission_color{0.2F, 0.7F, 1};
    const Color emission_color{1, 0.5F, 0.25F};
    TestNode node = smooth_surface();
    node.set("opacity", opacity)
        .set("coat", coat)
        .set("coat_color", coat_color)
        .set("coat_IOR", 1.3F)
        .set("metalness", metalness);
    node.set("specular", specular).set("specular_color", specular_color).set("specular_IOR", 1.7F);
    node.set("transmission", transmission)
        .set("transmission_color", transmission_color)
        .set("subsurface", subsurface);
    node.set("subsurface_color", Color{0.9F, 0.3F, 0.1F})
        .set("emission", emission)
        .set("emission_color", emission_color);
    node.set("thin_walled", true);

    const double c = 0.55;
    const Shaded s(node, hit(c));
    const float r_coat = static_cast<float>(fresnel(c, 1.3)),
                r_specular = static_cast<float>(fresnel(c, 1.7));
    for (int i = 0; i < 3; ++i) {
        // Written out from the top, a channel at a time.
        const float below_coat = opacity[i] * ((1 - coat) + coat * coat_color[i] * (1 - r_coat));
        const float dielectric = below_coat * (1 - metalness);
        const float below_specular = dielectric * (1 - specular * specular_color[i] * r_specular);
        const float base = below_specular * (1 - transmission);
        EXPECT_NEAR(s.set.transparency()[i], 1 - opacity[i], 1e-6);
        EXPECT_NEAR(s.weight(kCoat)[i], opacity[i] * coat, 1e-5);
        EXPECT_NEAR(s.emitted()[i], below_coat * emission * emission_color[i], 1e-5);
        EXPECT_NEAR(s.weight(kMetal)[i], below_coat * metalness, 1e-5);
        EXPECT_NEAR(s.weight(kSpecular)[i], dielectric * specular * specular_color[i], 1e-5);
        // Through a sheet the weight of the reflection does not matter.
        EXPECT_NEAR(s.weight(kTransmission)[i],
                    dielectric * (1 - r_specular) * transmission * transmission_color[i], 1e-5);
        EXPECT_NEAR(s.weight(kDiffuse)[i], base * (1 - subsurface), 1e-5);
        EXPECT_NEAR(s.weight(kSubsurface)[i], base * subsurface, 1e-5);
    }
    EXPECT_FALSE(s.has(kSheen));
    EXPECT_TRUE(std::holds_alternative<ThinTransmit>(s.closure(kTransmission).model));
    EXPECT_TRUE(std::holds_alternative<DiffuseTransmit>(s.closure(kSubsurface).model));
}

TEST(StandardSurface, SheenCoversTheBaseByItsAlbedo) {
    TestNode node(node_standard_surface());
    const float sheen = 0.8F;
    node.set("sheen", sheen)
        .set("sheen_color", Color{1, 0.5F, 0})
        .set("specular", 0.0F)
        .set("transmission", 0.25F);
    const Shaded s(node, hit(0.3));
    expect_color(s.weight(kSheen), Color{0.6F, 0.3F, 0});
    const Color sheen_albedo = s.set.albedo(s.index.at(kSheen));
    const float r = sheen_albedo.r / 0.6F;
    EXPECT_GT(r, 0.05F);
    expect_color(s.weight(kDiffuse), Color::grey(0.75F * (1 - sheen * r)));
}

TEST(StandardSurface, CoatAffectsColorAndRoughnessBelow) {
    TestNode node(node_standard_surface());
    node.set("coat", 0.5F)
        .set("coat_affect_color", 1.0F)
        .set("coat_affect_roughness", 1.0F)
        .set("coat_roughness", 0.4F)
        .set("specular_roughness", 0.2F);
    node.set("base_color", Color{0.25F, 0.5F, 1});
    const Shaded s(node, hit(0.8));
    const auto& diffuse = std::get<DiffuseReflect>(s.closure(kDiffuse).model);
    expect_color(diffuse.surface.color, {std::pow(0.25F, 1.5F), std::pow(0.5F, 1.5F), 1});
    // lerp(0.2, 1, 0.5 * 1 * 0.4), then squared.
    const auto& specular = std::get<DielectricReflect>(s.closure(kSpecular).model);
    EXPECT_NEAR(specular.alpha.x, square(0.36F), 1e-5);
}

TEST(StandardSurface, InsideOfGlassTheIndexTurnsRound) {
    TestNode node = smooth_surface();
    node.set("transmission", 1.0F).set("specular_IOR", 1.4F);
    const Shaded out(node, hit(0.9)), in(node, hit(0.9, false));
    EXPECT_NEAR(std::get<DielectricTransmit>(out.closure(kTransmission).model).eta, 1.4F, 1e-6);
    EXPECT_NEAR(std::get<DielectricTransmit>(in.closure(kTransmission).model).eta, 1 / 1.4F, 1e-6);
    expect_color(in.weight(kTransmission),
                 Color::grey(static_cast<float>(1 - fresnel(0.9, 1 / 1.4))));
    EXPECT_TRUE(in.has(kSpecular));
    node.set("internal_reflections", false);
    EXPECT_FALSE(Shaded(node, hit(0.9, false)).has(kSpecular));
    EXPECT_TRUE(Shaded(node, hit(0.9)).has(kSpecular));
    // Past the critical angle everything is reflected: nothing is left for transmission.
    expect_color(Shaded(node, hit(0.2, false)).weight(kTransmission), kBlack);
    // An opaque surface looks the same from both sides.
    node.set("transmission", 0.0F);
    expect_color(Shaded(node, hit(0.9, false)).weight(kDiffuse),
                 Shaded(node, hit(0.9)).weight(kDiffuse));
}

TEST(StandardSurface, MirrorsOfHighIndexKeepTheirReflectance) {
    TestNode node = smooth_surface();
    node.set("specular_IOR", 20.0F).set("base", 0.0F);
    const Shaded s(node, hit(1));
    expect_color(s.set.albedo(s.index.at(kSpecular)),
                 Color::grey(static_cast<float>(fresnel(1, 20))), 2e-3);
}

TEST(StandardSurface, AnisotropyStretchesAndTurns) {
    TestNode node(node_standard_surface());
    node.set("specular_roughness", 0.5F).set("specular_anisotropy", 0.75F).set("base", 0.0F);
    const auto across = [&](float rotation, bool along_x) {
        node.set("specular_rotation", rotation);
        const Shaded s(node, hit(1));
        const Vec3f wi =
            along_x ? Vec3f{0.5F, 0, std::sqrt(0.75F)} : Vec3f{0, 0.5F, std::sqrt(0.75F)};
        return s.set.eval(s.index.at(kSpecular), wi).f.r;
    };
    EXPECT_GT(across(0, true), 2 * across(0, false));
    EXPECT_NEAR(across(0.25F, false), across(0, true), 1e-4F);
    EXPECT_NEAR(across(0.5F, true), across(0, true), 1e-4F);
}

TEST(StandardSurface, LinkedNormalTiltsOnlyItsLayers) {
    TestNode node(node_standard_surface());
    node.set("normal", Vec3f{1, 0, 2}).set("coat", 1.0F);
    const Shaded s(node, hit(1));
    const Vec3f low{-0.95F, 0,
                    std::sqrt(1 - 0.95F * 0.95F)};  // below the horizon of the tilted normal
    EXPECT_TRUE(is_black(s.set.eval(s.index.at(kDiffuse), low).f));
    EXPECT_NE(s.closure(kSpecular).frame, 0);
    EXPECT_EQ(s.closure(kCoat).frame, 0);
    // Turned away from the viewer, it is bent back: nothing is lost or infinite.
    node.set("normal", Vec3f{-1, 0, 0});
    const Color albedo = Shaded(node, hit(0.3)).total_albedo();
    EXPECT_TRUE(is_finite(albedo) && max_component(albedo) <= 1.002F);
}

TEST(StandardSurface, CoatHasItsOwnNormalAndAnisotropy) {
    TestNode node(node_standard_surface());
    node.set("coat", 1.0F).set("coat_roughness", 0.5F).set("coat_normal", Vec3f{1, 0, 2});
    const Shaded tilted(node, hit(1));
    EXPECT_NE(tilted.closure(kCoat).frame, 0);
    EXPECT_EQ(tilted.closure(kSpecular).frame, 0);
    EXPECT_EQ(tilted.closure(kDiffuse).frame, 0);
    node.set("coat_normal", Vec3f{}).set("coat_anisotropy", 0.75F);
    const auto across = [&](float rotation, Vec3f wi) {
        node.set("coat_rotation", rotation);
        const Shaded s(node, hit(1));
        return s.set.eval(s.index.at(kCoat), wi).f.r;
    };
    const float z = std::sqrt(0.75F);
    EXPECT_GT(across(0, {0.5F, 0, z}), 2 * across(0, {0, 0.5F, z}));
    EXPECT_NEAR(across(0.25F, {0, 0.5F, z}), across(0, {0.5F, 0, z}), 1e-4F);
    EXPECT_FALSE(std::get<DielectricReflect>(Shaded(node, hit(1)).closure(kSpecular).model)
                     .alpha.stretch() > 0);
}

TEST(StandardSurface, ExtraRoughnessBlursTransmissionOnly) {
    TestNode node(node_standard_surface());
    node.set("transmission", 1.0F).set("specular_roughness", 0.3F);
    const auto alphas = [&](float extra) {
        node.set("transmission_extra_roughness", extra);
        const Shaded s(node, hit(0.8));
        return std::pair{std::get<DielectricReflect>(s.closure(kSpecular).model).alpha.x,
                         std::get<DielectricTransmit>(s.closure(kTransmission).model).alpha.x};
    };
    for (const float extra : {-0.2F, 0.0F, 0.4F}) {
        EXPECT_NEAR(alphas(extra).first, 0.09F, 1e-6F);
        EXPECT_NEAR(alphas(extra).second, square(0.3F + extra), 1e-6F);
    }
    EXPECT_EQ(alphas(-1).second, 0);
    EXPECT_EQ(alphas(1).second, 1);
}

TEST(StandardSurface, PrepareClearsNormalsThatAreOnlyWritten) {
    TestNode node(node_standard_surface());
    node.set("normal", Vec3f{1, 1, 1})
        .set("tangent", Vec3f{1, 1, 1})
        .set("coat_normal", Vec3f{1, 1, 1});
    TestContext context;
    context.linked = {"coat_normal"};
    node.type().prepare(node.block(), context);
    EXPECT_EQ(node.get<Vec3f>("normal"), Vec3f{});
    EXPECT_EQ(node.get<Vec3f>("tangent"), Vec3f{});
    EXPECT_EQ(node.get<Vec3f>("coat_normal"), (Vec3f{1, 1, 1}));
    EXPECT_TRUE(context.diagnostics().items().empty());
}

TEST(StandardSurface, SubsurfaceWalksUnlessItHasNoDepth) {
    TestNode node(node_standard_surface());
    node.set("subsurface", 0.75F)
        .set("subsurface_color", Color{0.9F, 0.4F, 0.2F})
        .set("subsurface_radius", Color{2, 1, 0.5F})
        .set("subsurface_scale", 0.1F)
        .set("specular", 0.0F)
        .set("base", 0.0F);
    const Shaded s(node, hit(0.5));
    EXPECT_TRUE(s.set.closures().empty());
    ASSERT_EQ(s.set.subsurfaces().size(), 1U);
    const SubsurfaceClosure& below = s.set.subsurfaces()[0];
    EXPECT_EQ(below.record, &s.records[kSubsurface]);
    expect_color(below.weight, Color::grey(0.75F));
    expect_color(below.albedo(), {0.675F, 0.3F, 0.15F});
    expect_color(below.medium.mean_free_path, {0.2F, 0.1F, 0.05F});
    node.set("subsurface_scale", 0.0F);
    const Shaded flat(node, hit(0.5));
    EXPECT_TRUE(flat.set.subsurfaces().empty());
    EXPECT_TRUE(std::holds_alternative<DiffuseReflect>(flat.closure(kSubsurface).model));
}

TEST(StandardSurface, DepthMovesTheTintIntoTheInterior) {
    TestNode node = smooth_surface();
    node.set("transmission", 1.0F).set("transmission_color", Color{0.5F, 0.25F, 1});
    const Shaded tinted(node, hit(1));
    EXPECT_TRUE(is_black(tinted.set.interior().medium.extinction));
    EXPECT_NEAR(tinted.weight(kTransmission).g / tinted.weight(kTransmission).b, 0.25F, 1e-5);
    node.set("transmission_depth", 2.0F);
    const Shaded deep(node, hit(1));
    EXPECT_NEAR(deep.weight(kTransmission).g / deep.weight(kTransmission).b, 1, 1e-5);
    expect_color(deep.set.interior().medium.extinction,
                 {std::log(2.0F) / 2, std::log(4.0F) / 2, 0});
    node.set("thin_walled", true);
    EXPECT_TRUE(is_black(Shaded(node, hit(1)).set.interior().medium.extinction));
}

TEST(StandardSurface, SheetsBlurByTheirRoughnessAndIndex) {
    TestNode node(node_standard_surface());
    node.set("transmission", 1.0F).set("thin_walled", true).set("specular", 0.0F);
    node.set("specular_roughness", 0.5F).set("transmission_extra_roughness", 0.25F);
    const auto alpha = [&] {
        return std::get<ThinTransmit>(Shaded(node, hit(0.5)).closure(kTransmission).model).alpha.x;
    };
    const float of_glass = alpha();
    EXPECT_NEAR(of_glass, std::sqrt(3.0F) / 4 * 0.75F * 0.75F, 1e-6);
    node.set("specular_IOR", 1.25F);
    EXPECT_NEAR(alpha(), of_glass / 2, 1e-6);
    node.set("specular_IOR", 1.0F);
    EXPECT_EQ(alpha(), 0);
    EXPECT_EQ(Shaded(node, hit(0.5)).weight(kTransmission), kWhite);
}

TEST(StandardSurface, CausticsFlagGoesToSpecularLobesOnly) {
    TestNode node(node_standard_surface());
    node.set("coat", 0.5F)
        .set("metalness", 0.5F)
        .set("transmission", 0.5F)
        .set("sheen", 0.5F)
        .set("subsurface", 0.5F);
    for (const bool caustics : {false, true}) {
        node.set("caustics", caustics);
        const Shaded s(node, hit(0.7));
        for (const int lobe : {kSheen, kSpecular, kMetal, kCoat, kTransmission})
            EXPECT_EQ(s.closure(lobe).caustics, caustics) << lobe;
        EXPECT_TRUE(s.closure(kDiffuse).caustics);
    }
}

TEST(StandardSurface, LobesMakeTheEventsOfTheReferencePage) {
    const NodeType type = node_standard_surface();
    struct Row {
        EventKind kind;
        EventLobe lobe;
        const char* label;
    };
    const std::array<Row, kLobes> rows{{{EventKind::Reflection, EventLobe::Diffuse, ""},
                                        {EventKind::Reflection, EventLobe::Specular, "sheen"},
                                        {EventKind::Reflection, EventLobe::Specular, ""},
                                        {EventKind::Reflection, EventLobe::Specular, ""},
                                        {EventKind::Reflection, EventLobe::Specular, "coat"},
                                        {EventKind::Transmission, EventLobe::Specular, ""},
                                        {EventKind::Transmission, EventLobe::Diffuse, ""},
                                        {EventKind::Object, EventLobe::None, ""},
                                        {EventKind::Volume, EventLobe::None, ""}}};
    ASSERT_EQ(type.lobes.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(type.lobes[i].kind, rows[i].kind) << i;
        EXPECT_EQ(type.lobes[i].lobe, rows[i].lobe) << i;
        EXPECT_EQ(type.lobes[i].label, rows[i].label) << i;
    }
}

/// Every float, colour and switch drawn at random; colours and weights within 0..1.
void randomise(TestNode& node, std::mt19937& rng, float low, float high) {
    std::uniform_real_distribution<float> u(low, high);
    for (const ParamInfo& p : node.type().params) {
        if (p.name.view().ends_with("normal") || p.name.view() == "tangent") continue;
        const std::string name = p.name.str();
        if (p.name.view().ends_with("IOR"))
            node.set(name.c_str(), 1 + 1.5F * u(rng));
        else if (p.type == ParamType::Float)
            node.set(name.c_str(), u(rng));
        else if (p.type == ParamType::Rgb)
            node.set(name.c_str(), Color{u(rng), u(rng), u(rng)});
        else if (p.type == ParamType::Bool)
            node.set(name.c_str(), u(rng) > 0.5F);
    }
}

TEST(StandardSurface, NeverReturnsMoreLightThanItGets) {
    std::mt19937 rng(11);
    for (int k = 0; k < 20; ++k) {
        TestNode node(node_standard_surface());
        randomise(node, rng, 0, 1);
        for (const double c : {1.0, 0.6, 0.3, 0.05})
            for (const bool entering : {true, false}) {
                const Color total = Shaded(node, hit(c, entering)).total_albedo();
                // The tables of albedos are good to 1e-3.
                EXPECT_LE(max_component(total), 1.003F)
                    << "set " << k << " cos " << c << " entering " << entering;
            }
    }
}

TEST(StandardSurface, WhiteSurfacesLoseNothing) {
    TestNode node(node_standard_surface());
    node.set("base_color", kWhite)
        .set("specular_roughness", 0.4F)
        .set("coat", 1.0F)
        .set("sheen", 0.5F)
        .set("opacity", Color{0.5F, 0.6F, 1});
    for (const double c : {1.0, 0.5, 0.2})
        expect_color(Shaded(node, hit(c)).total_albedo(), kWhite, 4e-3);
}

TEST(StandardSurface, WildValuesFromLinksDoNotBreakIt) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::mt19937 rng(5);
    for (int k = 0; k < 40; ++k) {
        TestNode node(node_standard_surface());
        randomise(node, rng, -1e4F, 1e4F);
        if (k % 2 == 0)
            for (const char* p : {"coat", "metalness", "specular", "specular_roughness",
                                  "coat_IOR", "sheen_roughness", "specular_rotation", "emission"})
                node.set(p, nan);
        if (k % 4 == 0)
            node.set("base_color", Color{nan, 1, -1}).set("opacity", Color{2, nan, -3});
        const Shaded s(node, hit(0.4, k % 3 != 0));
        EXPECT_TRUE(is_finite(s.set.transparency()));
        EXPECT_TRUE(is_finite(s.emitted()));
        for (std::size_t i = 0; i < s.set.closures().size(); ++i) {
            EXPECT_TRUE(is_finite(s.set.albedo(i))) << k;
            const LobeSample sample = s.set.sample(i, {0.3F, 0.7F}, 0.5F);
            EXPECT_TRUE(sample.pdf == 0 || (is_finite(sample.f) && is_finite(sample.wi))) << k;
        }
    }
}

}  // namespace
}  // namespace lightsieve
