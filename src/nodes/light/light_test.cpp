// Every light of finite size or distance on one bench, and the distant light. See light_test_support.h.
#include "nodes/light/light_test_support.h"

namespace lightsieve {

NodeType node_cylinder_light();
NodeType node_disk_light();
NodeType node_distant_light();
NodeType node_mesh_light();
NodeType node_point_light();
NodeType node_quad_light();
NodeType node_spot_light();

namespace {

using namespace light_test;

// ---- distant_light

TEST(DistantLight, ParallelLightGivesItsIrradiance) {
    Bench b(node_distant_light());
    b.node.set<Color>("color", {1, 0.5F, 0.25F}).set("intensity", 3.0F).set("exposure", 1.0F);
    b.context->color = {1, 0.5F, 0.25F};
    b.matrix(placed({5, 6, 7})).make();
    const LightSample s = b.light->sample({1, 2, 3}, {0.3F, 0.8F});
    EXPECT_TRUE(s.delta);
    EXPECT_EQ(s.pdf, 1);
    EXPECT_EQ(s.distance, kInfinity);
    // The matrix looks along (1, -2, 0.5): that is where the light goes.
    EXPECT_NEAR(dot(s.wi, normalize(Vec3f{-1, 2, -0.5F})), 1, 1e-6F);
    expect_near(s.radiance, {6, 3, 1.5F}, 1e-6F);
    EXPECT_EQ(b.light->escape({}, s.wi).pdf, 0);
    EXPECT_TRUE(b.light->infinite());
    EXPECT_NEAR(b.light->irradiance(), 3.5F, 1e-5F);
}

TEST(DistantLight, DirectionParameter) {
    Bench b(node_distant_light());
    b.node.set_array<Vec3f>("direction", {{-0.2F, 0.6F, -0.8F}});
    b.make();
    EXPECT_NEAR(dot(b.light->sample({}, {}).wi, normalize(Vec3f{0.2F, -0.6F, 0.8F})), 1, 1e-6F);
}

TEST(DistantLight, AnAngleKeepsTheIrradiance) {
    for (const float angle : {0.5F, 20.0F, 100.0F}) {
        Bench b(node_distant_light());
        b.node.set("angle", angle).set("intensity", 2.0F);
        b.matrix(placed({0, 0, 0})).make();
        const Vec3f facing = normalize(Vec3f{-1, 2, -0.5F});
        EXPECT_NEAR(sampled_irradiance(*b.light, {}, facing).r, 2, 2e-4F) << angle;
        expect_sound(*b.light, {});
    }
    Bench radiance(node_distant_light());
    radiance.node.set("angle", 20.0F).set("normalize", false);
    radiance.make();
    EXPECT_EQ(radiance.light->escape({}, {0, 0, 1}).radiance, kWhite);
    EXPECT_EQ(radiance.light->escape({}, {0, 0, -1}).pdf, 0);
}

TEST(DistantLight, NoDirectionIsAnError) {
    Bench b(node_distant_light());
    b.matrix(Mat4f::scale({1, 1, 0})).make();
    EXPECT_EQ(b.light, nullptr);
    EXPECT_TRUE(b.context->diagnostics().has_errors());
    EXPECT_EQ(b.context->diagnostics().items()[0].where.text(), "matrix");
}

// ---- point_light

TEST(PointLight, TruePointFallsOffWithTheSquare) {
    Bench b(node_point_light());
    b.node.set("intensity", 8.0F).set_array<Vec3f>("position", {{0, 1, 0}});
    b.matrix(Mat4f::translation({0, 1, 0})).make();
    const LightSample s = b.light->sample({}, {0.1F, 0.2F});
    EXPECT_TRUE(s.delta);
    EXPECT_EQ(s.distance, 2);
    expect_near(s.radiance, {2, 2, 2}, 1e-6F);
    EXPECT_EQ(b.light->geometry(), nullptr);
    EXPECT_EQ(b.light->sample({0, 2, 0}, {}).pdf, 0) << "at the light itself";
}

TEST(PointLight, SphereIsAsBrightAsAPointAndExact) {
    for (const float r : {1e-4F, 0.5F, 1.9F}) {
        Bench b(node_point_light());
        b.node.set("intensity", 8.0F);
        b.radius(r).matrix(Mat4f::translation({0, 2, 0})).make();
        const Vec3f normal = normalize(Vec3f{0.02F, 1, 0.01F});
        // E = pi L (R/d)^2 cos for a sphere above the horizon, so I cos / d^2 when normalised.
        EXPECT_NEAR(sampled_irradiance(*b.light, {}, normal).r, 2 * normal.y, 2e-3F) << r;
        if (r > 0.1F) expect_sound(*b.light, {0.1F, 0, -0.2F});
        EXPECT_EQ(b.light->sample({0, 2, r * 0.5F}, {0.5F, 0.5F}).pdf, 0) << "inside";
    }
    Bench radiance(node_point_light());
    radiance.node.set("normalize", false);
    radiance.radius(0.5F).make();
    expect_near(radiance.light->sample({0, 3, 0}, {0.3F, 0.4F}).radiance, kWhite, 1e-6F);
}

TEST(PointLight, MatrixScalesTheRadius) {
    Bench b(node_point_light());
    b.radius(0.5F).matrix(Mat4f::scale({2, 2, 2})).make();
    EXPECT_NEAR(std::get<SphereList>(b.light->geometry()->data).radii[0], 1, 1e-5F);
}

// ---- quad_light

std::vector<Vec3f> quad_corners(const Mat4f& m) {
    return {m.point({1, -1, 0}), m.point({-1, -1, 0}), m.point({-1, 1, 0}), m.point({1, 1, 0})};
}

TEST(QuadLight, AgreesWithLambertsFormula) {
    // Shining along (1, -2, 0.5) from above; a mirrored and a stretched one too.
    for (const Vec3f scale : {Vec3f{1, 1, 1}, Vec3f{0.3F, 2, 1}, Vec3f{-1, 0.7F, 1},
                              Vec3f{0.05F, 0.05F, 0}, Vec3f{1, 1, -1}}) {
        const Mat4f m = placed({-1, 4, 0}, scale);
        Bench b(node_quad_light());
        b.node.set("intensity", 5.0F);
        b.matrix(m).make();
        const double area = 4 * static_cast<double>(std::abs(scale.x * scale.y));
        // Local -Z is the lit side, wherever it points.
        const Vec3f lit = scale.z < 0 ? Vec3f{-2.5F, 8, -1} : Vec3f{0.5F, 0, 1};
        const Vec3f normal = scale.z < 0 ? Vec3f{0, -1, 0} : Vec3f{0, 1, 0};
        const double expected = 5 / area * polygon_irradiance(quad_corners(m), lit, normal);
        EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, lit, normal).r) / expected, 1,
                    5e-4)
            << scale.x << " " << scale.y << " " << scale.z;
        expect_sound(*b.light, lit);
    }
}

