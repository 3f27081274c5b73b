// What lies between film and direction: apertures, distortion, shift, tilt, maps over the film, rolling shutters.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "core/sobol.h"
#include "nodes/camera/camera_test_support.h"

namespace lightsieve {

NodeType node_fisheye_camera();
NodeType node_ortho_camera();
NodeType node_persp_camera();

namespace {

Vec2f number(std::uint32_t i) { return Sampler(1, 2, i, 5).at2(0); }

// ---- the aperture

/// Parts of lens points by direction around the middle, in `n` equal sectors, and the mean of the squared radius.
struct Spot {
    std::array<double, 36> sectors{};
    double mean_square = 0;
};
Spot spot(const Camera& camera) {
    Spot out;
    constexpr std::uint32_t kSamples = 1U << 16U;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const Vec3f p = camera.ray({0.5F, 0.5F}, number(i), 0).origin;
        const double angle = std::atan2(static_cast<double>(p.y), static_cast<double>(p.x)) /
                             (2 * static_cast<double>(kPi));
        out.sectors[static_cast<std::size_t>((angle < 0 ? angle + 1 : angle) * 35.9999)] +=
            1.0 / kSamples;
        out.mean_square += static_cast<double>(p.x * p.x + p.y * p.y) / kSamples;
    }
    return out;
}

TEST(Aperture, IsEvenlyLitWhateverItsShape) {
    for (const float curvature : {-0.8F, 0.0F, 0.5F, 1.0F}) {
        TestNode node(node_persp_camera());
        node.set_array<float>("aperture_size", {1})
            .set("aperture_blades", std::int32_t{5})
            .set("aperture_blade_curvature", curvature);
        const Spot lit = spot(*make(node));
        // What each sector and the whole spot should be, by summing over angles: r^2 / 2 and r^4 / 4.
        std::array<double, 36> area{};
        double whole = 0, square = 0;
        constexpr int kFine = 3600;
        for (int i = 0; i < kFine; ++i) {
            const double angle = (i + 0.5) / kFine * 2 * static_cast<double>(kPi),
                         sector = 2 * static_cast<double>(kPi) / 5,
                         inside = angle - std::floor(angle / sector) * sector - sector / 2;
            const double edge = std::lerp(std::cos(sector / 2) / std::cos(inside), 1.0,
                                          static_cast<double>(curvature));
            area[static_cast<std::size_t>(i / 100)] += edge * edge / 2;
            whole += edge * edge / 2;
            square += edge * edge * edge * edge / 4;
        }
        for (std::size_t i = 0; i < area.size(); ++i)
            EXPECT_NEAR(lit.sectors[i], area[i] / whole, 1.5e-3) << curvature << " " << i;
        EXPECT_NEAR(lit.mean_square, square / whole, 2e-3) << curvature;
    }
}

TEST(Aperture, RatioStretchesUpAndRotationTurns) {
    TestNode node(node_persp_camera());
    node.set_array<float>("aperture_size", {2}).set("aperture_aspect_ratio", 3.0F);
    float widest = 0, highest = 0;
    const auto measure = [&] {
        const auto camera = make(node);
        widest = highest = 0;
        for (std::uint32_t i = 0; i < 4096; ++i) {
            const Vec3f p = camera->ray({0.5F, 0.5F}, number(i), 0).origin;
            widest = std::max(widest, std::abs(p.x));
            highest = std::max(highest, std::abs(p.y));
        }
    };
    measure();
    EXPECT_NEAR(widest, 2, 0.02);
    EXPECT_NEAR(highest, 6, 0.06);
    // A square on its corner, then on its side.
    node.set("aperture_aspect_ratio", 1.0F).set("aperture_blades", std::int32_t{4});
    measure();
    EXPECT_NEAR(widest, 2, 0.05);
    node.set("aperture_rotation", 45.0F);
    measure();
    EXPECT_NEAR(widest, std::sqrt(2.0F), 0.02);
}

TEST(Aperture, FocusIsAPlaneOrASphere) {
    TestNode node(node_persp_camera());
    node.set_array<float>("aperture_size", {0.5F}).set_array<float>("focus_distance", {4});
    const auto sharp_at = [&](bool flat) {
        node.set("flat_field_focus", flat);
        const auto camera = make(node);
        const CameraRay a = camera->ray({0.9F, 0.5F}, {0.1F, 0.2F}, 0),
                        b = camera->ray({0.9F, 0.5F}, {0.7F, 0.9F}, 0);
        // Where both rays meet.
        const Vec3f n = cross(a.direction, b.direction), between = b.origin - a.origin;
        const float t = dot(cross(between, b.direction), n) / length_squared(n);
        return a.origin + a.direction * t;
    };
    EXPECT_NEAR(sharp_at(true).z, -4, 1e-3);
    EXPECT_NEAR(length(sharp_at(false)), 4, 1e-3);
}

TEST(Aperture, HostileLensesStayFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const NodeType& type : {node_persp_camera(), node_fisheye_camera()})
        for (const float bad : {nan, -1.0F, 1e30F}) {
            TestNode node(type);
            node.set_array<float>("aperture_size", {0.1F})
                .set("aperture_blades", std::int32_t{2000000000})
                .set("aperture_blade_curvature", bad)
                .set("aperture_rotation", bad)
                .set("aperture_aspect_ratio", bad);
            const auto camera = make(node);
            for (std::uint32_t i = 0; i < 50; ++i) {
                const CameraRay ray = camera->ray({0.4F, 0.6F}, number(i), 0);
                EXPECT_TRUE(is_finite(ray.origin) && is_finite(ray.direction)) << bad;
            }
        }
}

