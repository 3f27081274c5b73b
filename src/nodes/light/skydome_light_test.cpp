// The skydome on the bench of light_test_support.h, and its pictures.
#include "nodes/light/light_test_support.h"

namespace lightsieve {

NodeType node_skydome_light();

namespace {

using namespace light_test;

TEST(SkydomeLight, EvenDome) {
    Bench b(node_skydome_light());
    b.node.set("intensity", 2.0F);
    b.make();
    EXPECT_TRUE(b.light->is_skydome());
    EXPECT_TRUE(b.light->infinite());
    EXPECT_NEAR(sampled_irradiance(*b.light, {}, {0, 1, 0}).r, 2 * kPi, 2e-3F);
    EXPECT_NEAR(b.light->irradiance(), 2 * kPi, 1e-4F);
    expect_sound(*b.light, {});
    EXPECT_EQ(b.node.get<float>("camera"), 1);
    EXPECT_EQ(b.node.get<float>("transmission"), 1);
}

/// Irradiance of a dome by summing over directions.
Color dome_irradiance(const Light& light, Vec3f normal) {
    constexpr int kLatitudes = 1000;
    double sum[3] = {};
    for (int y = 0; y < kLatitudes; ++y)
        for (int x = 0; x < 2 * kLatitudes; ++x) {
            const double theta = (y + 0.5) / kLatitudes * static_cast<double>(kPi),
                         phi = (x + 0.5) / kLatitudes * static_cast<double>(kPi);
            const Vec3f d{static_cast<float>(std::sin(theta) * std::cos(phi)),
                          static_cast<float>(std::cos(theta)),
                          static_cast<float>(std::sin(theta) * std::sin(phi))};
            const double weight = std::max(0.0, static_cast<double>(dot(d, normal))) *
                                  std::sin(theta) * square(kPi / kLatitudes);
            const Color c = light.escape({}, d).radiance;
            for (int i = 0; i < 3; ++i)
                sum[i] += weight * static_cast<double>(c[i]);
        }
    return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

TEST(SkydomeLight, PictureIsSampledByBrightness) {
    Bench b(node_skydome_light());
    // A sun of 5 degrees, black ground, and a sky that varies.
    b.context->shader = [](const ShadePoint& at) {
        const Vec3f sun = normalize(Vec3f{1, 2, 0.5F});
        if (dot(at.direction, sun) > std::cos(deg_to_rad(5))) return Color{50, 45, 40};
        return at.direction.y < 0 ? kBlack : Color{0.2F, 0.3F, 0.3F + at.direction.x * 0.2F};
    };
    b.node.set("resolution", 400);
    b.make();
    expect_near(sampled_irradiance(*b.light, {}, {0, 1, 0}, 1U << 17U),
                dome_irradiance(*b.light, {0, 1, 0}), 4e-3F);
    EXPECT_NEAR(b.light->irradiance(), average(dome_irradiance(*b.light, {0, 1, 0})), 0.02F);
    expect_strategies_agree(*b.light, {});
    expect_directions_follow_density(*b.light, {});
    // Nothing that shines has density 0, and black parts get few samples.
    int black = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        EXPECT_GT(b.light->escape({}, b.light->sample({}, sobol(i)).wi).pdf, 0);
        black += is_black(b.light->sample({}, sobol(i)).radiance) ? 1 : 0;
    }
    EXPECT_LT(black, 100);
}

/// A light as a surface that faces one way asks it.
class Asked final : public Light {
  public:
    Asked(const Light& light, Vec3f normal) : light_(light), normal_(normal) {}
    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        return light_.sample_facing(from, normal_, u);
    }
    [[nodiscard]] LightEval escape(Vec3f from, Vec3f direction) const override {
        return light_.escape_facing(from, normal_, direction);
    }
    [[nodiscard]] bool infinite() const override { return true; }
    [[nodiscard]] LightBounds bounds() const override { return {}; }