TEST(QuadLight, NearAndGrazingPointsStayExact) {
    Bench b(node_quad_light());
    b.matrix(Mat4f::look_at({0, 1, 0}, {0, 0, 0}, {0, 0, 1})).make();
    const std::vector<Vec3f> corners{{1, 1, 1}, {-1, 1, 1}, {-1, 1, -1}, {1, 1, -1}};
    for (const Vec3f from :
         {Vec3f{0.2F, 0.999F, 0.1F}, Vec3f{4, 0.97F, 0}, Vec3f{500, -800, 300}, Vec3f{0, 0, 0}}) {
        const Vec3f normal = normalize(Vec3f{0, 1, 0} - from);
        const double expected = polygon_irradiance(corners, from, normal) / 4;
        // Near points see parts of the light below their horizon.
        if (from.x < 0.5F && from.y > 0.5F) continue;
        EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, from, normal).r) / expected,
                    1, 3e-3)
            << from.x;
    }
    expect_strategies_agree(*b.light, {0.2F, 0.9F, 0.1F});
    expect_directions_follow_density(*b.light, {0.2F, 0.9F, 0.1F});
}

TEST(QuadLight, OneSidedAndUnnormalised) {
    Bench b(node_quad_light());
    b.node.set("normalize", false);
    b.make();
    EXPECT_EQ(b.light->sample({0, 0, 1}, {0.5F, 0.5F}).pdf, 0);
    EXPECT_EQ(look(*b.light, {0, 0, 1}, {0, 0, -1}).pdf, 0);
    EXPECT_EQ(look(*b.light, {0, 0, 1}, {0, 0, -1}).radiance, kBlack);
    EXPECT_EQ(look(*b.light, {0, 0, -1}, {0, 0, 1}).radiance, kWhite);
}

