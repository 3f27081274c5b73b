// Volumes against closed forms: what is left of light, what is scattered once, what is emitted, and that nothing is lost.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "core/blackbody.h"
#include "io/volume_grid.h"
#include "render/majorants.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A box of a volume around the origin, seen along -z by parallel rays.
std::string slab(std::string_view shader, float half_thickness = 0.5F, float half_width = 50) {
    return node("volume", "slab",
                " min " + text_of(Vec3f{-half_width, -half_width, -half_thickness}) + "\n max " +
                    text_of(Vec3f{half_width, half_width, half_thickness}) + "\n shader " +
                    std::string(shader));
}

std::string smoke(std::string_view body) {
    return node("standard_volume", "smoke", " emission_mode none\n " + std::string(body));
}

const std::string kFrontView = ortho_camera({0, 0, 5}, {0, 0, 0}, 1);
/// A wall behind the slab that shines with radiance 1.
const std::string kGlowingWall =
    node("flat", "glow", " color 1 1 1") +
    quad("wall", {-60, -60, -3}, {60, -60, -3}, {60, 60, -3}, {-60, 60, -3}, "glow");

void expect_mean(const Picture& picture, const std::string& layer, Color truth,
                 double slack = 1e-4) {
    for (int c = 0; c < 3; ++c) {
        const Estimate e = estimate(picture, layer, c);
        EXPECT_NEAR(e.mean, truth[c], kZ * e.error + slack)
            << layer << ", channel " << c << ", error " << e.error;
    }
}

TEST(Volume, AbsorptionFollowsBeerAndLambert) {
    // Twice the thickness of transparent_depth: the square of `transparent`.
    const Picture picture = render(
        frame_text(16, 16, 4, kFrontView) + kGlowingWall +
        smoke("scatter 0\n transparent 0.5 0.8 0.25\n transparent_depth 0.5") + slab("smoke"));
    expect_mean(picture, "RGBA", {0.25F, 0.64F, 0.0625F});
}

TEST(Volume, OpacityIsWhatIsNotTransmitted) {
    RenderOptions options = in_memory({"volume_opacity"});
    const Picture picture =
        render(frame_text(8, 8, 2, kFrontView) +
                   smoke("transparent 0.5 0.8 0.25\n transparent_depth 1") + slab("smoke"),
               options);
    expect_mean(picture, "volume_opacity", {0.5F, 0.2F, 0.75F}, 1e-5);
    EXPECT_NEAR(picture.alpha("RGBA", 0), (0.5 + 0.2 + 0.75) / 3, 1e-5);
}

TEST(Volume, ScattersOnceAsTheClosedFormSays) {
    // A sun behind the camera: light goes in and comes straight back out, so single scattering is
    // albedo * p(-1) * E * (1 - exp(-2 s d)) / 2 for extinction s and thickness d.
    const double s = 0.7, albedo = 0.6, g = 0.3;
    const double phase = (1 - g * g) / (4 * M_PI * std::pow(1 + g * g + 2 * g, 1.5));
    const double truth = albedo * phase * (1 - std::exp(-2 * s)) / 2;
    const Picture picture = render(
        frame_text(32, 32, 4, kFrontView) + node("distant_light", "sun", " direction 0 0 -1") +
            smoke("density 0.7\n scatter_color 0.6 0.6 0.6\n scatter_anisotropy 0.3") +
            slab("smoke"),
        in_memory({"volume RGB", "volume_direct RGB", "volume_indirect RGB"}));
    expect_mean(picture, "volume", Color::grey(static_cast<float>(truth)));
    expect_mean(picture, "RGBA", Color::grey(static_cast<float>(truth)));
    EXPECT_TRUE(check_identical(picture, "volume", picture, "volume_direct"));
    EXPECT_TRUE(check_black(picture, "volume_indirect"));
}

TEST(Volume, EmissionAddsUpAlongTheRay) {
    // 3 a unit over one unit, absorbed on the way out: 3 (1 - exp(-2)) / 2.
    const auto truth = static_cast<float>(3 * (1 - std::exp(-2.0)) / 2);
    const Picture picture =
        render(frame_text(32, 32, 4, kFrontView) +
                   node("standard_volume", "smoke",
                        " density 2\n scatter 0\n emission_mode density\n emission 1.5") +
                   slab("smoke"),
               in_memory({"emission RGB"}));
    expect_mean(picture, "emission", Color::grey(truth));
}