// ---- distortion, shift, tilt

TEST(PerspCamera, DistortionMovesTheEdgesOutward) {
    TestNode node(node_persp_camera());
    node.set_array<float>("radial_distortion", {0.2F});
    const auto tangents = [](const Camera& camera, Vec2f film) {
        const Vec3f d = camera.ray(film, {}, 0).direction;
        return Vec2f{d.x / -d.z, d.y / -d.z};
    };
    const float tan_half = std::tan(deg_to_rad(30));
    // Screen (0.8, 0.4 * 0.75): r^2 = 0.73.
    const Vec2f out = tangents(*make(node), {0.9F, 0.3F});
    EXPECT_NEAR(out.x, 0.8F * 1.146F * tan_half, 1e-5F);
    EXPECT_NEAR(out.y, 0.3F * 1.146F * tan_half, 1e-5F);
    // The inverse undoes it: a point that cubic shows at r is shown there.
    for (const float k : {0.2F, 2.0F, -0.1F}) {
        node.set_array<float>("radial_distortion", {k}).set_enum("radial_distortion_type", 1);
        const Vec2f in = tangents(*make(node), {0.9F, 0.3F});
        const float x = in.x / tan_half, y = in.y / tan_half, grow = 1 + k * (x * x + y * y);
        EXPECT_NEAR(x * grow, 0.8F, 1e-5F) << k;
        EXPECT_NEAR(y * grow, 0.3F, 1e-5F) << k;
    }
    // Beyond the fold of a strong pincushion there is nothing new to see, but no hole either.
    node.set_array<float>("radial_distortion", {-0.9F});
    EXPECT_TRUE(is_finite(make(node)->ray({0, 0}, {}, 0).direction));
}

TEST(PerspCamera, ShiftMovesTheFrame) {
    TestNode node(node_persp_camera());
    const auto plain = make(node);
    node.set_array<Vec2f>("lens_shift", {{1, 0.5F}});
    const auto shifted = make(node);
    // The middle is where the right edge was, half way to the lower one.
    expect_near(shifted->ray({0.5F, 0.5F}, {}, 0).direction,
                plain->ray({1, 0.75F}, {}, 0).direction);
}

TEST(PerspCamera, TiltMakesUprightLinesUpright) {
    // A camera that looks up by 20 degrees, with a tilt of 20: points above one another share their film x.
    TestNode node(node_persp_camera());
    const float angle = deg_to_rad(20);
    node.set_array<Vec3f>("look_at", {{0, std::sin(angle), -std::cos(angle)}})
        .set_array<Vec2f>("lens_tilt_angle", {{0, 20}});
    const auto camera = make(node);
    const Vec3f low = camera->ray({0.8F, 0.9F}, {}, 0).direction,
                high = camera->ray({0.8F, 0.1F}, {}, 0).direction;
    EXPECT_NEAR(low.x / -low.z, high.x / -high.z, 1e-5F);
    EXPECT_GT(high.y, low.y + 0.3F);
    // And across: a camera that looks to the right.
    TestNode across(node_persp_camera());
    across.set_array<Vec3f>("look_at", {{std::sin(angle), 0, -std::cos(angle)}})
        .set_array<Vec2f>("lens_tilt_angle", {{20, 0}});
    const auto turned = make(across);
    const Vec3f left = turned->ray({0.1F, 0.2F}, {}, 0).direction,
                right = turned->ray({0.9F, 0.2F}, {}, 0).direction;
    EXPECT_NEAR(left.y / -left.z, right.y / -right.z, 1e-5F);
    // Tilted out of sight: nothing, not a ray backward.
    across.set_array<Vec2f>("lens_tilt_angle", {{90, 0}}).set_array<float>("fov", {150});
    EXPECT_EQ(
        make(across)->ray({0, 0.5F}, {}, 0).weight * make(across)->ray({1, 0.5F}, {}, 0).weight,
        0);
}

