// A sky through portals: the same light as without, found more easily. See light_test_support.h.
#include "nodes/light/portals.h"
#include "nodes/light/light_test_support.h"

namespace lightsieve {

NodeType node_quad_light();
NodeType node_skydome_light();

namespace {

using namespace light_test;

constexpr std::int32_t kOff = 0, kInteriorOnly = 1, kInteriorExterior = 2;

/// A window that shines down at y = height, two units wide, and a leaning one that is no rectangle.
class Windows {
  public:
    Windows() {
        top_.node.set("portal", true).set("intensity", 7.0F).set("spread", 0.2F);
        top_.matrix(Mat4f::look_at({0.5F, 2, 0}, {0.5F, 0, 0}, {0, 0, 1})).make();
        side_.node.set("portal", true)
            .set_array<Vec3f>("vertices", {{1, -1, 0}, {-1.5F, -1, 0}, {-1, 1, 0}, {0.5F, 2, 0}});
        side_.matrix(Mat4f::look_at({-3, 2, 1}, {0, 0, 0}, {0, 1, 0})).make();
        lights_ = {top_.light.get(), side_.light.get()};
    }
    [[nodiscard]] std::span<const Light* const> lights() const { return lights_; }
    [[nodiscard]] double irradiance(Vec3f from, Vec3f normal) const {
        double sum = 0;
        for (const Light* light : lights_) {
            const TriangleMesh& mesh = std::get<TriangleMesh>(light->geometry()->data);
            sum += polygon_irradiance(mesh.positions[0], from, normal);
        }
        return sum;
    }

  private:
    Bench top_{node_quad_light()}, side_{node_quad_light()};
    std::vector<const Light*> lights_;
};

/// A dome of radiance 1, or one with a bright side, behind windows.
Bench dome(const Windows& windows, std::int32_t mode, bool picture = false) {
    Bench b(node_skydome_light());
    if (picture)
        b.context->shader = [](const ShadePoint& at) {
            return Color::grey(at.direction.y > 0.9F ? 5.0F : 1.0F);
        };
    b.node.set_enum("portal_mode", mode).set("resolution", 256);
    b.make();
    b.light->set_portals(windows.lights());
    return b;
}

constexpr Vec3f kInside{0.3F, 0, 0.2F};

TEST(Portals, LightThemselvesAreOfRadianceOne) {
    const Windows windows;
    EXPECT_EQ(windows.lights()[0]->sample(kInside, {0.4F, 0.6F}).radiance, kWhite);
    EXPECT_NEAR(windows.lights()[0]->bounds().intensity, 4, 1e-4F);
}

TEST(Portals, InteriorIsLitThroughThemAlone) {
    const Windows windows;
    const Bench b = dome(windows, kInteriorOnly);
    const double expected = windows.irradiance(kInside, {0, 1, 0});
    EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, kInside, {0, 1, 0}).r) / expected,
                1, 2e-3);
    expect_strategies_agree(*b.light, kInside);
    expect_directions_follow_density(*b.light, kInside);
    // Every sample counts.
    for (std::uint32_t i = 0; i < 500; ++i)
        EXPECT_FALSE(is_black(b.light->sample(kInside, sobol(i)).radiance));
    EXPECT_EQ(b.light->escape(kInside, {0, -1, 0}).pdf, 0);
    EXPECT_EQ(b.light->escape(kInside, {0, -1, 0}).radiance, kBlack);
    EXPECT_EQ(b.light->seen(kInside, {0, -1, 0}).radiance, kWhite) << "the camera sees the sky";
    // Outside, behind all of them.
    const Vec3f outside{-20, 30, 8};
    EXPECT_EQ(b.light->sample(outside, {0.2F, 0.3F}).pdf, 0);
    EXPECT_EQ(b.light->escape(outside, {0, 1, 0}).radiance, kBlack);
}

TEST(Portals, ExteriorIsLitAsWithoutThem) {
    const Windows windows;
    const Bench b = dome(windows, kInteriorExterior);
    EXPECT_NEAR(sampled_irradiance(*b.light, kInside, {0, 1, 0}).r / kPi, 1, 5e-3);
    EXPECT_NEAR(sampled_irradiance(*b.light, {-20, 30, 8}, {0, 1, 0}).r / kPi, 1, 2e-3);
    expect_sound(*b.light, kInside);
    expect_sound(*b.light, {-20, 30, 8});
    const Bench off = dome(windows, kOff);
    EXPECT_EQ(off.light->escape(kInside, {0, -1, 0}).pdf, kInvPi / 4);
}

TEST(Portals, PicturesKeepTheirOwnSamples) {
    const Windows windows;
    for (const std::int32_t mode : {kInteriorOnly, kInteriorExterior}) {
        const Bench b = dome(windows, mode, true);
        expect_strategies_agree(*b.light, kInside);
        expect_directions_follow_density(*b.light, kInside);
    }
}

TEST(Portals, OnesWithoutAreaAreNone) {
    Bench flat(node_quad_light());
    flat.node.set("portal", true);
    flat.matrix(Mat4f::scale({1, 0, 1})).make();
    const Light* light = flat.light.get();
    EXPECT_TRUE(Portals(std::span(&light, 1)).empty());
}

}  // namespace
}  // namespace lightsieve