TEST(QuadLight, AnyQuadrilateral) {
    Bench b(node_quad_light());
    const std::vector<Vec3f> corners{{1, -1, 0}, {-1.5F, -1, 0}, {-1, 1, 0}, {0.5F, 2, 0}};
    b.node.set_array("vertices", corners);
    b.matrix(placed({-1, 4, 0})).make();
    std::vector<Vec3f> world;
    for (const Vec3f c : corners)
        world.push_back(placed({-1, 4, 0}).point(c));
    const double area =
        0.5 * static_cast<double>(length(cross(world[2] - world[0], world[3] - world[1])));
    const double expected = polygon_irradiance(world, {0.5F, 0, 1}, {0, 1, 0}) / area;
    EXPECT_NEAR(
        static_cast<double>(sampled_irradiance(*b.light, {0.5F, 0, 1}, {0, 1, 0}).r) / expected, 1,
        1e-3);
    expect_sound(*b.light, {0.5F, 0, 1});
}

TEST(QuadLight, ColourByTexture) {
    Bench b(node_quad_light());
    b.context->shader = [](const ShadePoint& at) { return Color{at.uv.x, at.uv.y, 1}; };
    b.node.set("normalize", false);
    b.make();
    // From the lit side, looking along +Z with Y up, +X is on the left: u grows to the right, v upward.
    expect_near(look(*b.light, {-0.8F, 0.6F, -2}, {0, 0, 1}).radiance, {0.9F, 0.8F, 1}, 1e-4F);
    expect_strategies_agree(*b.light, {-0.3F, 0.2F, -1});
    EXPECT_NEAR(b.light->bounds().intensity, 4 * 2.0F / 3, 0.01F);
}

TEST(QuadLight, SmallBrightSpotsAreFound) {
    Bench b(node_quad_light());
    b.context->shader = [](const ShadePoint& at) {
        const float x = at.uv.x - 0.7F, y = at.uv.y - 0.2F;
        return Color::grey(x * x + y * y < 0.02F * 0.02F ? 800.0F : 0.1F);
    };
    b.node.set("normalize", false);
    b.make();
    const Vec3f from{0.3F, 0.2F, -2};
    double sum = 0, squares = 0;
    constexpr std::uint32_t kSamples = 1U << 14U;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const LightSample s = b.light->sample(from, sobol(i));
        const double value = static_cast<double>(s.radiance.r * s.wi.z / s.pdf);
        sum += value;
        squares += value * value;
    }
    const double mean = sum / kSamples;
    EXPECT_LT(std::sqrt(squares / kSamples - mean * mean) / mean, 1.2);
    // The spot alone, at (-0.4, -0.6): radiance times area times cosines over the square of the distance.
    const double r2 = 0.7 * 0.7 + 0.8 * 0.8 + 4;
    const double spot = 800 * 4 * static_cast<double>(kPi) * 0.02 * 0.02 * 4 / (r2 * r2);
    EXPECT_NEAR(mean / (spot + 0.1 * 4 * 4 / (r2 * r2)), 1, 0.05);
    expect_strategies_agree(*b.light, from);
    expect_directions_follow_density(*b.light, {0, 0, -1.5F}, 5000);
}