TEST(Volume, WhiteFurnaceVanishes) {
    // Albedo 1 in an even surrounding: nothing can be seen, whatever the phase function and the colour of the extinction.
    const Picture picture = render(
        frame_text(16, 16, 20, ortho_camera({0, 0, 5}, {0, 0, 0}, 1.5F),
                   " GI_volume_depth 200\n GI_total_depth 200\n indirect_sample_clamp 1e30") +
        node("skydome_light", "sky", "") +
        smoke("scatter_color 1 1 1\n density 2\n transparent 0.5 0.2 0.36\n scatter_anisotropy "
              "0.4\n scatter_secondary_anisotropy -0.3\n scatter_secondary_anisotropy_mix 0.25") +
        sphere("ball", {0, 0, 0}, 1, "smoke", " step_size 0.1"));
    for (int c = 0; c < 3; ++c) {
        const Estimate e = estimate(picture, "RGBA", c);
        EXPECT_LT(e.error, 0.005);
        EXPECT_NEAR(e.mean, 1, 0.01);
    }
}

TEST(Volume, AMurkyBallInAFurnaceIsInvisibleWhereNothingIsAbsorbed) {
    // transmission_scatter exceeds what transmission_color takes away, most in blue: there all that is lost is scattered.
    const Picture picture = render(
        frame_text(20, 20, 20, ortho_camera({0, 0, 5}, {0, 0, 0}, 1.4F),
                   " GI_volume_depth 200\n GI_transmission_depth 200\n GI_specular_depth 200\n "
                   "GI_total_depth 250\n indirect_sample_clamp 1e30") +
            node("skydome_light", "sky", "") +
            node(
                "standard_surface", "murky",
                " base 0\n transmission 1\n transmission_color 1 0.6 0.3\n transmission_depth 1\n "
                "transmission_scatter 1 2 3\n specular_roughness 0\n specular_IOR 1.33\n "
                "caustics on") +
            sphere("ball", {0, 0, 0}, 1, "murky"),
        in_memory({"transmission RGB"}));
    const Estimate blue = estimate(picture, "RGBA", 2), red = estimate(picture, "RGBA", 0);
    EXPECT_LT(blue.error, 0.005);
    EXPECT_NEAR(blue.mean, 1, 0.01);
    EXPECT_LT(red.mean, 0.6);
    EXPECT_TRUE(check_lit(picture, "transmission"));
}

TEST(Volume, OverlappingVolumesAddUp) {
    const std::string two = smoke("scatter 0\n transparent 0.5 0.5 0.5") +
                            node("standard_volume", "fog",
                                 " emission_mode none\n scatter 0\n transparent 0.25 1 0.5") +
                            slab("smoke") +
                            sphere("ball", {0, 0, 0}, 0.5F, "fog",
                                   " step_size 1\n matrix 100 0 0 0  0 100 0 0  0 0 1 0  0 0 0 1");
    const Picture picture = render(frame_text(16, 16, 6, kFrontView) + kGlowingWall + two);
    expect_mean(picture, "RGBA", {0.125F, 0.5F, 0.25F}, 1e-3);
}

TEST(Volume, ShadowRaysAreWeakened) {
    // A floor below a layer of fog, seen from below the fog: its sun has come through one unit of it.
    const Picture picture =
        render(frame_text(8, 8, 4, ortho_camera({0, 1, 0}, {0, 0, 0}, 0.5F, {0, 0, 1})) +
               node("distant_light", "sun", " direction 0 -1 0\n intensity 3.14159265") +
               lambert("clay", 1) + floor("ground", 0, 10, "clay") +
               smoke("scatter 0\n transparent 0.3 0.6 0.9") +
               node("volume", "layer", " min -50 2 -50\n max 50 3 50\n shader smoke"));
    expect_mean(picture, "RGBA", {0.3F, 0.6F, 0.9F});
}

TEST(Volume, LightsMayIgnoreVolumes) {
    const Picture picture =
        render(frame_text(8, 8, 4, ortho_camera({0, 1, 0}, {0, 0, 0}, 0.5F, {0, 0, 1})) +
               node("distant_light", "sun",
                    " direction 0 -1 0\n intensity 3.14159265\n cast_volumetric_shadows off") +
               lambert("clay", 1) + floor("ground", 0, 10, "clay") +
               smoke("scatter 0\n transparent 0.3 0.6 0.9") +
               node("volume", "layer", " min -50 2 -50\n max 50 3 50\n shader smoke"));
    expect_mean(picture, "RGBA", {1, 1, 1});
}

