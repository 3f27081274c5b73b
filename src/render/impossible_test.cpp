// Rays and placements beyond what the ray library can take, pictures beyond what memory can: nothing ends the program.
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "render/accel.h"
#include "render/testing/test_scene.h"

namespace lightsieve::testing {
namespace {

/// A ball of radius 1 around the origin.
ShapeGeometry ball() {
    ShapeGeometry geometry;
    geometry.data = SphereList{{{Vec3f{0, 0, 0}}}, {1}};
    return geometry;
}

Ray towards_it(Vec3f origin) {
    Ray ray;
    ray.origin = origin;
    ray.direction = {0, 0, -1};
    return ray;
}

TEST(ImpossibleRays, MeetNothing) {
    const ShapeGeometry geometry = ball();
    const std::vector<Mat4f> here(1);
    const std::vector<AccelObject> objects{{&geometry, here, 1}};
    const Accel accel(objects, "");
    RayHit hit;
    ASSERT_TRUE(accel.intersect(towards_it({0, 0, 5}), 1, hit));
    EXPECT_FLOAT_EQ(hit.t, 4);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float odd : {nan, kInfinity, -kInfinity, 3e38F, 1e19F}) {
        Ray ray = towards_it({odd, 0, 5});
        EXPECT_FALSE(accel.intersect(ray, 1, hit)) << odd;
        EXPECT_FALSE(accel.occluded(ray, 1)) << odd;
        ray = towards_it({0, 0, 5});
        ray.direction.y = odd;
        EXPECT_FALSE(accel.intersect(ray, 1, hit)) << odd;
        EXPECT_FALSE(accel.occluded(ray, 1)) << odd;
    }
    Ray ray = towards_it({0, 0, 5});
    ray.t_max = nan;
    EXPECT_FALSE(accel.intersect(ray, 1, hit));
    EXPECT_FALSE(accel.occluded(ray, 1));
}

TEST(ImpossibleRays, ShapesThatArePlacedAsNothingAreLeftOut) {
    for (const char* matrix :
         {"1e-38 0 0 0 0 1e-38 0 0 0 0 1e-38 0 0 0 0 1", "1 0 0 0 0 1e-9 0 0 0 0 1 0 0 0 0 1",
          "1 0 0 0 0 1 0 0 0 0 1 0 1e38 0 0 1"})
        for (const char* shape : {"sphere", "disk", "cylinder"}) {
            const TestScene scene(frame_text(4, 4, 1, persp_camera({0, 0, 5}, {0, 0, 0}, 40)) +
                                      node(shape, "odd", std::string(" matrix ") + matrix),
                                  in_memory(), {"shrinks it to nothing"});
            EXPECT_EQ(summarize(scene.scene()).n_shapes, 0U) << shape << matrix;
            EXPECT_EQ(scene.diagnostics().n_warnings(), 1U);
        }
}

TEST(ImpossibleRays, CamerasThatSendThemGiveABlackPicture) {
    const std::string cameras[] = {
        node("persp_camera", "cam", " far_clip nan"),
        node("persp_camera", "cam", " aperture_size inf"),
        node("ortho_camera", "cam", " matrix 1 0 0 0 0 1 0 0 0 0 1 0 1e38 1e38 1e38 1")};
    for (const std::string& camera : cameras) {
        const Picture picture =
            render(frame_text(4, 4, 1, camera) + node("sphere", "ball", " radius 1"));
        EXPECT_EQ(picture.mean_alpha("RGBA"), 0) << camera;
    }
}

TEST(ImpossiblePictures, LayersThatDoNotFitIntoMemoryAreRefusedBeforeTheFirstRay) {
    RenderOptions options = in_memory();
    for (int i = 0; i < 100; ++i)
        options.lpes.push_back("a" + std::to_string(i) + " C.*");
    const TestScene scene(frame_text(32768, 32768, 1, persp_camera({0, 0, 5}, {0, 0, 0}, 40)),
                          options);
    try {
        static_cast<void>(render(scene));
        FAIL() << "100 layers of 2^30 pixels fit into memory";
    } catch (const InputError& e) {
        EXPECT_EQ(e.errors().at(0).code, Code::LimitMemory);
    }
}

}  // namespace
}  // namespace lightsieve::testing