TEST(QuadLight, HostileParameters) {
    const float nan = std::nanf("");
    Bench flat(node_quad_light());
    flat.matrix(Mat4f::scale({1, 0, 1})).make();
    EXPECT_TRUE(never_shines(*flat.light));
    EXPECT_EQ(flat.context->diagnostics().n_warnings(), 1U);

    Bench broken(node_quad_light());
    Mat4f m;
    m.m[1][2] = nan;
    broken.matrix(m).make();
    EXPECT_EQ(broken.light, nullptr);
    EXPECT_EQ(broken.context->diagnostics().items().at(0).where.text(), "matrix");

    Bench corners(node_quad_light());
    corners.node.set_array<Vec3f>("vertices", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    corners.make();
    EXPECT_EQ(corners.light, nullptr);
    EXPECT_EQ(corners.context->diagnostics().items().at(0).where.text(), "vertices");

    Bench far(node_quad_light());
    far.node.set_array<Vec3f>("vertices", {{0, 0, 0}, {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    far.make();
    EXPECT_EQ(far.light, nullptr);

    Bench bright(node_quad_light());
    bright.node.set("exposure", 300.0F);
    bright.make();
    EXPECT_EQ(bright.light, nullptr);
    EXPECT_EQ(bright.context->diagnostics().items().at(0).where.text(), "exposure");
}

TEST(AnyLight, IntensityBoundsWhatIsSeenFromAfar) {
    std::vector<Bench> benches;
    for (const auto& make : {node_quad_light, node_disk_light, node_cylinder_light,
                             node_point_light, node_spot_light}) {
        benches.emplace_back(make());
        benches.back().node.set("intensity", 3.0F);
    }
    benches[2].radius(0.3F);
    benches[3].radius(0.3F);
    for (Bench& b : benches) {
        b.make();
        const float intensity = b.light->bounds().intensity;
        float most = 0;
        for (std::uint32_t i = 0; i < 64; ++i) {
            const Vec2f u = sobol(i);
            const float z = 2 * u.x - 1, r = std::sqrt(1 - z * z);
            const Vec3f away =
                i == 0 ? Vec3f{0, 0, -1}
                       : Vec3f{r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
            most = std::max(most, sampled_irradiance(*b.light, away * 100, -away, 256).r * 1e4F);
        }
        EXPECT_LT(most, intensity * 1.01F) << b.node.type().name.view();
        EXPECT_GT(most, intensity * 0.9F) << b.node.type().name.view();
    }
}

// ---- disk_light

TEST(DiskLight, AgreesWithItsClosedForms) {
    Bench b(node_disk_light());
    b.node.set("intensity", 3.0F);
    b.radius(1).matrix(Mat4f::look_at({0, 2, 0}, {0, 0, 0}, {0, 0, 1})).make();
    // On the axis: E = pi L R^2 / (R^2 + h^2), L = I / (pi R^2).
    EXPECT_NEAR(sampled_irradiance(*b.light, {}, {0, 1, 0}).r, 3.0F / 5, 3e-4F);
    expect_sound(*b.light, {0.7F, 0, 0.3F});
    EXPECT_EQ(b.light->sample({0, 3, 0}, {0.4F, 0.4F}).pdf, 0);
    EXPECT_EQ(look(*b.light, {0, 3, 0}, {0, -1, 0}).pdf, 0);
    // Rays meet a polygon around the disc; its corners do not shine.
    const Vec3f corner = normalize(
        std::get<TriangleMesh>(b.light->geometry()->data).positions[0][0] - Vec3f{0, 2, 0});
    EXPECT_TRUE(cast(*b.light, corner * 1.0005F, {0, 1, 0}).has_value());
    EXPECT_EQ(look(*b.light, corner * 1.0005F, {0, 1, 0}).pdf, 0);
    EXPECT_GT(look(*b.light, corner * 0.9995F, {0, 1, 0}).pdf, 0);
}

TEST(DiskLight, MatrixMakesEllipses) {
    const Mat4f m = placed({-1, 4, 0}, {2, 0.5F, -1});
    Bench b(node_disk_light());
    b.radius(1).matrix(m).make();
    std::vector<Vec3f> polygon;
    for (int i = 0; i < 2000; ++i)
        polygon.push_back(m.point({std::cos(2 * kPi * static_cast<float>(i) / 2000),
                                   std::sin(2 * kPi * static_cast<float>(i) / 2000), 0}));
    const double expected =
        polygon_irradiance(polygon, {-2.5F, 8, -1}, {0, -1, 0}) / static_cast<double>(kPi);
    EXPECT_NEAR(
        static_cast<double>(sampled_irradiance(*b.light, {-2.5F, 8, -1}, {0, -1, 0}).r) / expected,
        1, 1e-3);
    expect_sound(*b.light, {-2.5F, 8, -1});
}

TEST(DiskLight, ZeroRadiusIsDark) {
    Bench b(node_disk_light());
    b.radius(0).make();
    EXPECT_TRUE(never_shines(*b.light));
    EXPECT_EQ(b.context->diagnostics().n_warnings(), 1U);
}

// ---- cylinder_light

/// Irradiance of a lit mantle with radiance 1, by summing over small pieces.
double mantle_irradiance(const Mat4f& m, float radius, Vec3f from, Vec3f normal) {
    constexpr int kAround = 720, kAlong = 400;
    double sum = 0;
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAlong; ++j) {
            const float a0 = 2 * kPi * static_cast<float>(i) / kAround,
                        a1 = 2 * kPi * static_cast<float>(i + 1) / kAround, a = 0.5F * (a0 + a1);
            const float y = -1 + 2 * (static_cast<float>(j) + 0.5F) / kAlong;
            const Vec3f p = m.point({radius * std::cos(a), y, radius * std::sin(a)});
            const Vec3f piece = cross(m.vector({0, 2.0F / kAlong, 0}),
                                      m.vector(Vec3f{radius * (std::cos(a1) - std::cos(a0)), 0,
                                                     radius * (std::sin(a1) - std::sin(a0))}));
            const Vec3f out = m.vector({std::cos(a), 0, std::sin(a)});
            const Vec3f directed = dot(piece, out) < 0 ? -piece : piece, wi = p - from;
            const double d2 = static_cast<double>(length_squared(wi));
            sum += std::max(0.0, static_cast<double>(-dot(directed, wi))) *
                   std::max(0.0, static_cast<double>(dot(normal, wi))) / (d2 * d2);
        }
    return sum;
}

TEST(CylinderLight, AgreesWithQuadrature) {
    for (const Vec3f scale : {Vec3f{1, 1, 1}, Vec3f{0.5F, 2, 0.5F}, Vec3f{-1, 1, 1}}) {
        const Mat4f m = placed({-1, 5, 0}, scale);
        Bench b(node_cylinder_light());
        b.node.set("intensity", 3.0F);
        b.radius(0.5F).matrix(m).make();
        const double area = static_cast<double>(2 * kPi * 0.5F * std::abs(scale.x) * 2 * scale.y);
        const double expected = 3 / area * mantle_irradiance(m, 0.5F, {0.5F, 0, 1}, {0, 1, 0});
        EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, {0.5F, 0, 1}, {0, 1, 0}).r) /
                        expected,
                    1, 3e-3);
        expect_strategies_agree(*b.light, {0.5F, 0, 1});
        expect_bounds_hold(*b.light, {0.5F, 0, 1});
        // At the silhouette the density goes to infinity.
        expect_directions_follow_density(*b.light, {0.5F, 0, 1}, 5000);
    }
}

TEST(CylinderLight, ShinesOutwardOnly) {
    Bench b(node_cylinder_light());
    b.make();
    for (std::uint32_t i = 0; i < 100; ++i)
        EXPECT_EQ(b.light->sample({0.1F, 0.2F, 0}, sobol(i)).pdf, 0);
    EXPECT_EQ(look(*b.light, {0, 0, 0}, {1, 0, 0}).pdf, 0);
    EXPECT_GT(look(*b.light, {3, 0, 0.1F}, {-1, 0, 0}).pdf, 0);
    Bench thin(node_cylinder_light());
    thin.radius(0).make();
    EXPECT_TRUE(never_shines(*thin.light));
}

// ---- spot_light

/// Fraction of I cos / d^2 that a spot at the origin gives toward a direction with the given tangents.
float beam(Bench& b, float x, float y) {
    const Vec3f from = Vec3f{x, y, -1} * 3;
    const LightSample s = b.light->sample(from, {0.4F, 0.6F});
    return s.pdf > 0 ? s.radiance.r * length_squared(from) : 0;
}

TEST(SpotLight, BeamProfile) {
    Bench b(node_spot_light());
    b.node.set("cone_angle", 60.0F).set("penumbra_angle", 10.0F);
    b.make();
    const float outer = std::tan(deg_to_rad(30)), inner = std::tan(deg_to_rad(20));
    EXPECT_NEAR(beam(b, 0, 0), 1, 1e-5F);
    EXPECT_NEAR(beam(b, inner * 0.99F, 0), 1, 1e-5F);
    EXPECT_NEAR(beam(b, 0, 0.5F * (inner + outer)), 0.5F, 1e-4F);
    EXPECT_NEAR(beam(b, 0.75F * inner + 0.25F * outer, 0), 0.84375F, 1e-4F);  // smoothstep(0.75)
    EXPECT_GT(beam(b, outer * 0.99F, 0), 0);
    EXPECT_EQ(beam(b, outer * 1.01F, 0), 0);
    EXPECT_EQ(beam(b, outer * 0.72F, -outer * 0.72F), 0) << "round";
    EXPECT_EQ(b.light->sample({0, 0, 1}, {}).pdf, 0) << "behind";
    expect_bounds_hold(*b.light, {0.2F, 0.1F, -2});
}

TEST(SpotLight, RoundnessAspectAndPower) {
    Bench b(node_spot_light());
    b.node.set("cone_angle", 90.0F).set("roundness", 0.35F);
    b.make();
    // The corner of a superellipse with exponent 2 / 0.35 lies at 2^(-0.175).
    const float corner = std::exp2(-0.175F);
    EXPECT_NEAR(beam(b, corner * 0.99F, corner * 0.99F), 1, 1e-5F);
    EXPECT_EQ(beam(b, corner * 1.01F, corner * 1.01F), 0);
    b.node.set("roundness", 0.0F);
    b.make();
    EXPECT_NEAR(beam(b, 0.99F, 0.99F), 1, 1e-5F);
    EXPECT_EQ(beam(b, 1.01F, 0), 0);
    expect_bounds_hold(*b.light, Vec3f{0.99F, 0.99F, -1} * 2);
    b.node.set("aspect_ratio", 2.0F);
    b.make();
    EXPECT_EQ(beam(b, 0, 0.51F), 0);
    EXPECT_NEAR(beam(b, 0.99F, 0.49F), 1, 1e-5F);
    b.node.set("cosine_power", 4.0F);
    b.make();
    EXPECT_NEAR(beam(b, 0.5F, 0), std::pow(1 / std::sqrt(1.25F), 4.0F), 1e-4F);
}

TEST(SpotLight, SphereKeepsBrightnessAndBeam) {
    Bench b(node_spot_light());
    b.node.set("intensity", 2.0F);
    b.radius(0.5F).matrix(Mat4f::look_at({0, 4, 0}, {0, 0, 0}, {0, 0, 1})).make();
    EXPECT_NEAR(sampled_irradiance(*b.light, {}, {0, 1, 0}).r, 2.0F / 16, 1e-4F);
    expect_sound(*b.light, {0.5F, 0, 0.2F});
    const Vec3f outside{4, 0, 0};
    EXPECT_EQ(b.light->sample(outside, {0.3F, 0.3F}).pdf, 0);
    EXPECT_EQ(look(*b.light, outside, normalize(Vec3f{0, 4, 0} - outside)).pdf, 0);
}

TEST(SpotLight, LensSetsTheApexBack) {
    Bench b(node_spot_light());
    b.node.set("cone_angle", 90.0F).set("lens_radius", 1.0F).set("intensity", 9.0F);
    b.make();
    // Apex 1 behind the lens: 3 from the point, which a ray leaves toward the apex and ends at the lens.
    const LightSample s = b.light->sample({0, 0, -2}, {});
    EXPECT_NEAR(s.radiance.r, 1, 1e-5F);
    EXPECT_NEAR(s.distance, 2, 1e-5F);
    // The beam is as wide as the lens where it leaves.
    EXPECT_GT(b.light->sample({0.99F, 0, -0.01F}, {}).pdf, 0);
    EXPECT_EQ(b.light->sample({1.1F, 0, -0.01F}, {}).pdf, 0);
    EXPECT_EQ(b.light->sample({0, 0, 0.5F}, {}).pdf, 0) << "between apex and lens";
    b.radius(0.2F).make();
    EXPECT_NEAR(sampled_irradiance(*b.light, {0, 0, -2}, {0, 0, 1}).r, 1, 1e-3F);
}

TEST(SpotLight, HostileParameters) {
    for (const char* name : {"cone_angle", "penumbra_angle", "cosine_power", "aspect_ratio",
                             "roundness", "lens_radius"}) {
        Bench b(node_spot_light());
        b.node.set(name, std::nanf(""));
        b.make();
        EXPECT_EQ(b.light, nullptr) << name;
        EXPECT_EQ(b.context->diagnostics().items().at(0).where.text(), name);
    }
    Bench closed(node_spot_light());
    closed.node.set("cone_angle", 0.0F);
    closed.make();
    EXPECT_TRUE(never_shines(*closed.light));
    Bench nowhere(node_spot_light());
    nowhere.matrix(Mat4f::scale({1, 1, 0})).make();
    EXPECT_EQ(nowhere.light, nullptr);
    Bench wide(node_spot_light());
    wide.node.set("cone_angle", 180.0F);
    wide.make();
    EXPECT_NEAR(beam(wide, 10, 0), 1, 1e-4F);
}

// ---- mesh_light

/// A cube of two triangles a side, outward, with edge 2.
ShapeGeometry cube() {
    TriangleMesh mesh;
    mesh.positions = {{{-1, -1, -1},
                       {1, -1, -1},
                       {1, 1, -1},
                       {-1, 1, -1},
                       {-1, -1, 1},
                       {1, -1, 1},
                       {1, 1, 1},
                       {-1, 1, 1}}};
    mesh.indices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                    3, 7, 6, 3, 6, 2, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};
    mesh.corner = mesh.indices;
    mesh.face = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5};
    ShapeGeometry out;
    out.data = mesh;
    return out;
}

