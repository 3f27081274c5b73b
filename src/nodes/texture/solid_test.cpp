// Solid patterns and textures thrown onto objects: ranges, means, places, and where their inputs are asked.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nodes/all_nodes.h"
#include "nodes/common/node_test_support.h"
#include "scene/shade_services.h"

namespace lightsieve {
namespace {

TestNode node_of(const char* name) { return TestNode(*builtin_registry().find(name)); }

/// Links a parameter to what shows the coordinates and the footprint that it is asked for.
void show_uv(TestNode& node, const char* param) {
    LazyLink link;
    link.links = &node;
    link.apply = [](const void*, void* value, const ShadePoint& at) {
        const Rgba seen{{at.uv.x, at.uv.y, at.uv_width}, 1};
        std::memcpy(value, &seen, sizeof(seen));
    };
    const ParamInfo* info = node.type().find(param);
    std::memcpy(static_cast<std::byte*>(node.block()) + info->lazy_offset, &link, sizeof(link));
}

ShadePoint point_at(Vec3f p, Vec3f normal = {0, 0, 1}) {
    ShadePoint at;
    at.position = p;
    at.normal = at.geometric_normal = at.wo = normal;
    at.width = 0.01F;
    return at;
}
Rgba value(const TestNode& node, const ShadePoint& at) {
    return node.type().eval_value(node.block(), at);
}
Color color(const TestNode& node, Vec3f p) { return value(node, point_at(p)).rgb; }

/// Places that no pattern repeats at.
Vec3f scattered(int i) {
    const float t = static_cast<float>(i);
    return {std::fmod(t * 0.754877F, 1.0F) * 20 - 10, std::fmod(t * 0.569840F, 1.0F) * 20 - 10,
            std::fmod(t * 0.381966F, 1.0F) * 20 - 10};
}

struct Statistics {
    float low = 1e9F, high = -1e9F, mean = 0, deviation = 0;
};
Statistics statistics(const TestNode& node) {
    Statistics out;
    constexpr int kPoints = 4000;
    double sum = 0, squares = 0;
    for (int i = 0; i < kPoints; ++i) {
        const float v = color(node, scattered(i)).g;
        out.low = std::min(out.low, v);
        out.high = std::max(out.high, v);
        sum += static_cast<double>(v);
        squares += static_cast<double>(v * v);
    }
    out.mean = static_cast<float>(sum / kPoints);
    out.deviation = static_cast<float>(std::sqrt(squares / kPoints - std::pow(sum / kPoints, 2)));
    return out;
}

// ---- noise

TEST(Noise, LiesBetweenItsColoursAroundTheirMiddle) {
    TestNode node = node_of("noise");
    node.set<Color>("color1", {0, 2, 0}).set<Color>("color2", {0, 4, 0});
    for (const std::int32_t octaves : {1, 4}) {
        node.set("octaves", octaves);
        const Statistics s = statistics(node);
        EXPECT_GE(s.low, 2);
        EXPECT_LE(s.high, 4);
        EXPECT_NEAR(s.mean, 3, 0.05);
        EXPECT_GT(s.deviation, 0.1);
    }
    node.set("amplitude", 0.0F);
    EXPECT_EQ(color(node, {1.3F, 0.2F, 7}).g, 3);
}

TEST(Noise, IsContinuousAndGrainsByScale) {
    TestNode node = node_of("noise");
    const auto step = [&](float d) {
        float most = 0;
        for (int i = 0; i < 500; ++i)
            most = std::max(most, std::abs(color(node, scattered(i)).r -
                                           color(node, scattered(i) + Vec3f{d, 0, 0}).r));
        return most;
    };
    EXPECT_LT(step(1e-3F), 0.01F);
    const float coarse = step(0.01F);
    node.set<Vec3f>("scale", {10, 1, 1});
    EXPECT_GT(step(0.01F), 5 * coarse);
    // Scale and offset move the same pattern.
    node.set<Vec3f>("offset", {3, 0, 0});
    const Color moved = color(node, {0.1F, 0.7F, 0.4F});
    node.set<Vec3f>("scale", {1, 1, 1}).set<Vec3f>("offset", {});
    EXPECT_NEAR(color(node, {4, 0.7F, 0.4F}).r, moved.r, 1e-4F);
}

TEST(Noise, VectorModeHasThreePatterns) {
    TestNode node = node_of("noise");
    node.set_enum("mode", 1);
    int alike = 0;
    for (int i = 0; i < 200; ++i) {
        const Color c = color(node, scattered(i));
        alike += std::abs(c.r - c.g) < 1e-3F || std::abs(c.g - c.b) < 1e-3F ? 1 : 0;
    }
    EXPECT_LT(alike, 10);
    // Time and distortion change the pattern.
    const Color before = color(node, {0.3F, 0.4F, 0.5F});
    node.set("time", 0.7F);
    EXPECT_NE(color(node, {0.3F, 0.4F, 0.5F}), before);
    node.set("time", 0.0F).set("distortion", 1.0F);
    EXPECT_NE(color(node, {0.3F, 0.4F, 0.5F}), before);
}

TEST(SolidPatterns, TakeTheirPlaceFromWhereTheyAreTold) {
    for (const char* name : {"noise", "cell_noise"}) {
        TestNode node = node_of(name);
        node.set_enum("coord_space", 3);  // uv
        ShadePoint a = point_at({1.3F, 2.4F, 3.2F}), b = point_at({7.7F, 8.2F, 9.4F});
        a.uv = b.uv = {0.3F, 0.6F};
        EXPECT_EQ(value(node, a).rgb, value(node, b).rgb) << name;
        node.set_enum("coord_space", 0);  // world
        EXPECT_NE(value(node, a).rgb, value(node, b).rgb) << name;
        // A linked P comes first.
        TestContext context;
        context.linked.insert("P");
        node.set<Vec3f>("P", {0.2F, 0.4F, 0.7F});
        node.type().prepare(node.block(), context);
        EXPECT_EQ(value(node, a).rgb, value(node, b).rgb) << name;
    }
}

// ---- cell_noise

TEST(CellNoise, PatternsKeepTheirRanges) {
    TestNode node = node_of("cell_noise");
    for (std::int32_t pattern = 0; pattern < 7; ++pattern) {
        node.set_enum("pattern", pattern).set("density", 1.0F);
        const Statistics s = statistics(node);
        EXPECT_GE(s.low, pattern == 6 ? 0 : -1e-6F) << pattern;
        EXPECT_LE(s.high, 1 + 1e-6F) << pattern;
        EXPECT_GT(s.deviation, 0.03F) << pattern;
    }
}

TEST(CellNoise, ACellHasOneColour) {
    TestNode node = node_of("cell_noise");
    node.set_enum("pattern", 2).set("randomness", 0.0F).set("density", 1.0F);
    // Without randomness cells are unit cubes.
    const Color here = color(node, {3.1F, 4.2F, 5.3F});
    EXPECT_EQ(color(node, {3.9F, 4.05F, 5.9F}), here);
    EXPECT_NE(color(node, {4.1F, 4.2F, 5.3F}), here);
    // Pattern cell2 is grey.
    node.set_enum("pattern", 3);
    const Color grey = color(node, {3.1F, 4.2F, 5.3F});
    EXPECT_EQ(grey.r, grey.g);
    EXPECT_EQ(grey.g, grey.b);
    // Half of the cells at half the density.
    node.set("density", 0.25F);
    int lit = 0;
    for (int i = 0; i < 2000; ++i)
        lit += is_black(color(node, scattered(i))) ? 0 : 1;
    EXPECT_NEAR(lit, 1000, 100);
}

TEST(CellNoise, WorleyIsTheDistanceToTheNearestPoint) {
    TestNode node = node_of("cell_noise");
    node.set_enum("pattern", 4).set("randomness", 0.0F);
    EXPECT_NEAR(color(node, {0.5F, 0.5F, 0.5F}).r, 0, 1e-6F);
    EXPECT_NEAR(color(node, {0.5F, 0.5F, 0.8F}).r, 0.3F, 1e-5F);
    node.set_enum("pattern", 5);
    EXPECT_NEAR(color(node, {0.5F, 0.5F, 1}).r, 0, 1e-5F) << "on the border";
    EXPECT_NEAR(color(node, {0.5F, 0.5F, 0.8F}).r, 0.4F, 1e-5F);
    // Amplitude and colour are factors; octaves add.
    node.set_enum("pattern", 4).set("amplitude", 2.0F).set<Color>("color", {1, 0.5F, 0});
    const Color c = color(node, {0.5F, 0.5F, 0.8F});
    EXPECT_NEAR(c.r, 0.6F, 1e-5F);
    EXPECT_NEAR(c.g, 0.3F, 1e-5F);
    EXPECT_EQ(c.b, 0);
    node.set("octaves", std::int32_t{2}).set("additive", true);
    EXPECT_GT(color(node, {0.5F, 0.5F, 0.8F}).r, 0.6F);
}

// ---- flakes

TEST(Flakes, CoverTheirPartAndLeanAsFarAsTold) {
    TestNode node = node_of("flakes");
    node.set("scale", 0.5F).set("density", 0.3F).set_enum("coord_space", 0);
    int covered = 0;
    for (int i = 0; i < 2000; ++i) {
        const Rgba flake = value(node, point_at(scattered(i)));
        covered += flake.a > 0 ? 1 : 0;
        EXPECT_NEAR(length(Vec3f{flake.rgb.r, flake.rgb.g, flake.rgb.b}), 1, 1e-4F);
        EXPECT_GT(flake.rgb.b, 0) << "the outer side";
    }
    EXPECT_NEAR(covered, 600, 80);
    node.set("density", 1.0F).set("normal_randomize", 0.0F);
    EXPECT_NEAR(value(node, point_at({1, 2, 3})).rgb.b, 1, 1e-6F);
    // In tangent space an upright flake is 0 0 1 on any surface.
    node.set_enum("output_space", 1);
    const Rgba aside = value(node, point_at({1, 2, 3}, {1, 0, 0}));
    EXPECT_NEAR(aside.rgb.b, 1, 1e-5F);
    // More layers, more flakes.
    node.set("density", 0.3F).set("depth", 5.0F).set("step", 0.5F);
    covered = 0;
    for (int i = 0; i < 500; ++i)
        covered += value(node, point_at(scattered(i))).a > 0 ? 1 : 0;
    EXPECT_GT(covered, 450);
}

// ---- triplanar

TEST(Triplanar, TheSideThatFacesMostCounts) {
    TestNode node = node_of("triplanar");
    show_uv(node, "input");
    const Vec3f p{0.1F, 0.2F, 0.3F};
    const auto seen = [&](Vec3f normal) { return value(node, point_at(p, normal)).rgb; };
    EXPECT_EQ(seen({0, 0, 1}), Color(0.1F, 0.2F, 0.01F));
    EXPECT_EQ(seen({1, 0, 0}), Color(0.3F, 0.2F, 0.01F));
    EXPECT_EQ(seen({0, -1, 0}), Color(0.1F, 0.3F, 0.01F));
    node.set<Vec3f>("scale", {1, 1, 5}).set<Vec3f>("offset", {1, 0, 0});
    EXPECT_NEAR(seen({0, 0, 1}).r, 5.5F, 1e-5F);
    EXPECT_NEAR(seen({0, 0, 1}).b, 0.05F, 1e-6F) << "five copies are read five times as coarse";
    node.set("flip_on_opposite_direction", true);
    EXPECT_NEAR(seen({0, 0, -1}).r, -5.5F, 1e-5F);
    node.set<Vec3f>("rotate", {0, 0, 90});
    EXPECT_NEAR(seen({0, 0, 1}).g, 5.5F, 1e-5F);
}

TEST(Triplanar, SidesBlend) {
    TestNode node = node_of("triplanar");
    node.set("input_per_axis", true)
        .set<Rgba>("input", {{1, 0, 0}, 1})
        .set<Rgba>("input_Y", {{0, 1, 0}, 1})
        .set<Rgba>("input_Z", {{0, 0, 1}, 1});
    const Vec3f between = normalize(Vec3f{1, 0.8F, 0.1F});
    const auto seen = [&](Vec3f n) { return value(node, point_at({}, n)).rgb; };
    EXPECT_EQ(seen(between), Color(1, 0, 0));
    node.set("blend", 0.5F);
    const Color mixed = seen(between);
    EXPECT_GT(mixed.g, 0.1F);
    EXPECT_EQ(mixed.b, 0);
    EXPECT_NEAR(mixed.r + mixed.g, 1, 1e-5F);
    EXPECT_NEAR(seen(normalize(Vec3f{1, 1, 0})).r, 0.5F, 1e-4F);
}

// ---- projections

TEST(UvProjection, WrapsAroundShapes) {
    TestNode node = node_of("uv_projection");
    show_uv(node, "projection_color");
    TestContext context;
    const auto seen = [&](std::int32_t type, Vec3f p) {
        node.set_enum("projection_type", type);
        node.type().prepare(node.block(), context);
        const Color c = color(node, p);
        return Vec2f{c.r, c.g};
    };
    const auto expect_uv = [&](std::int32_t type, Vec3f p, float u, float v) {
        const Vec2f uv = seen(type, p);
        EXPECT_NEAR(uv.x, u, 1e-5F) << type;
        EXPECT_NEAR(uv.y, v, 1e-5F) << type;
    };
    enum { Planar, Spherical, Cylindrical, Ball, Cubic, Shrinkwrap };
    expect_uv(Planar, {0.5F, -0.5F, 9}, 0.75F, 0.25F);
    expect_uv(Spherical, {0, 0, 2}, 0.5F, 0.5F);
    expect_uv(Spherical, {1, 0, 1}, 0.75F, 0.5F);  // 45 of 180 degrees
    expect_uv(Spherical, {0, 1, 1}, 0.5F, 1);      // 45 of 90 degrees
    expect_uv(Cylindrical, {-1, 0.5F, 1}, 0.25F, 0.75F);
    expect_uv(Ball, {0, 0, 3}, 0.5F, 0.5F);
    expect_uv(Ball, {1, 0, 0}, 0.5F + 0.5F * std::sqrt(0.5F), 0.5F);
    expect_uv(Cubic, {1, 0.2F, 0.4F}, 0.7F, 0.6F);
    expect_uv(Cubic, {0.2F, -1, 0.4F}, 0.6F, 0.7F);
    expect_uv(Shrinkwrap, {0, 1, 0}, 0.5F, 0.5F);
    expect_uv(Shrinkwrap, {1, 0, 0}, 0.75F, 0.5F);
    // The matrix places and scales the shape.
    node.set("matrix", Mat4f::scale({2, 2, 2}) * Mat4f::translation({10, 0, 0}));
    expect_uv(Planar, {11, 1, 0}, 0.75F, 0.75F);
    // Outside of a clamped one lies the default.
    node.set("clamp", true).set<Rgba>("default_color", {{7, 8, 9}, 0.5F});
    expect_uv(Planar, {13, 0, 0}, 7, 8);
    expect_uv(Spherical, {13, 0, 0}, 7, 8);
}

TEST(CameraProjection, WithoutACameraAllIsOffScreen) {
    TestNode node = node_of("camera_projection");
    TestContext context;
    node.set<Rgba>("offscreen_color", {{0.25F, 0.5F, 1}, 1});
    node.type().prepare(node.block(), context);
    EXPECT_EQ(color(node, {0, 0, -3}), Color(0.25F, 0.5F, 1));
}

// ---- space_transform

class Turned final : public ShadeServices {
  public:
    [[nodiscard]] bool user_value(const ShadePoint&, Name, ShaderValue&) const override {
        return false;
    }
    [[nodiscard]] bool user_text(const ShadePoint&, Name, Name&) const override { return false; }
    [[nodiscard]] bool uv_set(const ShadePoint&, Name, UvPoint&) const override { return false; }
    [[nodiscard]] Mat4f world_from_object(const ShadePoint&) const override { return matrix; }
    [[nodiscard]] Mat4f object_from_world(const ShadePoint&) const override {
        return matrix.inverse();
    }
    [[nodiscard]] bool triangle(const ShadePoint&, Triangle&) const override { return false; }
    [[nodiscard]] Name shape_name(const ShadePoint&) const override { return {}; }
    [[nodiscard]] bool trace(const ShadePoint&, const Probe&, ProbeHit&) const override {
        return false;
    }
    [[nodiscard]] std::int32_t n_lights() const override { return 0; }
    Mat4f matrix = Mat4f::scale({2, 4, 1}) * Mat4f::translation({1, 2, 3});
};

TEST(SpaceTransform, PointsVectorsAndNormals) {
    enum Space { World, Object, Camera, Screen, Tangent };
    TestNode node = node_of("space_transform");
    node.set<Vec3f>("input", {2, 4, 1}).set_enum("from", Object).set_enum("to", World);
    const Turned services;
    const Mat4f camera = Mat4f::translation({0, 0, -10});
    RayState ray;
    ray.camera_from_world = &camera;
    ShadePoint at = point_at({5, 6, 7}, {1, 0, 0});
    at.services = &services;
    at.ray = &ray;
    TestContext context;
    node.type().prepare(node.block(), context);
    const auto result = [&](std::int32_t type) {
        node.set_enum("type", type);
        const Color c = value(node, at).rgb;
        return Vec3f{c.r, c.g, c.b};
    };
    const auto expect = [&](Vec3f is, Vec3f wanted) {
        EXPECT_LT(length(is - wanted), 1e-4F) << is.x << " " << is.y << " " << is.z;
    };
    expect(result(0), {5, 18, 4});
    expect(result(1), {4, 16, 1});
    expect(result(2), {1, 1, 1});
    node.set_enum("from", World).set_enum("to", Camera);
    expect(result(0), {2, 4, -9});
    node.set_enum("from", Tangent).set_enum("to", World).set<Vec3f>("input", {0, 0, 2});
    expect(result(1), {2, 0, 0});
    expect(result(0), {7, 6, 7});
    node.set("normalize", true).set("scale", 3.0F);
    expect(result(1), {3, 0, 0});
    // Screen space is said to be missing.
    node.set_enum("to", Screen);
    node.type().prepare(node.block(), context);
    EXPECT_EQ(context.count(Code::ParamPending), 1U);
}

}  // namespace
}  // namespace lightsieve