TEST(Volume, TheCameraMayStandInIt) {
    const Picture picture =
        render(frame_text(16, 16, 4, ortho_camera({0, 0, 0}, {0, 0, -1}, 1)) + kGlowingWall +
               smoke("scatter 0\n transparent 0.25 0.25 0.25") + slab("smoke"));
    expect_mean(picture, "RGBA", {0.5F, 0.5F, 0.5F});
}

// The plume of scenes/smoke.vdb, along rays parallel to -z, against quadrature in fine steps ------------------------------

const std::string kSmokeFile = std::string(LIGHTSIEVE_SOURCE_DIR) + "/scenes/smoke.vdb";

/// Along the ray through (x, y): what is left of light at the end, and what was emitted on the way.
struct Quadrature {
    std::array<double, 3> left{1, 1, 1}, emitted{};
};

/// extinction  a unit of density; emission  a unit of temperature to the fourth, in the colour of `kelvin` there
Quadrature integrate_smoke(float x, float y, const std::array<double, 3>& extinction,
                           double emission, float kelvin) {
    const auto grids = load_volume(kSmokeFile, {});
    const int density = grids->find("density"), temperature = grids->find("temperature");
    const Box3f box = grids->bounds();
    const int n = 20000;
    const double step = static_cast<double>(box.size().z) / n;
    Quadrature out;
    for (int i = 0; i < n; ++i) {
        const Vec3f p{x, y, box.upper.z - static_cast<float>((i + 0.5) * step)};
        const auto d =
            static_cast<double>(grids->sample(density, p, VolumeInterpolation::Trilinear).r);
        const float heat = grids->sample(temperature, p, VolumeInterpolation::Trilinear).r;
        const Color color = heat > 0 ? blackbody_color(kelvin * heat) : kBlack;
        for (std::size_t c = 0; c < 3; ++c) {
            const double glow = std::max(0.0, static_cast<double>(color[static_cast<int>(c)])) *
                                std::pow(static_cast<double>(heat), 4) * emission;
            out.emitted[c] += glow * out.left[c] * step;
            out.left[c] *= std::exp(-extinction[c] * d * step);
        }
    }
    return out;
}

std::string plume(std::string_view body) {
    return node("standard_volume", "smoke", std::string(body)) +
           node("volume", "plume", " filename \"" + kSmokeFile + "\"\n shader smoke");
}

/// Practically one ray, many times.
std::string needle(float x, float y) { return ortho_camera({x, y, 5}, {x, y, 0}, 1e-4F); }

TEST(Volume, GridsTransmitWhatTheirIntegralSays) {
    // -ln of 0.5, 0.8, 0.25 a unit of density, four times as dense.
    const std::array<double, 3> extinction{-4 * std::log(0.5), -4 * std::log(0.8),
                                           -4 * std::log(0.25)};
    for (const auto& [x, y] : {std::pair{0.0F, 1.5F}, {0.08F, 1.1F}, {-0.03F, 0.6F}}) {
        const Quadrature truth = integrate_smoke(x, y, extinction, 0, 0);
        const Picture picture = render(
            frame_text(48, 48, 4, needle(x, y)) + kGlowingWall +
                plume(" density 4\n scatter 0\n transparent 0.5 0.8 0.25\n emission_mode none"),
            in_memory({"volume_opacity"}));
        EXPECT_LT(truth.left[2], 0.9) << "no smoke where the test looks";
        for (int c = 0; c < 3; ++c) {
            const double left = truth.left[static_cast<std::size_t>(c)];
            const Estimate seen = estimate(picture, "RGBA", c),
                           hidden = estimate(picture, "volume_opacity", c);
            EXPECT_NEAR(seen.mean, left, kZ * seen.error + 1e-3);
            EXPECT_NEAR(hidden.mean, 1 - left, kZ * hidden.error + 1e-3);
        }
    }
}

TEST(Volume, FireEmitsWhatItsIntegralSays) {
    const Quadrature truth = integrate_smoke(0, 0.3F, {3, 3, 3}, 20, 2000);
    const Picture picture = render(
        frame_text(48, 48, 4, needle(0, 0.3F)) +
            plume(" density 3\n scatter 0\n blackbody_kelvin 2000\n blackbody_intensity 20"),
        in_memory({"emission RGB"}));
    EXPECT_GT(truth.emitted[0], 0.01) << "no fire where the test looks";
    for (int c = 0; c < 3; ++c) {
        const Estimate e = estimate(picture, "emission", c);
        EXPECT_NEAR(e.mean, truth.emitted[static_cast<std::size_t>(c)],
                    kZ * e.error + 0.002 * truth.emitted[0]);
    }
}

