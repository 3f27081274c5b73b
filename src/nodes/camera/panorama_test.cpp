// Cameras that look to all sides: which direction belongs to which place of the film.
#include <gtest/gtest.h>

#include "nodes/camera/camera_test_support.h"

namespace lightsieve {

NodeType node_cyl_camera();
NodeType node_fisheye_camera();
NodeType node_spherical_camera();
NodeType node_vr_camera();

namespace {

Vec3f direction(const Camera& camera, float x, float y) {
    return camera.ray({x, y}, {}, 0).direction;
}

TEST(FisheyeCamera, DistanceIsAngle) {
    TestNode node(node_fisheye_camera());
    node.set_array<float>("fov", {180});
    const auto camera = make(node);
    expect_near(direction(*camera, 0.5F, 0.5F), {0, 0, -1});
    // The circle touches the upper and the lower edge: 60 pixels are 90 degrees.
    expect_near(direction(*camera, 0.5F, 0), {0, 1, 0});
    expect_near(direction(*camera, 0.5F + 60.0F / 160, 0.5F), {1, 0, 0});
    for (const float angle_deg : {10.0F, 45.0F, 80.0F}) {
        const float angle = deg_to_rad(angle_deg), pixels = 60 * angle_deg / 90;
        expect_near(direction(*camera, 0.5F - pixels / 160, 0.5F),
                    {-std::sin(angle), 0, -std::cos(angle)});
    }
    EXPECT_EQ(camera->ray({0.1F, 0.5F}, {}, 0).weight, 0) << "outside of the circle";
    EXPECT_NEAR(camera->ray({0.5F, 0.5F}, {}, 0).spread, deg_to_rad(90.0F / 60), 1e-5F);
}

TEST(FisheyeCamera, AutocropReachesTheCorners) {
    TestNode node(node_fisheye_camera());
    node.set_array<float>("fov", {120}).set("autocrop", true);
    const auto camera = make(node);
    EXPECT_NEAR(direction(*camera, 0, 0).z, -std::cos(deg_to_rad(60)), 1e-5F);
    EXPECT_GT(camera->ray({0.001F, 0.999F}, {}, 0).weight, 0);
    // Half way to the corner.
    EXPECT_NEAR(direction(*camera, 0.25F, 0.75F).z, -std::cos(deg_to_rad(30)), 1e-5F);
}

TEST(FisheyeCamera, LensKeepsItsFocus) {
    TestNode node(node_fisheye_camera());
    node.set_array<float>("fov", {300})
        .set_array<float>("aperture_size", {0.5F})
        .set_array<float>("focus_distance", {4});
    const auto blurred = make(node);
    node.set_array<float>("aperture_size", {0});
    const auto sharp = make(node);
    for (const Vec2f film : {Vec2f{0.5F, 0.5F}, Vec2f{0.7F, 0.2F}, Vec2f{0.3F, 0.1F}}) {
        const Vec3f focus = sharp->ray(film, {}, 0).direction * 4;
        for (const Vec2f u : {Vec2f{0.1F, 0.9F}, Vec2f{0.8F, 0.3F}}) {
            const CameraRay ray = blurred->ray(film, u, 0);
            EXPECT_GT(length(ray.origin), 0.1F);
            expect_near(normalize(focus - ray.origin), ray.direction, 1e-5F);
        }
    }
}

TEST(SphericalCamera, LongitudeAndLatitude) {
    const auto camera = make(TestNode(node_spherical_camera()));
    expect_near(direction(*camera, 0.5F, 0.5F), {0, 0, -1});
    expect_near(direction(*camera, 0.75F, 0.5F), {1, 0, 0});
    expect_near(direction(*camera, 0.25F, 0.5F), {-1, 0, 0});
    expect_near(direction(*camera, 0, 0.5F), {0, 0, 1});
    expect_near(direction(*camera, 0.5F, 0), {0, 1, 0});
    expect_near(direction(*camera, 0.75F, 0.75F), normalize(Vec3f{1, -1, 0}));
    EXPECT_NEAR(camera->ray({0.5F, 0.5F}, {}, 0).spread, 2 * kPi / 160, 1e-5F);
    // Clipping planes are spheres.
    TestNode node(node_spherical_camera());
    node.set("near_clip", 2.0F).set_enum("handedness", 1);
    EXPECT_NEAR(make(node)->ray({0.1F, 0.9F}, {}, 0).t_min, 2, 1e-5F);
    expect_near(direction(*make(node), 0.75F, 0.5F), {-1, 0, 0});
}

TEST(CylCamera, LongitudeAcrossTangentUpward) {
    TestNode node(node_cyl_camera());
    node.set_array<float>("horizontal_fov", {360})
        .set_array<float>("vertical_fov", {90})
        .set("projective", false);
    const auto pinhole = make(node);
    expect_near(direction(*pinhole, 0.5F, 0.5F), {0, 0, -1});
    expect_near(direction(*pinhole, 0.75F, 0.5F), {1, 0, 0});
    expect_near(direction(*pinhole, 0.25F, 0), normalize(Vec3f{-1, 1, 0}));
    expect_near(direction(*pinhole, 0.5F, 0.75F), normalize(Vec3f{0, -0.5F, -1}));
    expect_near(pinhole->ray({0.3F, 0.1F}, {}, 0).origin, {});
    node.set("projective", true);
    const CameraRay parallel = make(node)->ray({0.75F, 0.25F}, {}, 0);
    expect_near(parallel.direction, {1, 0, 0});
    expect_near(parallel.origin, {0, 0.5F, 0});
}

TEST(VrCamera, EyesStandBesideTheRay) {
    TestNode node(node_vr_camera());
    node.set("eye_separation", 0.6F).set("eye_to_neck", 0.25F);
    const auto pair = make(node);
    // Left half: the left eye's whole sphere.
    const CameraRay left = pair->ray({0.25F, 0.5F}, {}, 0),
                    right = pair->ray({0.75F, 0.5F}, {}, 0);
    expect_near(left.direction, {0, 0, -1});
    expect_near(right.direction, {0, 0, -1});
    expect_near(left.origin, {-0.3F, 0, -0.25F});
    expect_near(right.origin, {0.3F, 0, -0.25F});
    // Looking to the right the right eye is behind.
    const CameraRay aside = pair->ray({0.5F + 0.75F / 2, 0.5F}, {}, 0);
    expect_near(aside.direction, {1, 0, 0});
    expect_near(aside.origin, {0.25F, 0, 0.3F});
    node.set_enum("mode", 1);
    expect_near(make(node)->ray({0.5F, 0.25F}, {}, 0).origin, {-0.3F, 0, -0.25F});
    node.set_enum("mode", 2);
    expect_near(make(node)->ray({0.5F, 0.5F}, {}, 0).origin, {-0.3F, 0, -0.25F});
    node.set_enum("mode", 3);
    expect_near(make(node)->ray({0.5F, 0.5F}, {}, 0).origin, {0.3F, 0, -0.25F});
}

TEST(VrCamera, EyesComeTogetherAtThePoles) {
    TestNode node(node_vr_camera());
    node.set("eye_separation", 2.0F).set_enum("mode", 3).set("top_merge_angle", 60.0F);
    node.set("bottom_merge_angle", 20.0F);  // below the top one: raised to it
    const auto apart = [&](float y) { return length(make(node)->ray({0.4F, y}, {}, 0).origin); };
    const float quarter = std::cos(kPi / 4);
    EXPECT_NEAR(apart(60.0F / 180), 1, 1e-4F);
    EXPECT_NEAR(apart(30.0F / 180), quarter, 1e-4F);
    EXPECT_NEAR(apart(1e-6F), 0, 1e-3F);
    EXPECT_NEAR(apart(120.0F / 180), quarter, 1e-4F) << "60 of 120 degrees to the nadir";
    node.set_enum("top_merge_mode", 0).set_enum("bottom_merge_mode", 2);
    EXPECT_NEAR(apart(0.05F), 1, 1e-4F);
    TestContext context;
    context.shader = [](const ShadePoint& at) { return Color::grey(at.uv.x); };
    EXPECT_NEAR(length(make(node, context)->ray({0.4F, 0.9F}, {}, 0).origin), 0.6F, 1e-4F);
    EXPECT_EQ(context.diagnostics().items().size(), 0U) << context.diagnostics().render();
}

TEST(VrCamera, CubeMaps) {
    TestNode node(node_vr_camera());
    node.set_enum("mode", 2).set_enum("projection", 1);
    const Vec3f faces[]{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}};
    const auto row = make(node);
    for (int i = 0; i < 6; ++i)
        expect_near(direction(*row, (static_cast<float>(i) + 0.5F) / 6, 0.5F), faces[i]);
    node.set_enum("projection", 2);
    const auto block = make(node);
    for (int i = 0; i < 6; ++i)
        expect_near(
            direction(*block, (static_cast<float>(i % 3) + 0.5F) / 3, i < 3 ? 0.25F : 0.75F),
            faces[i]);
    // Neighbours: the front's edges are those of the right, left, up and down.
    const float e = 1e-4F;
    expect_near(direction(*row, 5.0F / 6 - e, 0.5F), normalize(Vec3f{1, 0, -1}), 5e-3F);
    expect_near(direction(*row, e, 0.5F), normalize(Vec3f{1, 0, -1}), 5e-3F);
    expect_near(direction(*row, 2.5F / 6, 1 - e), normalize(Vec3f{0, 1, -1}), 5e-3F);
    expect_near(direction(*row, 3.5F / 6, e), normalize(Vec3f{0, -1, -1}), 5e-3F);
}

}  // namespace
}  // namespace lightsieve
