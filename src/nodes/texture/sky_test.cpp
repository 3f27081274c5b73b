// The sky's model against figures of its own paper's formula and of daylight, and the shaders that show skies.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/color.h"
#include "nodes/common/node_test_support.h"
#include "nodes/common/sky_model.h"

namespace lightsieve {

NodeType node_physical_sky();
NodeType node_sky();

namespace {

/// Scene units back to lux, and cd/m^2.
constexpr float kLux = 100000 / kPi;

float luminance_of(Color c) { return luminance(c); }

/// Integral of radiance times cosine over the upper half space.
Color irradiance(const std::function<Color(Vec3f)>& radiance, int n = 200) {
    std::array<double, 3> sum{};
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < 4 * n; ++x) {
            const float theta = (static_cast<float>(y) + 0.5F) / static_cast<float>(n) * kPi / 2,
                        phi = (static_cast<float>(x) + 0.5F) / static_cast<float>(2 * n) * kPi;
            const Color c = radiance({std::sin(theta) * std::cos(phi), std::cos(theta),
                                      std::sin(theta) * std::sin(phi)});
            const double weight = static_cast<double>(std::sin(theta) * std::cos(theta)) *
                                  std::pow(static_cast<double>(kPi) / (2 * n), 2);
            for (int i = 0; i < 3; ++i)
                sum[static_cast<std::size_t>(i)] += weight * static_cast<double>(c[i]);
        }
    return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

Vec3f sun_at(float elevation_deg) {
    const float e = deg_to_rad(elevation_deg);
    return {std::cos(e), std::sin(e), 0};
}

TEST(SkyModel, GroundsOfAColorTintTheSky) {
    // What the ground throws back comes down again from all sides, in its colour.
    const auto sky = [](Color ground) { return SkyModel(3, ground, sun_at(45)).sky({0, 1, 0}); };
    const Color dark = sky(kBlack), green = sky({0, 0.8F, 0});
    EXPECT_GT(green.g, dark.g * 1.02F);
    EXPECT_LT(green.r / dark.r, green.g / dark.g);
}

TEST(SkyModel, IsTheSameLightInEverySpace) {
    const ColorSpace linear{Primaries::Rec709, Transfer::Linear, false};
    const Vec3f up{0.3F, 0.8F, 0.5F};
    const SkyModel wide(4, Color::grey(0.2F), sun_at(30)),
        narrow(4, Color::grey(0.2F), sun_at(30), linear);
    const ColorConversion convert(kRenderingSpace, linear);
    for (const auto& [a, b] :
         {std::pair{convert(wide.sky(normalize(up))), narrow.sky(normalize(up))},
          std::pair{convert(wide.sun()), narrow.sun()}})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(a[c], b[c], 1e-4F * std::abs(b[c]) + 1e-6F);
}

TEST(SkyModel, ZenithIsThatOfTheFormula) {
    // The tables' own units, linear with the primaries of sRGB, by another implementation of the formula: turbidity 3 and
    // albedo 0.1 under suns of 45, 20 and 80 degrees; the last with turbidity 10 at 30 degrees.
    const ColorConversion rec709(kRenderingSpace,
                                 ColorSpace{Primaries::Rec709, Transfer::Linear, false});
    struct Case {
        float turbidity, elevation;
        Color zenith;
    };
    for (const Case& c :
         {Case{3, 45, {2.28955F, 3.93346F, 7.98183F}}, Case{3, 20, {1.19454F, 2.42410F, 4.70883F}},
          Case{3, 80, {10.35043F, 12.37258F, 15.96671F}},
          Case{10, 30, {5.04209F, 5.97968F, 8.06250F}}}) {
        const SkyModel model(c.turbidity, Color::grey(0.1F), sun_at(c.elevation));
        const Color zenith = rec709(model.sky({0, 1, 0})) * (kLux / 683);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(zenith[i] / c.zenith[i], 1, 1e-3F) << c.turbidity << " " << c.elevation;
    }
}

TEST(SkyModel, DaylightHasItsUsualFigures) {
    // Clear sky, sun at 45 degrees: about 16 klx from the sky and 80 klx facing the sun, which is yellower than the sky.
    const SkyModel model(3, Color::grey(0.1F), sun_at(45));
    const float sky = luminance_of(irradiance([&](Vec3f d) { return model.sky(d); })) * kLux;
    EXPECT_NEAR(sky, 15800, 200);
    EXPECT_NEAR(luminance_of(model.sun()) * kLux, 80000, 8000);
    EXPECT_GT(model.sun().r / model.sun().b, 1.1F);
    EXPECT_LT(model.sky({0, 1, 0}).r, 0.6F * model.sky({0, 1, 0}).b);
    // Low suns are dim and red; haze takes from the sun and gives to the sky.
    const SkyModel low(3, Color::grey(0.1F), sun_at(3)), hazy(8, Color::grey(0.1F), sun_at(45));
    EXPECT_LT(luminance_of(low.sun()), 0.3F * luminance_of(model.sun()));
    EXPECT_GT(low.sun().r / low.sun().b, 3);
    EXPECT_LT(luminance_of(hazy.sun()), 0.7F * luminance_of(model.sun()));
    EXPECT_GT(luminance_of(irradiance([&](Vec3f d) { return hazy.sky(d); })) * kLux, 20000);
    // Bright ground brightens the sky.
    EXPECT_GT(luminance_of(SkyModel(3, Color::grey(0.9F), sun_at(45)).sky({0, 1, 0})),
              luminance_of(model.sky({0, 1, 0})));
}

TEST(SkyModel, EveryPlaceOfEverySkyIsFinite) {
    for (const float turbidity : {-5.0F, 1.0F, 1.5F, 9.99F, 10.0F, 1e9F})
        for (const float elevation : {-90.0F, -5.0F, 0.0F, 1.0F, 60.0F, 90.0F})
            for (const float albedo : {-1.0F, 0.5F, 2.0F}) {
                const SkyModel model(turbidity, Color::grey(albedo), sun_at(elevation));
                EXPECT_TRUE(is_finite(model.sun()));
                for (int i = 0; i <= 20; ++i) {
                    const Color c = model.sky(sun_at(static_cast<float>(9 * i)));
                    EXPECT_TRUE(is_finite(c)) << turbidity << " " << elevation << " " << i;
                }
                EXPECT_EQ(model.sky({1, 0, 0}) == kBlack, false);
                EXPECT_EQ(model.sky(normalize(Vec3f{1, -0.01F, 0})), kBlack);
                EXPECT_EQ(is_black(model.sun()), !(elevation > 0));
            }
}

/// A sky ready to be looked at.
struct Shown {
    explicit Shown(NodeType type) : node(std::move(type)) {}
    Shown& prepare() {
        node.type().prepare(node.block(), context);
        return *this;
    }
    [[nodiscard]] Color at(Vec3f direction, float uv_width = 0) const {
        ShadePoint point;
        point.direction = normalize(direction);
        point.uv_width = uv_width;
        return node.type().eval_value(node.block(), point).rgb;
    }
    TestNode node;
    TestContext context;
};

TEST(PhysicalSky, TheSunStandsWhereItIsPut) {
    Shown sky(node_physical_sky());
    sky.node.set("elevation", 30.0F).set("azimuth", 90.0F);
    sky.prepare();
    const float e = deg_to_rad(30);
    const Vec3f sun{0, std::sin(e), std::cos(e)};
    EXPECT_GT(sky.at(sun).r, 1000 * sky.at({0, 1, 0}).r);
    EXPECT_LT(sky.at(sun + Vec3f{0.01F, 0, 0}).r, 100 * sky.at({0, 1, 0}).r);
    // By direction, in axes where Z is up.
    sky.node.set("use_degrees", false)
        .set<Vec3f>("sun_direction", {1, 1, 0})
        .set<Vec3f>("Y", {0, 0, 1})
        .set<Vec3f>("Z", {0, -1, 0});
    sky.prepare();
    EXPECT_GT(sky.at({1, 0, 1}).r, 1000 * sky.at({0, 0, 1}).r);
    EXPECT_EQ(sky.at({0, 0, -1}), kBlack);
}

TEST(PhysicalSky, PartsTintsAndIntensity) {
    Shown sky(node_physical_sky());
    sky.node.set("use_degrees", false).set<Vec3f>("sun_direction", {1, 1, 0});
    sky.prepare();
    const Color zenith = sky.at({0, 1, 0}), sun = sky.at({1, 1, 0}) - sky.at({1, 1.02F, 0});
    sky.node.set<Color>("sky_tint", {0.5F, 1, 2}).set("intensity", 3.0F);
    EXPECT_NEAR(sky.at({0, 1, 0}).r / zenith.r, 1.5F, 1e-4F);
    EXPECT_NEAR(sky.at({0, 1, 0}).b / zenith.b, 6, 1e-4F);
    sky.node.set("enable_sky", false).set<Color>("sun_tint", {1, 0, 0});
    EXPECT_EQ(sky.at({0, 1, 0}), kBlack);
    EXPECT_NEAR(sky.at({1, 1, 0}).r / sun.r, 3, 0.01F);
    EXPECT_EQ(sky.at({1, 1, 0}).g, 0);
    sky.node.set("enable_sun", false);
    EXPECT_EQ(sky.at({1, 1, 0}), kBlack);
}

TEST(PhysicalSky, TheSunsLightDoesNotDependOnItsSize) {
    Shown sky(node_physical_sky());
    sky.node.set("use_degrees", false).set("enable_sky", false);
    for (const float size : {4.5F, 10.0F, 60.0F}) {
        sky.node.set("sun_size", size);
        sky.prepare();
        const SkyModel model(3, Color::grey(0.1F), {0, 1, 0});
        const Color sum = irradiance([&](Vec3f d) { return sky.at(d); }, 600);
        EXPECT_NEAR(sum.g / model.sun().g, 1, 0.05F) << size;
        // Asked for its mean over a footprint it is wider and as bright in all.
        const Color wide = irradiance([&](Vec3f d) { return sky.at(d, 0.01F); }, 600);
        EXPECT_NEAR(wide.g / model.sun().g, 1, 0.05F) << size;
    }
    EXPECT_EQ(sky.at(sun_at(50)), kBlack);
    EXPECT_FALSE(is_black(sky.at(sun_at(50), 0.05F)));
}

TEST(PhysicalSky, NonsenseIsReported) {
    Shown sky(node_physical_sky());
    sky.node.set("elevation", std::numeric_limits<float>::quiet_NaN());
    sky.prepare();
    EXPECT_EQ(sky.context.count(Code::InvalidValue), 1U);
    EXPECT_TRUE(is_finite(sky.at({0, 1, 0})));
    Shown linked(node_physical_sky());
    linked.context.linked.insert("turbidity");
    linked.prepare();
    EXPECT_EQ(linked.context.count(Code::ParamPending), 1U);
}

TEST(Sky, AColourAllAround) {
    TestNode node(node_sky());
    Lazy<Color> color;
    color.value = {1, 2, 3};
    node.set("color", color.value).set("intensity", 2.0F).set("opaque_alpha", false);
    const ShaderValue value = node.type().eval_value(node.block(), {});
    EXPECT_EQ(value.rgb, Color(2, 4, 6));
    EXPECT_EQ(value.a, 0);
}

}  // namespace
}  // namespace lightsieve