TEST(Volume, GridsThatAFileLacksAreReportedWithThoseItHas) {
    const TestScene scene(
        frame_text(4, 4, 1, kFrontView) + plume(" density_channel \"fog\"\n emission_mode none"),
        in_memory(), {"has no grid \"fog\""});
    ASSERT_EQ(scene.diagnostics().items().size(), 1U);
    EXPECT_EQ(scene.diagnostics().items()[0].code, Code::UnknownGrid);
    EXPECT_NE(scene.diagnostics().items()[0].hint.find("temperature"), std::string::npos);
}

TEST(Volume, AFileThatIsNotThereLeavesTheRest) {
    const TestScene scene(frame_text(4, 4, 1, kFrontView) + kGlowingWall + smoke("") +
                              node("volume", "plume", " filename \"no/such.vdb\"\n shader smoke"),
                          in_memory(), {"the volume is left out"});
    EXPECT_TRUE(scene.scene().volumes.empty());
    EXPECT_EQ(scene.scene().objects.size(), 1U);
}

TEST(Volume, GroupsAndAovsOfVolumesAddUp) {
    const std::string text =
        frame_text(12, 12, 4, kFrontView, " GI_volume_depth 3\n GI_diffuse_depth 2") +
        node("standard_volume", "smoke",
             " density 1.2\n scatter_color 0.9 0.7 0.5\n emission_mode density\n emission 0.1\n "
             "label \"fog\"") +
        slab("smoke") + lambert("clay", 0.7F) +
        quad("wall", {-9, -9, -2}, {9, -9, -2}, {9, 9, -2}, {-9, 9, -2}, "clay") +
        node("point_light", "key", " position 2 2 2\n intensity 10\n aov \"key\"") +
        node("quad_light", "fill",
             " vertices 4 1 VECTOR -2 3 -2 2 3 -2 2 3 2 -2 3 2\n intensity 20\n aov \"fill\"") +
        node("skydome_light", "sky", " intensity 0.2");
    const Picture picture = render(
        text, in_memory({"direct RGB", "indirect RGB", "emission RGB", "background RGB",
                         "diffuse RGB", "volume RGB", "volume_direct RGB", "volume_indirect RGB",
                         "volume_key RGB", "volume_fill RGB", "volume_default RGB"},
                        {"fog C<V.'fog'>.*", "fire C<O.'fog'>"}));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"direct", "indirect", "emission", "background"}));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"diffuse", "volume", "emission", "background"}));
    EXPECT_TRUE(check_sum(picture, "volume", {"volume_direct", "volume_indirect"}));
    EXPECT_TRUE(check_sum(picture, "volume", {"volume_key", "volume_fill", "volume_default"}));
    EXPECT_TRUE(check_equal(picture, "volume", picture, "fog"));
    EXPECT_TRUE(check_equal(picture, "emission", picture, "fire"));
    for (const char* layer : {"volume_direct", "volume_indirect", "volume_key", "emission"})
        EXPECT_TRUE(check_lit(picture, layer));
}

TEST(Volume, AlbedoProbesSeeWhatScatters) {
    const Picture picture =
        render(frame_text(32, 32, 4, kFrontView) +
                   smoke("scatter_color 0.8 0.4 0.2\n transparent 0.5 0.5 0.5") + slab("smoke"),
               in_memory({"volume_albedo RGB"}));
    expect_mean(picture, "volume_albedo", {0.4F, 0.2F, 0.1F});
}

TEST(Volume, ASurfaceShaderInAContainerIsReported) {
    const TestScene scene(frame_text(4, 4, 1, kFrontView) + lambert("clay", 0.7F) +
                              sphere("ball", {0, 0, 0}, 1, "clay", " step_size 0.1"),
                          in_memory(), {"says nothing of what is inside"});
    EXPECT_TRUE(scene.scene().volumes.empty());
    EXPECT_EQ(scene.scene().objects.size(), 1U);
}