  private:
    const Light& light_;
    Vec3f normal_;
};

TEST(SkydomeLight, AnEvenDomeLeavesNothingToChanceForAFacingPlane) {
    Bench b(node_skydome_light());
    b.make();
    const Vec3f normal = normalize(Vec3f{0.3F, -1, 0.4F});
    for (std::uint32_t i = 0; i < 200; ++i) {
        const LightSample s = b.light->sample_facing({}, normal, sobol(i));
        ASSERT_GT(s.pdf, 0);
        EXPECT_NEAR(dot(s.wi, normal) / s.pdf, kPi, 1e-3F);
    }
    EXPECT_EQ(b.light->escape_facing({}, normal, -normal).pdf, 0);
    expect_strategies_agree(Asked(*b.light, normal), {});
    expect_directions_follow_density(Asked(*b.light, normal), {});
}

TEST(SkydomeLight, SurfacesLookForThePictureBelowTheirHorizonLess) {
    Bench b(node_skydome_light());
    // A bright patch upon a sky that varies little.
    b.context->shader = [](const ShadePoint& at) {
        if (dot(at.direction, normalize(Vec3f{1, 2, 0.5F})) > std::cos(deg_to_rad(15)))
            return Color{5, 4, 3};
        return Color{0.2F, 0.3F, 0.3F + at.direction.x * 0.2F};
    };
    b.node.set("resolution", 400);
    b.make();
    for (const Vec3f normal : {Vec3f{0, 1, 0}, normalize(Vec3f{-1, -2, 0.2F})}) {
        const Asked asked(*b.light, normal);
        expect_near(sampled_irradiance(asked, {}, normal, 1U << 17U),
                    dome_irradiance(*b.light, normal), 4e-3F);
        expect_strategies_agree(asked, {});
        expect_directions_follow_density(asked, {});
        int behind = 0, behind_of_all = 0;
        for (std::uint32_t i = 0; i < 2000; ++i) {
            behind += dot(asked.sample({}, sobol(i)).wi, normal) < 0 ? 1 : 0;
            behind_of_all += dot(b.light->sample({}, sobol(i)).wi, normal) < 0 ? 1 : 0;
        }
        EXPECT_LT(behind, behind_of_all * 2 / 3);
    }
}

TEST(SkydomeLight, TheSunIsFoundThoughItIsSmallerThanACell) {
    Bench b(node_skydome_light());
    // A sun of a quarter degree that gives three times the sky's light; the shader shows it wider where it is asked for means.
    const Vec3f sun = normalize(Vec3f{1, 2, 0.5F});
    const float radius = deg_to_rad(0.25F), sun_light = 3;
    b.context->shader = [=](const ShadePoint& at) {
        const float r = radius + 2 * kPi * at.uv_width;
        const float away = length(at.direction - sun);
        const Color sky = at.direction.y < 0 ? kBlack : Color::grey(1 / (2 * kPi));
        return away < r ? sky + Color::grey(sun_light / (kPi * r * r)) : sky;
    };
    b.node.set("resolution", 300);
    b.make();
    double sum = 0, squares = 0;
    constexpr std::uint32_t kSamples = 1U << 14U;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const LightSample s = b.light->sample({}, sobol(i));
        const double value = static_cast<double>(s.radiance.r / s.pdf);
        sum += value;
        squares += value * value;
    }
    const double mean = sum / kSamples, deviation = std::sqrt(squares / kSamples - mean * mean);
    EXPECT_NEAR(mean, 4, 0.05);
    EXPECT_LT(deviation / mean, 0.8);
    expect_strategies_agree(*b.light, {});
}

TEST(SkydomeLight, DetailsBetweenTheSamplesOfTheTableAreNotLost) {
    Bench b(node_skydome_light());
    // A sun much smaller than a cell, somewhere the table does not look.
    b.context->shader = [](const ShadePoint& at) {
        return dot(at.direction, normalize(Vec3f{0.31F, 0.17F, 0.43F})) >
                       std::cos(deg_to_rad(0.05F))
                   ? Color::grey(1e6F)
                   : kBlack;
    };
    b.node.set("resolution", 16);
    b.make();
    EXPECT_GT(b.light->irradiance(), 0);
    EXPECT_GT(b.light->escape({}, normalize(Vec3f{0.31F, 0.17F, 0.43F})).pdf, 0);
}