Bench mesh_bench(const Mat4f& m) {
    Bench b(node_mesh_light());
    b.context->mesh = cube();
    b.context->mesh_matrix = m;
    static const int some_node = 0;
    b.node.set("mesh", NodeRef{reinterpret_cast<const NodeInstance*>(&some_node)});
    return b;
}

TEST(MeshLight, CubeAgreesWithLambertsFormula) {
    for (const Vec3f scale : {Vec3f{1, 1, 1}, Vec3f{-1, 1, 1}, Vec3f{0.5F, 1, 0.25F}}) {
        const Mat4f m = Mat4f::scale(scale) * Mat4f::translation({0, 3, 0});
        Bench b = mesh_bench(m);
        b.node.set("intensity", 6.0F);
        b.make();
        ASSERT_NE(b.light, nullptr);
        const double area =
            8 * static_cast<double>(std::abs(scale.x * scale.y) + std::abs(scale.y * scale.z) +
                                    std::abs(scale.z * scale.x));
        // Right below the middle only the bottom is seen.
        std::vector<Vec3f> bottom{m.point({-1, -1, -1}), m.point({1, -1, -1}), m.point({1, -1, 1}),
                                  m.point({-1, -1, 1})};
        const double expected = 6 / area * polygon_irradiance(bottom, {0, 0, 0}, {0, 1, 0});
        EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, {}, {0, 1, 0}, 1U << 17U).r) /
                        expected,
                    1, 5e-3);
        expect_directions_follow_density(*b.light, {3, 0, 2});
        expect_bounds_hold(*b.light, {3, 0, 2});
        EXPECT_EQ(look(*b.light, {0, 3, 0}, {0, 1, 0}).pdf, 0) << "inside";
    }
}