TEST(Volume, WhatHasNoEffectIsReported) {
    for (const char* switched : {"matte", "use_shadow_group"}) {
        const TestScene scene(frame_text(4, 4, 1, kFrontView) + smoke("") +
                                  sphere("ball", {0, 0, 0}, 1, "smoke",
                                         " step_size 1\n " + std::string(switched) + " on"),
                              in_memory(), {"has no effect on volumes"});
        ASSERT_EQ(scene.diagnostics().items().size(), 1U);
        EXPECT_EQ(scene.diagnostics().items()[0].where.text(), "on");
    }
}

TEST(Volume, SenselessNumbersEndInAPicture) {
    for (const char* body :
         {"density 1e30", "density -3", "transparent 0 0 0\n transparent_depth 0",
          "transparent -1 2 0.5", "scatter_color 5 -1 0.5", "scatter_anisotropy 7",
          "scatter_anisotropy -1\n scatter_secondary_anisotropy 1\n "
          "scatter_secondary_anisotropy_mix 9",
          "density 1e-30", "transparent_depth -2", "transparent_depth 1e30"}) {
        SCOPED_TRACE(body);
        const Picture picture =
            render(TestScene(frame_text(6, 6, 2, kFrontView, " GI_volume_depth 2") +
                                 node("skydome_light", "sky", "") +
                                 node("point_light", "lamp", " position 0 0 0\n intensity 3") +
                                 smoke(body) + slab("smoke"),
                             in_memory({"volume_opacity"}), {"outside", "range"}));
        for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
            EXPECT_TRUE(is_finite(picture.color("RGBA", i)));
            EXPECT_GE(picture.color("volume_opacity", i).g, 0);
            EXPECT_LE(picture.color("volume_opacity", i).g, 1 + 1e-5F);
        }
    }
}

TEST(Volume, EmptyBoxesAreReported) {
    for (const char* box : {"", " min 1 1 1\n max 0 0 0", " min 0 0 0\n max 1 0 1"}) {
        const TestScene scene(frame_text(4, 4, 1, kFrontView) + smoke("") +
                                  node("volume", "nothing", std::string(box) + "\n shader smoke"),
                              in_memory(), {"the volume is empty"});
        EXPECT_TRUE(scene.scene().volumes.empty());
    }
}

TEST(Haze, ScattersLightOfLampsOnceAlongTheRay) {
    // Even haze of density s around a lamp of intensity I, seen past it at distance a: the closed form is
    // s I / (4 pi a) times the angle under which the lamp sees the ray. No attenuation. Here the whole ray: pi.
    const float s = 0.01F, intensity = 5, a = 1;
    const Picture picture = render(
        frame_text(32, 32, 3, ortho_camera({0, a, 3000}, {0, a, 0}, 1e-3F), " atmosphere haze") +
            node("atmosphere_volume", "haze", " density 0.01\n samples 2") +
            node("point_light", "lamp", " position 0 0 0\n intensity 5") + lambert("clay", 0) +
            quad("wall", {-9, -9, -3000}, {9, -9, -3000}, {9, 9, -3000}, {-9, 9, -3000}, "clay"),
        in_memory({"volume_direct RGB"}));
    const Estimate e = estimate(picture, "volume_direct", 0);
    const double truth = static_cast<double>(s * intensity / (4 * kPi * a)) * M_PI;
    EXPECT_NEAR(e.mean, truth, kZ * e.error + 2e-3 * truth);
    EXPECT_LT(e.error, 0.01 * truth);
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "volume_direct"));
}

TEST(Haze, AttenuatesWhatIsBehind) {
    const Picture picture =
        render(frame_text(8, 8, 2, kFrontView, " atmosphere haze") + kGlowingWall +
               node("atmosphere_volume", "haze", " attenuation 0.1\n rgb_attenuation 1 2 0.5"));
    // Eight units from the camera to the wall.
    EXPECT_TRUE(
        check_mean(picture, "RGBA", {std::exp(-0.8F), std::exp(-1.6F), std::exp(-0.4F)}, 1e-3));
}