TEST(SkydomeLight, Layouts) {
    // u in red, v in green. Latlong: u = 1/2 - atan2(x, z) / 2 pi, v = 1/2 + asin(y) / pi.
    const auto uv_of = [](std::int32_t format, Vec3f d) {
        Bench b(node_skydome_light());
        b.context->shader = [](const ShadePoint& at) { return Color{at.uv.x, at.uv.y, 0}; };
        b.node.set_enum("format", format).set("resolution", 16);
        b.make();
        const Color c = b.light->escape({}, d).radiance;
        return Vec2f{c.r, c.g};
    };
    const auto expect_uv = [](Vec2f uv, float u, float v) {
        EXPECT_NEAR(uv.x, u, 1e-5F);
        EXPECT_NEAR(uv.y, v, 1e-5F);
    };
    constexpr std::int32_t kBall = 0, kAngular = 1, kLatLong = 2;
    expect_uv(uv_of(kLatLong, {0, 0, 1}), 0.5F, 0.5F);
    expect_uv(uv_of(kLatLong, {1, 0, 0}), 0.25F, 0.5F);
    expect_uv(uv_of(kLatLong, {-1, 0, 0}), 0.75F, 0.5F);
    expect_uv(uv_of(kLatLong, normalize(Vec3f{0, 1, 1})), 0.5F, 0.75F);
    expect_uv(uv_of(kAngular, {0, 0, 1}), 0.5F, 0.5F);
    expect_uv(uv_of(kAngular, {0, 1, 0}), 0.5F, 0.75F);
    expect_uv(uv_of(kAngular, {1, 0, 0}), 0.25F, 0.5F);
    expect_uv(uv_of(kBall, {0, 1, 0}), 0.5F, 0.5F + 0.5F * std::sin(kPi / 4));
    expect_uv(uv_of(kBall, {0, 0, 1}), 0.5F, 0.5F);
}

TEST(SkydomeLight, MatrixTurnsThePicture) {
    Bench b(node_skydome_light());
    b.context->shader = [](const ShadePoint& at) {
        return Color{at.uv.x, at.uv.y, at.direction.x};
    };
    b.node.set("resolution", 64);
    // Local X goes to world Z; scale and shift do not matter.
    Mat4f m;
    m.m = {{{0, 0, 3, 0}, {0, 3, 0, 0}, {-3, 0, 0, 0}, {7, 8, 9, 1}}};
    b.matrix(m).make();
    expect_near(b.light->escape({}, {0, 0, 1}).radiance, {0.25F, 0.5F, 0}, 1e-4F);
    expect_near(b.light->escape({}, {-1, 0, 0}).radiance, {0.5F, 0.5F, -1}, 1e-4F);
    expect_sound(*b.light, {});
    // A mirrored dome shows a mirrored picture.
    Bench mirrored(node_skydome_light());
    mirrored.context->shader = b.context->shader;
    mirrored.node.set("resolution", 64);
    mirrored.matrix(Mat4f::scale({-1, 1, 1})).make();
    expect_near(mirrored.light->escape({}, {1, 0, 0}).radiance, {0.75F, 0.5F, 1}, 1e-4F);
    expect_strategies_agree(*mirrored.light, {});
}

TEST(SkydomeLight, HostileParameters) {
    Bench singular(node_skydome_light());
    singular.matrix(Mat4f::scale({0, 0, 0})).make();
    ASSERT_NE(singular.light, nullptr);
    EXPECT_EQ(singular.context->diagnostics().n_warnings(), 1U);

    Bench nan(node_skydome_light());
    nan.context->shader = [](const ShadePoint& at) {
        return at.uv.x < 0.5F ? Color::grey(std::nanf("")) : kWhite;
    };
    nan.node.set("resolution", -5);
    nan.make();
    for (std::uint32_t i = 0; i < 100; ++i) {
        const LightSample s = nan.light->sample({}, sobol(i));
        EXPECT_TRUE(std::isfinite(s.pdf) && s.pdf > 0);
    }
    EXPECT_TRUE(std::isfinite(nan.light->irradiance()));

    Bench off(node_skydome_light());
    off.node.set("intensity", 0.0F);
    off.make();
    EXPECT_EQ(off.light->irradiance(), 0);
    Bench colour(node_skydome_light());
    colour.context->color = {1, std::nanf(""), 1};
    colour.make();
    EXPECT_EQ(colour.light, nullptr);
    EXPECT_EQ(colour.context->diagnostics().items().at(0).where.text(), "color");
}

}  // namespace
}  // namespace lightsieve