TEST(MeshLight, FlatMeshKnowsItsSide) {
    Bench b = mesh_bench(Mat4f::translation({0, 3, 0}));
    TriangleMesh square;
    square.positions = {{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}};
    square.indices = {0, 1, 2, 0, 2, 3};  // downward
    square.corner = square.indices;
    square.face = {0, 0};
    square.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    square.uv_indices = square.indices;
    b.context->mesh.emplace().data = square;
    b.context->shader = [](const ShadePoint& at) { return Color{at.uv.x, at.uv.y, 1}; };
    b.node.set("normalize", false);
    b.make();
    EXPECT_EQ(b.light->bounds().cos_spread, 1);
    EXPECT_NEAR(b.light->bounds().axis.y, -1, 1e-6F);
    expect_sound(*b.light, {0.3F, 0, 0.4F});
    expect_near(look(*b.light, {0.5F, 0, 0}, {0, 1, 0}).radiance, {0.75F, 0.5F, 1}, 1e-4F);
    EXPECT_EQ(look(*b.light, {0.5F, 5, 0}, {0, -1, 0}).pdf, 0);
}

TEST(MeshLight, HostileMeshes) {
    Bench none(node_mesh_light());
    none.make();
    EXPECT_EQ(none.light, nullptr);
    EXPECT_EQ(none.context->diagnostics().items().at(0).where.text(), "mesh");

    Bench ball = mesh_bench({});
    ball.context->mesh.emplace().data = SphereList{{{{0, 0, 0}}}, {1}};
    ball.make();
    EXPECT_EQ(ball.light, nullptr);
    EXPECT_EQ(ball.context->diagnostics().items().at(0).where.text(), "mesh");

    Bench flat = mesh_bench(Mat4f::scale({1, 0, 0}));
    flat.make();
    EXPECT_TRUE(never_shines(*flat.light));

    Bench unresolved = mesh_bench({});
    unresolved.context->mesh.reset();
    unresolved.make();
    EXPECT_EQ(unresolved.light, nullptr);

    Bench broken = mesh_bench({});
    std::get<TriangleMesh>(broken.context->mesh->data).positions[0][0].x = std::nanf("");
    broken.make();
    EXPECT_TRUE(never_shines(*broken.light));
}

}  // namespace
}  // namespace lightsieve