TEST(Fog, PointsAlongTheRayAndCollisionsAgree) {
    // A lamp in even fog: quick rays near it find most light by its angle, collisions the rest. The truth by quadrature.
    const double s = 0.5, albedo = 0.8, a = 0.3, intensity = 2;
    double truth = 0;
    const int n = 200000;
    for (int i = 0; i < n; ++i) {
        const double z = -3 + 6 * (i + 0.5) / n, distance = std::sqrt(a * a + z * z);
        const double before = 3 - z;  // from the fog's near face
        truth += s * albedo / (4 * M_PI) * intensity / (distance * distance) *
                 std::exp(-s * (before + distance)) * 6 / n;
    }
    const float y = 0.3F;
    const Picture picture =
        render(frame_text(64, 64, 4, ortho_camera({0, y, 9}, {0, y, 0}, 1e-3F)) +
                   smoke("density 0.5\n scatter_color 0.8 0.8 0.8") + slab("smoke", 3, 60) +
                   node("point_light", "lamp", " position 0 0 0\n intensity 2"),
               in_memory({"volume_direct RGB"}));
    const Estimate e = estimate(picture, "volume_direct", 0);
    EXPECT_NEAR(e.mean, truth, kZ * e.error + 1e-3 * truth);
    EXPECT_LT(e.error, 0.01 * truth);
}

TEST(MajorantWalk, CoversTheRayOnceInTheRightCells) {
    MajorantGrid grid({{-1, -2, 0}, {3, 2, 5}}, {4, 3, 5});
    for (int z = 0; z < 5; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 4; ++x)
                grid.at(x, y, z) = static_cast<float>(1 + x + 10 * y + 100 * z);
    const Vec3f origin{-3, -2.5F, 7}, direction{1.1F, 0.9F, -1.3F};
    float t0 = 0, t1 = kInfinity;
    for (int a = 0; a < 3; ++a) {
        const float near =
            ((direction[a] > 0 ? grid.box().lower : grid.box().upper)[a] - origin[a]) /
            direction[a];
        const float far =
            ((direction[a] > 0 ? grid.box().upper : grid.box().lower)[a] - origin[a]) /
            direction[a];
        t0 = std::max(t0, near);
        t1 = std::min(t1, far);
    }
    ASSERT_LT(t0, t1);
    MajorantWalk walk(grid, origin, direction, t0, t1);
    float reached = t0;
    int n = 0;
    while (walk.next()) {
        EXPECT_EQ(walk.begin(), reached);
        reached = walk.end();
        if (walk.end() - walk.begin() < 1e-4F) continue;
        const Vec3f p = origin + direction * ((walk.begin() + walk.end()) / 2);
        const int x = static_cast<int>(std::floor(p.x + 1)),
                  y = static_cast<int>(std::floor((p.y + 2) * 3 / 4)),
                  z = static_cast<int>(std::floor(p.z));
        EXPECT_EQ(walk.majorant(), grid.at(x, y, z));
        ++n;
    }
    EXPECT_EQ(reached, t1);
    EXPECT_GE(n, 4);
}

TEST(Fog, HidesWhatLiesBehindAndShowsItsColor) {
    // A wall 5 units away, seen along the ground: as dense everywhere.
    const auto seen = [](const std::string& fog, const std::string& more) {
        return render(frame_text(4, 4, 2, ortho_camera({0, 0, 5}, {0, 0, 0}, 1e-3F),
                                 " atmosphere mist") +
                      node("fog", "mist", " color 0.2 0.4 0.8\n ground_normal 0 1 0\n" + fog) +
                      more)
            .mean("RGBA");
    };
    const std::string wall = node("flat", "red", " color 1 0 0") +
                             node("plane", "wall", " point 0 0 0\n normal 0 0 1\n shader red");
    const double left = std::exp(-5.0 / 10);
    const Color along = seen(" distance 10", wall);
    EXPECT_NEAR(along.r, left + 0.2 * (1 - left), 1e-4);
    EXPECT_NEAR(along.b, 0.8 * (1 - left), 1e-4);
    // Two heights above the ground it is thinner.
    const double thin = std::exp(-5.0 / 10 * std::exp(-2.0));
    EXPECT_NEAR(seen(" distance 10\n height 3\n ground_point 0 -6 0", wall).b, 0.8 * (1 - thin),
                1e-4);
    // Straight up from the ground: all of it lies on the way, height / distance, though the way has no end.
    const double up = std::exp(-3.0 / 10);
    EXPECT_NEAR(seen(" distance 10\n height 3\n ground_point 0 0 5\n ground_normal 0 0 -1", "").b,
                0.8 * (1 - up), 1e-3);
    EXPECT_NEAR(seen(" distance 0", wall).g, 0.4, 1e-5);
    EXPECT_EQ(seen(" distance 1e30", wall).r, 1);
}

}  // namespace
}  // namespace lightsieve::testing