// ---- maps over the film

TEST(Film, FiltermapWeighsTheFrame) {
    const int any = 0;
    TestNode node(node_ortho_camera());
    TestContext context;
    context.shader = [](const ShadePoint& at) {
        return at.uv.x < 0.25F ? Color{-1, 0, 0} : Color{at.uv.x, at.uv.x, 4 * at.uv.y};
    };
    // Any node will do: the test's surroundings evaluate the shader.
    node.set("filtermap", NodeRef{reinterpret_cast<const NodeInstance*>(&any)})
        .set("exposure", 1.0F);
    const auto camera = make(node, context);
    // Film y runs down, v up.
    EXPECT_NEAR(camera->ray({0.5F, 0.25F}, {}, 0).weight, 2 * (0.5F + 0.5F + 3) / 3, 1e-5F);
    EXPECT_EQ(camera->ray({0.1F, 0.25F}, {}, 0).weight, 0);
}

TEST(Film, RemapLooksElsewhere) {
    TestNode node(node_persp_camera());
    const auto plain = make(node);
    TestContext context;
    context.shader = [](const ShadePoint& at) { return Color{at.uv.y, 0.25F * at.uv.x, 7}; };
    EXPECT_EQ(make(node, context)->ray({0.3F, 0.2F}, {}, 0).direction,
              plain->ray({0.3F, 0.2F}, {}, 0).direction)
        << "not linked";
    context.linked.insert("uv_remap");
    // u = 0.3, v = 0.8 becomes u = 0.8, v = 0.075.
    expect_near(make(node, context)->ray({0.3F, 0.2F}, {}, 0).direction,
                plain->ray({0.8F, 0.925F}, {}, 0).direction);
}

// ---- rolling shutter

TEST(RollingShutter, LinesFollowOneAnother) {
    TestNode node(node_ortho_camera());
    node.set("rolling_shutter_duration", 0.25F);
    // Off: the whole frame at once.
    EXPECT_EQ(make(node)->sample_time({0.9F, 0.1F}, 0.4F), 0.4F);
    struct Case {
        std::int32_t from;
        float first;  // the time at which the upper left pixel is exposed, of an instant
    };
    for (const Case c : {Case{1, 0.1F}, Case{2, 0.9F}, Case{3, 0.2F}, Case{4, 0.8F}}) {
        node.set_enum("rolling_shutter", c.from);
        const auto camera = make(node);
        for (const float u : {0.0F, 0.5F, 0.9F})
            EXPECT_NEAR(camera->sample_time({0.2F, 0.1F}, u), 0.75F * c.first + 0.25F * u, 1e-6F)
                << c.from;
        // Overscan keeps to the shutter.
        for (const Vec2f film : {Vec2f{-1, -1}, Vec2f{2, 2}}) {
            EXPECT_GE(camera->sample_time(film, 0), 0);
            EXPECT_LT(camera->sample_time(film, 0.99999F), 1);
        }
    }
    // The curve of the shutter is that of each line.
    node.set_enum("rolling_shutter", 1).set_enum("shutter_type", 1);
    EXPECT_NEAR(make(node)->sample_time({0.2F, 0.4F}, 0.02F), 0.75F * 0.4F + 0.25F * 0.1F, 1e-5F);
    // Nonsense is taken as an instant.
    node.set("rolling_shutter_duration", std::numeric_limits<float>::quiet_NaN());
    EXPECT_NEAR(make(node)->sample_time({0.2F, 0.4F}, 0.7F), 0.4F, 1e-6F);
}

}  // namespace
}  // namespace lightsieve
