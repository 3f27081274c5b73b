// Luminaires from IES files on the bench of light_test_support.h.
#include <filesystem>
#include <fstream>

#include "io/testing/test_folder.h"
#include "nodes/light/light_test_support.h"

namespace lightsieve {

NodeType node_photometric_light();
NodeType node_point_light();

namespace {

using namespace light_test;

class PhotometricLights : public FolderTest {
  protected:
    /// A light with a file of type C with these angles and values.
    Bench bench(const std::string& counts, const std::string& numbers) {
        std::ofstream(in_folder("lamp.ies"))
            << "TILT=NONE\n1 1 1 " << counts << " 1 1 0 0 0\n1 1 1\n"
            << numbers;
        Bench b(node_photometric_light());
        b.node.set("filename", Name(in_folder("lamp.ies")));
        return b;
    }
};

TEST_F(PhotometricLights, AnEvenOneIsAPointLight) {
    Bench even = bench("2 1", "0 180\n0\n250 250");
    even.node.set("intensity", 0.02F);
    even.matrix(placed({1, 4, 2})).make();
    Bench point(node_point_light());
    point.node.set("intensity", 5.0F);
    point.matrix(placed({1, 4, 2})).make();
    for (const Vec3f from : {Vec3f{0, 0, 0}, Vec3f{3, 9, -1}, Vec3f{1, 4.01F, 2}}) {
        const LightSample a = even.light->sample(from, {}), b = point.light->sample(from, {});
        EXPECT_TRUE(a.delta);
        EXPECT_EQ(a.distance, b.distance);
        expect_near(a.radiance, b.radiance, 1e-5F);
    }
    EXPECT_NEAR(even.light->bounds().intensity, point.light->bounds().intensity, 1e-5F);
}

TEST_F(PhotometricLights, TheBeamIsAlongTheLight) {
    // 100 ahead, 40 to the side, 10 behind; brighter at horizontal angle 0 than at 90.
    Bench b = bench("3 2", "0 90 180\n0 90\n100 40 10\n100 20 10");
    b.make();
    EXPECT_NEAR(b.light->sample({0, 0, -2}, {}).radiance.r, 25, 1e-3F);
    EXPECT_NEAR(b.light->sample({0, 0, 1}, {}).radiance.r, 10, 1e-3F);
    EXPECT_NEAR(b.light->sample({1, 0, 0}, {}).radiance.r, 40, 1e-3F);
    EXPECT_NEAR(b.light->sample({0, 1, 0}, {}).radiance.r, 20, 1e-3F);
    // Turned to shine along +X, with Y up.
    b.matrix(Mat4f::look_at({}, {1, 0, 0}, {0, 1, 0})).make();
    EXPECT_NEAR(b.light->sample({1, 0, 0}, {}).radiance.r, 100, 1e-3F);
    EXPECT_NEAR(b.light->sample({0, 1, 0}, {}).radiance.r, 20, 1e-3F);
    EXPECT_NEAR(b.light->sample({0, 0, 1}, {}).radiance.r, 40, 1e-3F);
}

TEST_F(PhotometricLights, ARadiusKeepsTheBrightness) {
    Bench b = bench("2 1", "0 90\n0\n100 20");
    b.node.set("radius", 0.5F);
    b.matrix(placed({0, 4, 0})).make();
    // Straight ahead: along (1, -2, 0.5).
    const Vec3f ahead = normalize(Vec3f{1, -2, 0.5F}), from = Vec3f{0, 4, 0} + ahead * 3;
    EXPECT_NEAR(sampled_irradiance(*b.light, from, -ahead).r, 100.0F / 9, 0.02F);
    expect_sound(*b.light, from);
    expect_sound(*b.light, {2, 2, -3});
}

TEST_F(PhotometricLights, FilesThatCannotBeUsedLeaveTheLightDark) {
    for (const char* numbers : {"0 90\n0\n1", "90 0\n0\n1 1"}) {
        Bench b = bench("2 1", numbers);
        b.make();
        EXPECT_TRUE(never_shines(*b.light));
        const Error& said = b.context->diagnostics().items().at(0);
        EXPECT_EQ(said.code, Code::FileFormat);
        EXPECT_EQ(said.severity, Severity::Warning);
        EXPECT_EQ(said.where.text(), "filename");
    }
    Bench missing(node_photometric_light());
    missing.node.set("filename", Name("no such.ies"));
    missing.make();
    EXPECT_TRUE(never_shines(*missing.light));
    EXPECT_EQ(missing.context->diagnostics().items().at(0).code, Code::FileNotFound);
    Bench flat = bench("1 1", "0\n0\n1");
    flat.matrix(Mat4f::scale({1, 1, 0})).make();
    EXPECT_TRUE(never_shines(*flat.light));
}

}  // namespace
}  // namespace lightsieve
