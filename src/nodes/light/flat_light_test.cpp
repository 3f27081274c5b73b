// What spread, roundness and soft_edge do to quad and disk lights. See light_test_support.h.
#include "nodes/light/light_test_support.h"

namespace lightsieve {

NodeType node_disk_light();
NodeType node_quad_light();

namespace {

using namespace light_test;

/// Irradiance at a height under the middle of a facing disc of radiance 1 before the grid of `spread`: the integral of
/// (1 - tan t / tan h) cos t sin t over 2 pi, relative to that of the whole cone.
double disc_under_grid(double radius, double height, double spread) {
    const double h = spread * static_cast<double>(kPi) / 2,
                 t = std::min(h, std::atan(radius / height));
    const auto inside = [&](double x) {
        return std::sin(x) * std::sin(x) / 2 - (x / 2 - std::sin(2 * x) / 4) / std::tan(h);
    };
    return static_cast<double>(kPi) * inside(t) / inside(h);
}

TEST(FlatLights, SpreadOfADiscAgreesWithItsIntegral) {
    for (const float spread : {0.02F, 0.3F, 0.7F, 0.95F})
        for (const float height : {0.5F, 2.0F, 30.0F}) {
            Bench b(node_disk_light());
            b.node.set("spread", spread).set("normalize", false);
            b.radius(1).make();
            const double expected =
                disc_under_grid(1, static_cast<double>(height), static_cast<double>(spread));
            EXPECT_NEAR(
                static_cast<double>(sampled_irradiance(*b.light, {0, 0, -height}, {0, 0, 1}).r) /
                    expected,
                1, 4e-3)
                << spread << " " << height;
        }
}

TEST(FlatLights, UnderALargeQuadSpreadChangesNothing) {
    // Every direction of the cone meets the light, and its power is kept: E = pi L.
    for (const float spread : {0.001F, 0.05F, 0.5F, 0.9F}) {
        Bench b(node_quad_light());
        b.node.set("spread", spread).set("normalize", false);
        b.matrix(Mat4f::scale({100, 100, 1})).make();
        const float irradiance = sampled_irradiance(*b.light, {3, -2, -1}, {0, 0, 1}, 1U << 16U).r;
        EXPECT_NEAR(irradiance / kPi, 1, 5e-3) << spread;
    }
}

TEST(FlatLights, BeyondTheHalfAngleItIsDark) {
    for (const NodeType& type : {node_quad_light(), node_disk_light()}) {
        Bench b(type);
        b.node.set("spread", 0.5F);
        b.make();
        // 45 degrees from the nearest point of the light, and a little less.
        const float edge = type.name == Name("quad_light") ? 1.0F : 0.5F;
        EXPECT_EQ(b.light->sample({edge + 2.01F, 0, -2}, {0.3F, 0.6F}).pdf, 0);
        EXPECT_GT(sampled_irradiance(*b.light, {edge + 1.8F, 0, -2}, {0, 0, 1}).r, 0);
        EXPECT_NEAR(b.light->bounds().cos_emission, std::sqrt(0.5F), 1e-6F);
    }
}

TEST(FlatLights, FocusedOnesAreSound) {
    for (const float spread : {0.1F, 0.4F, 0.8F})
        for (const NodeType& type : {node_quad_light(), node_disk_light()}) {
            Bench b(type);
            b.node.set("spread", spread);
            if (type.name == Name("quad_light"))
                b.node.set("roundness", 0.4F).set("soft_edge", 0.3F);
            b.matrix(placed({-1, 4, 0}, {1, 0.7F, 1})).make();
            // Near the axis, which runs along (1, -2, 0.5).
            expect_sound(*b.light, {-0.1F, 2, 0.35F}, 0.05F);
        }
    // Four corners that are no rectangle are sampled by area.
    Bench b(node_quad_light());
    b.node.set_array<Vec3f>("vertices", {{1, -1, 0}, {-1.5F, -1, 0}, {-1, 1, 0}, {0.5F, 2, 0}})
        .set("spread", 0.6F)
        .set("roundness", 0.5F);
    b.make();
    expect_strategies_agree(*b.light, {0, 0, -1});
    expect_bounds_hold(*b.light, {0, 0, -1});
}

TEST(FlatLights, RoundnessCutsASuperellipse) {
    for (const float roundness : {0.0F, 0.2F, 0.5F, 1.0F}) {
        Bench b(node_quad_light());
        b.node.set("roundness", roundness);
        b.make();
        // Area of |x|^n + |y|^n = 1 over that of its square.
        const double n = roundness > 0 ? 2 / static_cast<double>(roundness) : 1e9;
        const double share =
            std::tgamma(1 + 1 / n) * std::tgamma(1 + 1 / n) / std::tgamma(1 + 2 / n);
        const double far =
            static_cast<double>(sampled_irradiance(*b.light, {0, 0, -100}, {0, 0, 1}).r);
        EXPECT_NEAR(far * 1e4 / share, 1, 3e-3) << roundness;
    }
    Bench round(node_quad_light());
    round.node.set("roundness", 1.0F).set("normalize", false);
    round.make();
    EXPECT_EQ(look(*round.light, {0.75F, 0.75F, -1}, {0, 0, 1}).radiance, kBlack);
    EXPECT_EQ(look(*round.light, {0.7F, 0.7F, -1}, {0, 0, 1}).radiance, kWhite);
}

TEST(FlatLights, SoftEdgeFadesInward) {
    Bench b(node_quad_light());
    b.node.set("roundness", 1.0F).set("soft_edge", 1.0F);
    b.make();
    // The mean of t^2 (3 - 2 t), t = 1 - r, over a disc is 0.3.
    const float far = sampled_irradiance(*b.light, {0, 0, -100}, {0, 0, 1}).r * 1e4F;
    EXPECT_NEAR(far / (0.3F * kPi / 4), 1, 3e-3);
    Bench square(node_quad_light());
    square.node.set("soft_edge", 0.5F).set("normalize", false);
    square.make();
    EXPECT_EQ(look(*square.light, {0.4F, 0.3F, -1}, {0, 0, 1}).radiance, kWhite);
    EXPECT_NEAR(look(*square.light, {0.75F, 0.3F, -1}, {0, 0, 1}).radiance.r, 0.5F, 1e-4F);
    EXPECT_LT(look(*square.light, {0.3F, 0.99F, -1}, {0, 0, 1}).radiance.r, 0.01F);
}

TEST(FlatLights, HostileShapesStayFinite) {
    const float nan = std::nanf("");
    for (const float value : {nan, -1.0F, 0.0F, 1e30F})
        for (const NodeType& type : {node_quad_light(), node_disk_light()}) {
            Bench b(type);
            b.node.set("spread", value);
            if (type.name == Name("quad_light"))
                b.node.set("roundness", value).set("soft_edge", value);
            b.make();
            for (std::uint32_t i = 0; i < 100; ++i) {
                const LightSample s = b.light->sample({0.1F, 0.2F, -1}, sobol(i));
                EXPECT_TRUE(std::isfinite(s.pdf) && is_finite(s.radiance)) << value;
            }
            EXPECT_TRUE(std::isfinite(b.light->bounds().intensity)) << value;
        }
}

}  // namespace
}  // namespace lightsieve
