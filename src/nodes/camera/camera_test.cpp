#include <gtest/gtest.h>

#include <limits>

#include "nodes/camera/camera_test_support.h"

namespace lightsieve {

NodeType node_cyl_camera();
NodeType node_fisheye_camera();
NodeType node_ortho_camera();
NodeType node_persp_camera();
NodeType node_spherical_camera();
NodeType node_vr_camera();

namespace {

/// Direction by the formula of the scene format, for a frame of 160 x 120.
Vec3f formula(float sx, float sy, float fov_deg, float pixel_aspect) {
    const float t = std::tan(fov_deg * kPi / 360);
    return normalize(Vec3f{sx * t, sy * t * (120.0F / 160.0F) / pixel_aspect, -1});
}

TEST(PerspCamera, DirectionsFollowTheFormula) {
    TestNode node(node_persp_camera());
    node.set_array<float>("fov", {54.4322243F});
    for (const float aspect : {1.0F, 1.33333325F}) {
        TestContext context;
        context.size.pixel_aspect_ratio = aspect;
        const auto camera = make(node, context);
        expect_near(camera->ray({0.5F, 0.5F}, {}, 0).direction, {0, 0, -1});
        // Film x to the right, film y down; the upper left corner is sx = -1, sy = 1.
        expect_near(camera->ray({0, 0}, {}, 0).direction, formula(-1, 1, 54.4322243F, aspect));
        expect_near(camera->ray({0.75F, 0.9F}, {}, 0).direction,
                    formula(0.5F, -0.8F, 54.4322243F, aspect));
        expect_near(camera->ray({1.5F, 0.5F}, {}, 0).direction,
                    formula(2, 0, 54.4322243F, aspect));
    }
}

TEST(PerspCamera, MatrixPlacesTheEye) {
    TestNode node(node_persp_camera());
    // Looks along +x, up stays y: rows are the images of x, y, z, then the place.
    Mat4f m;
    m.m = {{{0, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 0, 0}, {5, 6, 7, 1}}};
    node.set_array<Mat4f>("matrix", {m});
    const auto camera = make(node);
    const CameraRay ray = camera->ray({0.5F, 0.5F}, {}, 0);
    expect_near(ray.origin, {5, 6, 7});
    expect_near(ray.direction, {1, 0, 0});
    expect_near(camera->camera_from_world(0).point({7, 6, 7}), {0, 0, -2});
}

TEST(PerspCamera, LookAtIsUsedWithoutMatrix) {
    TestNode node(node_persp_camera());
    node.set_array<Vec3f>("position", {{0, 0, 10}})
        .set_array<Vec3f>("look_at", {{10, 0, 10}})
        .set_array<Vec3f>("up", {{0, 0, 1}});
    const auto camera = make(node);
    expect_near(camera->ray({0.5F, 0.5F}, {}, 0).direction, {1, 0, 0});
    EXPECT_GT(camera->ray({0.5F, 0}, {}, 0).direction.z,
              0);  // the top of the picture is toward `up`
    EXPECT_LT(camera->ray({1, 0.5F}, {}, 0).direction.y, 0);
}

TEST(PerspCamera, LeftHandednessMirrors) {
    TestNode node(node_persp_camera());
    const Vec3f right = make(node)->ray({0.9F, 0.3F}, {}, 0).direction;
    node.set_enum("handedness", 1);
    const Vec3f left = make(node)->ray({0.9F, 0.3F}, {}, 0).direction;
    expect_near(left, {-right.x, right.y, right.z});
}

TEST(PerspCamera, ScreenWindowCropsAndShifts) {
    TestNode node(node_persp_camera());
    const Vec3f there = make(node)->ray({0.75F, 0.25F}, {}, 0).direction;
    node.set_array<Vec2f>("screen_window_min", {{0, 0}})
        .set_array<Vec2f>("screen_window_max", {{1, 1}});
    expect_near(make(node)->ray({0.5F, 0.5F}, {}, 0).direction, there);
}

TEST(PerspCamera, KeysMoveOnTheClockOfTheShutter) {
    TestNode node(node_persp_camera());
    node.set_array<Mat4f>("matrix",
                          {Mat4f::translation({0, 0, 0}), Mat4f::translation({4, 0, 0}),
                           Mat4f::translation({4, 8, 0})},
                          3);
    node.set("motion_start", -1.0F)
        .set("motion_end", 1.0F)
        .set("shutter_start", -0.5F)
        .set("shutter_end", 0.5F);
    const auto camera = make(node);
    EXPECT_EQ(camera->shutter_start(), -0.5F);
    EXPECT_EQ(camera->shutter_end(), 0.5F);
    // Clock -0.5 lies in the middle of keys -1 and 0, clock 0 on the second key, clock 0.25 a quarter behind it.
    expect_near(camera->ray({0.5F, 0.5F}, {}, 0).origin, {2, 0, 0});
    expect_near(camera->ray({0.5F, 0.5F}, {}, 0.5F).origin, {4, 0, 0});
    expect_near(camera->ray({0.5F, 0.5F}, {}, 0.75F).origin, {4, 2, 0});
    // An interval of no length: the first key holds.
    node.set("motion_start", 0.0F).set("motion_end", 0.0F);
    expect_near(make(node)->ray({0.5F, 0.5F}, {}, 0.75F).origin, {0, 0, 0});
}

TEST(PerspCamera, FieldOfViewHasKeys) {
    TestNode node(node_persp_camera());
    node.set_array<float>("fov", {40, 80}, 2).set("shutter_end", 1.0F);
    expect_near(make(node)->ray({1, 0.5F}, {}, 0.5F).direction, formula(1, 0, 60, 1));
}

TEST(PerspCamera, LensKeepsThePointInFocus) {
    TestNode node(node_persp_camera());
    node.set_array<float>("aperture_size", {0.5F}).set_array<float>("focus_distance", {4});
    const auto camera = make(node);
    const Vec2f film{0.8F, 0.3F};
    const Vec3f sharp = camera->ray(film, {0.5F, 0.5F}, 0).direction;
    const Vec3f focus = sharp * (4 / -sharp.z);
    float widest = 0;
    for (int i = 0; i < 64; ++i) {
        const CameraRay ray =
            camera->ray(film, {static_cast<float>(i % 8) / 8, static_cast<float>(i / 8) / 8}, 0);
        widest = std::max(widest, length(ray.origin));
        expect_near(ray.origin + ray.direction * (length(focus - ray.origin)), focus, 1e-4F);
    }
    EXPECT_LE(widest, 0.5F + 1e-6F);
    EXPECT_GT(widest, 0.35F);
}

TEST(PerspCamera, ApertureBladesMakeAPolygon) {
    TestNode node(node_persp_camera());
    node.set_array<float>("aperture_size", {1}).set("aperture_blades", std::int32_t{4});
    const auto outside = [](Vec3f p) {
        return std::abs(p.x) + std::abs(p.y) - 1;
    };  // of the square with corners on the axes
    float most = -1;
    const auto visit = [&](const Camera& camera) {
        most = -1;
        for (int i = 0; i < 400; ++i)
            most = std::max(most, outside(camera
                                              .ray({0.5F, 0.5F},
                                                   {static_cast<float>(i % 20) / 20,
                                                    static_cast<float>(i / 20) / 20},
                                                   0)
                                              .origin));
    };
    visit(*make(node));
    EXPECT_NEAR(most, 0, 0.06);
    node.set("aperture_blade_curvature", 1.0F);
    visit(*make(node));
    EXPECT_NEAR(most, std::sqrt(2.0F) - 1, 0.06);
}

TEST(PerspCamera, ClippingPlanesAreDepths) {
    TestNode node(node_persp_camera());
    node.set("near_clip", 2.0F).set("far_clip", 50.0F).set("exposure", 3.0F);
    const auto camera = make(node);
    const CameraRay ray = camera->ray({0, 0}, {}, 0);
    EXPECT_NEAR(-ray.direction.z * ray.t_min, 2, 1e-5);
    EXPECT_NEAR(-ray.direction.z * ray.t_max, 50, 1e-3);
    EXPECT_EQ(ray.weight, 8);
}

TEST(PerspCamera, SpreadIsTheAngleOfAPixel) {
    const auto camera = make(TestNode(node_persp_camera()));
    const float half_pixel = 0.5F / 160;
    const Vec3f a = camera->ray({0.5F - half_pixel, 0.5F}, {}, 0).direction,
                b = camera->ray({0.5F + half_pixel, 0.5F}, {}, 0).direction;
    EXPECT_NEAR(camera->ray({0.5F, 0.5F}, {}, 0).spread, length(a - b), 1e-6);
}

TEST(OrthoCamera, RaysAreParallelInSceneUnits) {
    TestNode node(node_ortho_camera());
    node.set_array<Vec2f>("screen_window_min", {{-15, -15}})
        .set_array<Vec2f>("screen_window_max", {{15, 15}});
    TestContext context;
    context.size.pixel_aspect_ratio = 1.25F;
    const auto camera = make(node, context);
    const CameraRay corner = camera->ray({0, 0}, {}, 0);
    expect_near(corner.direction, {0, 0, -1});
    expect_near(corner.origin, {-15, 15 * 0.75F / 1.25F, 0}, 1e-4F);
    EXPECT_NEAR(corner.width, 30.0 / 160, 1e-6);
    EXPECT_EQ(corner.spread, 0);
}

TEST(CameraShutter, TypesShapeTheTimes) {
    TestNode node(node_ortho_camera());
    EXPECT_EQ(make(node)->sample_time({}, 0.3F), 0.3F);
    node.set_enum("shutter_type", 1);
    // Triangle: the area up to t <= 1/2 is 2 t^2.
    EXPECT_NEAR(make(node)->sample_time({}, 0.02F), 0.1F, 1e-5);
    EXPECT_NEAR(make(node)->sample_time({}, 0.5F), 0.5F, 1e-5);
    EXPECT_NEAR(make(node)->sample_time({}, 0.98F), 0.9F, 1e-5);
    node.set_enum("shutter_type", 2)
        .set_array<Vec2f>("shutter_curve", {{0.25F, 1}, {0.5F, 1}, {0.5F, 3}, {0.75F, 3}});
    EXPECT_NEAR(make(node)->sample_time({}, 0.125F), 0.375F, 1e-5);
    EXPECT_NEAR(make(node)->sample_time({}, 0.625F), 0.625F, 1e-5);
    EXPECT_LT(make(node)->sample_time({}, 0x1.fffffep-1F), 1);
    node.set_array<Vec2f>("shutter_curve", {{0.5F, 1}, {0.25F, 1}});
    TestContext context;
    EXPECT_EQ(make(node, context)->sample_time({}, 0.3F), 0.3F);
    EXPECT_EQ(context.count(Code::InvalidValue), 1U);
}

TEST(Cameras, BadPlacementIsAnError) {
    for (const NodeType& type : {node_persp_camera(), node_ortho_camera(), node_fisheye_camera(),
                                 node_spherical_camera(), node_cyl_camera(), node_vr_camera()}) {
        TestNode node(type);
        for (const Mat4f& bad :
             {Mat4f::scale({1, 1, 0}),
              Mat4f::translation({std::numeric_limits<float>::quiet_NaN(), 0, 0})}) {
            node.set_array<Mat4f>("matrix", {bad});
            TestContext context;
            EXPECT_NE(make(node, context), nullptr);
            EXPECT_TRUE(context.diagnostics().has_errors());
        }
    }
}

}  // namespace
}  // namespace lightsieve
