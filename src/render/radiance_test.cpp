// Radiance that is known in closed form: lights of every kind, emission, bounces.
#include <gtest/gtest.h>

#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

// Lights -----------------------------------------------------------------------------------------------------------------

TEST(Radiance, SphereInAFurnaceIsItsAlbedo) {
    // A convex body under an even dome of radiance 1: exactly Kd, from wherever it is seen.
    const Picture picture = render(
        frame_text(24, 24, 6, ortho_camera({0, 0, 5}, {0, 0, 0}, 1.3F)) + lambert("grey", 0.65F) +
        sphere("ball", {0, 0, 0}, 1, "grey") + node("skydome_light", "sky", ""));
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(0.65F)));
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        ASSERT_EQ(picture.alpha("RGBA", i), 1);
}

TEST(Radiance, DistantLightOnALambertPlane) {
    // E cos albedo / pi, without any noise.
    const Picture picture = render(
        frame_text(6, 6, 2, from_above(1)) + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey") +
        node("distant_light", "sun",
             " direction 0.6 -0.8 0\n intensity 3\n color 1 0.5 0.25\n exposure 1"));
    const float e = 6 * 0.8F * 0.5F * kInvPi;
    EXPECT_TRUE(check_constant(picture, "RGBA", {e, e / 2, e / 4}, 1e-5));
}

TEST(Radiance, DistantLightWithAnAngleHasTheSameIrradiance) {
    // The disc of the sky lies wholly above the horizon, so that E cos holds for its centre.
    const Picture picture =
        render(frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) +
               floor("plane", 0, 1, "grey") +
               node("distant_light", "sun", " direction 0.6 -0.8 0\n angle 30\n intensity 3"));
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(3 * 0.8F * 0.5F * kInvPi)));
}

TEST(Radiance, PointLightFallsOffWithTheSquare) {
    const Picture picture =
        render(frame_text(6, 6, 2, at_the_origin()) + lambert("grey", 0.5F) +
               floor("plane", 0, 1, "grey") +
               node("point_light", "bulb", " position 1.5 2 0\n intensity 10"));
    // cos = 2 / 2.5, r = 2.5; the picture is 1e-3 wide.
    EXPECT_TRUE(
        check_constant(picture, "RGBA", Color::grey(10 * 0.8F / 6.25F * 0.5F * kInvPi), 1e-3));
}

TEST(Radiance, SphereLightIsAPointLightFromOutside) {
    // Irradiance of a sphere that the horizon does not cut: pi L (R/d)^2 cos = I cos / d^2.
    const Picture picture =
        render(frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) +
               floor("plane", 0, 1, "grey") +
               node("point_light", "bulb", " position 1.5 2 0\n intensity 10\n radius 1.2"));
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(10 * 0.8F / 6.25F * 0.5F * kInvPi), 1e-3));
}

/// View factor from a point to a parallel rectangle with one corner above it, a by b at height 1.
double corner_factor(double a, double b) {
    const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
    return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * M_PI);
}

TEST(Radiance, QuadLightOnAPlaneInClosedForm) {
    // A rectangle at height 0.8 that reaches from x = -0.6 to 1, z = -0.4 to 0.9 over the point: four corners.
    // Source: Siegel and Howell, "Thermal Radiation Heat Transfer", configuration factor of a differential element.
    const double h = 0.8, f = corner_factor(0.6 / h, 0.4 / h) + corner_factor(0.6 / h, 0.9 / h) +
                              corner_factor(1 / h, 0.4 / h) + corner_factor(1 / h, 0.9 / h);
    const std::string vertices =
        " vertices 4 1 VECTOR -0.6 0.8 -0.4  1 0.8 -0.4  1 0.8 0.9  -0.6 0.8 0.9";
    const std::string scene = frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) +
                              floor("plane", 0, 1, "grey");
    const double area = 1.6 * 1.3;
    EXPECT_TRUE(check_mean(
        render(scene + node("quad_light", "key", vertices + "\n normalize off\n intensity 2")),
        "RGBA", Color::grey(static_cast<float>(0.5 * 2 * f))));
    EXPECT_TRUE(check_mean(render(scene + node("quad_light", "key", vertices + "\n intensity 2")),
                           "RGBA", Color::grey(static_cast<float>(0.5 * 2 / area * f))));
}

TEST(Radiance, MeshLightIsTheSameQuad) {
    const std::string scene = frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) +
                              floor("plane", 0, 1, "grey");
    const std::string mesh = node("mesh_light", "key", " mesh shape\n intensity 2") +
                             quad("shape", {-0.6F, 0.8F, -0.4F}, {1, 0.8F, -0.4F}, {1, 0.8F, 0.9F},
                                  {-0.6F, 0.8F, 0.9F}, "grey", " visibility 0");
    const double h = 0.8, f = corner_factor(0.6 / h, 0.4 / h) + corner_factor(0.6 / h, 0.9 / h) +
                              corner_factor(1 / h, 0.4 / h) + corner_factor(1 / h, 0.9 / h);
    EXPECT_TRUE(check_mean(render(scene + mesh), "RGBA",
                           Color::grey(static_cast<float>(0.5 * 2 / (1.6 * 1.3) * f))));
}

TEST(Radiance, ManyLightsAddUp) {
    // The choice among lights is a matter of noise only: 25 small lights are one large one.
    std::string many, one = square_light("large", 1, 1, " intensity 4");
    for (int x = 0; x < 5; ++x)
        for (int z = 0; z < 5; ++z) {
            const float cx = -0.8F + 0.4F * static_cast<float>(x),
                        cz = -0.8F + 0.4F * static_cast<float>(z);
            many += node("quad_light", "l" + std::to_string(x) + std::to_string(z),
                         " intensity 0.16\n matrix 0.2 0 0 0  0 0 -0.2 0  0 0.2 0 0  " +
                             text_of(cx) + " 1 " + text_of(cz) + " 1");
        }
    const std::string scene = frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) +
                              floor("plane", 0, 1, "grey");
    EXPECT_TRUE(check_same_mean(render(scene + many), "RGBA", render(scene + one), "RGBA"));
}

/// A light node without its shadow switch.
struct AnyLight {
    const char* name;
    const char* type;
    const char* body;
};

/// MIS has two strategies: light samples, and rays that meet the light. With cast_shadows off only light samples count, so in
/// an open scene both settings must give the same, on a surface so glossy that rays matter.
class LightStrategies : public ::testing::TestWithParam<AnyLight> {};

INSTANTIATE_TEST_SUITE_P(
    Lights, LightStrategies,
    ::testing::Values(
        AnyLight{"quad", "quad_light",
                 " vertices 4 1 VECTOR -1 1 -1  0.5 1 -1  0.5 1 0.5  -1 1 0.5"},
        AnyLight{"skewed_quad", "quad_light",
                 " vertices 4 1 VECTOR -1 1 -1  0.5 1.5 -1  0.9 1 0.5  -1.5 1 0.8"},
        AnyLight{"disk", "disk_light",
                 " radius 0.8\n matrix 1 0 0 0  0 0 -1 0  0 1 0 0  -0.3 1 -0.3 1"},
        AnyLight{"cylinder", "cylinder_light",
                 " radius 0.3\n top -1 1.2 -0.5\n bottom 0.6 1.2 -0.5"},
        AnyLight{"sphere", "point_light", " radius 0.6\n position -0.5 1.2 -0.3"},
        AnyLight{"spot", "spot_light",
                 " radius 0.5\n matrix 1 0 0 0  0 0 -1 0  0 1 0 0  -0.5 1.2 -0.3 1"},
        AnyLight{"distant", "distant_light", " angle 40\n direction 0.6 -1 0.3"},
        AnyLight{"mesh", "mesh_light", " mesh lamp_shape"},
        AnyLight{"even_dome", "skydome_light", ""},
        AnyLight{"dome", "skydome_light", " color cells\n resolution 64"},
        AnyLight{"textured_quad", "quad_light",
                 " color cells\n vertices 4 1 VECTOR -1 1 -1  0.5 1 -1  0.5 1 0.5  -1 1 0.5"}),
    [](const auto& made) { return std::string(made.param.name); });

TEST_P(LightStrategies, Agree) {
    const auto with = [&](const char* more) {
        return render(
            frame_text(20, 20, 8, at_the_origin()) +
                node("standard_surface", "gloss",
                     " base_color 0.3 0.3 0.3\n specular_IOR 2.5\n specular_roughness 0.35") +
                floor("plane", 0, 1, "gloss") +
                node("checkerboard", "cells",
                     " color1 1 0.2 0.1\n color2 0.1 0.5 1\n u_frequency 2\n v_frequency 2") +
                node("polymesh", "lamp_shape",
                     " visibility 0\n nsides 2 1 UINT 3 3\n vidxs 6 1 UINT 0 1 2 3 4 5\n vlist 6 "
                     "1 VECTOR -1 1 -1  0.5 1.3 -1  -0.5 1 0.5  -1 0.7 0.6  0.4 0.8 -0.2  0.3 0.9 "
                     "0.9") +
                node(GetParam().type, "key", std::string(GetParam().body) + more),
            in_memory({"diffuse", "specular"}));
    };
    // A shape that casts no shadows, far from everything, makes shadow rays decide what hides a light from other rays.
    const std::string ghost =
        "\n}\n" + node("flat", "black", " color 0 0 0") +
        "sphere\n{\n name ghost\n center 0 -20 0\n radius 1\n shader black\n visibility 253";
    const Picture both = with(""), samples = with("\n cast_shadows off"),
                  by_shadow_rays = with(ghost.c_str());
    for (const char* layer : {"diffuse", "specular"}) {
        EXPECT_TRUE(check_lit(both, layer));
        EXPECT_TRUE(check_same_mean(both, layer, samples, layer));
        EXPECT_TRUE(check_equal(both, layer, by_shadow_rays, layer));
    }
}

// Emission and bounces ---------------------------------------------------------------------------------------------------

TEST(Radiance, EmissiveObjectsShowTheirColor) {
    const std::string scene = frame_text(4, 4, 2, from_above(1));
    const Picture flat =
        render(scene + node("flat", "glow", " color 0.2 3 0.5") + floor("plane", 0, 1, "glow"),
               in_memory({"emission"}));
    EXPECT_TRUE(check_constant(flat, "RGBA", {0.2F, 3, 0.5F}, 1e-6));
    EXPECT_TRUE(check_equal(flat, "RGBA", flat, "emission"));
    const Picture surface =
        render(scene +
                   node("standard_surface", "glow",
                        " base 0\n specular 0\n emission 2\n emission_color 0.1 1 0.5") +
                   floor("plane", 0, 1, "glow"),
               in_memory({"emission"}));
    EXPECT_TRUE(check_constant(surface, "emission", {0.2F, 2, 1}, 1e-6));
}

TEST(Radiance, EmissiveObjectsLightOthers) {
    // The same closed form as for the quad light, found by rays alone; it is O and so indirect.
    const double h = 0.8, f = corner_factor(0.6 / h, 0.4 / h) + corner_factor(0.6 / h, 0.9 / h) +
                              corner_factor(1 / h, 0.4 / h) + corner_factor(1 / h, 0.9 / h);
    const Picture picture =
        render(frame_text(20, 20, 6, ortho_camera({0.3F, 0.5F, 0.2F}, {0, 0, 0}, 1e-3F),
                          " GI_diffuse_depth 1") +
                   lambert("grey", 0.5F) + floor("plane", 0, 1, "grey") +
                   node("flat", "glow", " color 2 2 2") +
                   quad("lamp", {-0.6F, 0.8F, -0.4F}, {1, 0.8F, -0.4F}, {1, 0.8F, 0.9F},
                        {-0.6F, 0.8F, 0.9F}, "glow"),
               in_memory({"diffuse_indirect"}));
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(static_cast<float>(0.5 * 2 * f))));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "diffuse_indirect"));
}

/// Inside of a closed sphere-like room whose walls emit 1 and reflect `albedo`.
std::string furnace_room(int depth, float albedo) {
    std::string room = node(
        "standard_surface", "wall",
        " specular 0\n base_color " + text_of(Vec3f{albedo, albedo, albedo}) + "\n emission 1");
    room += floor("below", -1, 1, "wall") + floor("above", 1, 1, "wall");
    room += quad("left", {-1, -1, -1}, {-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1}, "wall") +
            quad("right", {1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, "wall");
    room += quad("back", {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, "wall") +
            quad("front", {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, "wall");
    return frame_text(8, 8, 4, persp_camera({0.1F, 0.2F, 0.3F}, {0.5F, -0.2F, -1}, 80),
                      " GI_diffuse_depth " + std::to_string(depth)) +
           room;
}

TEST(Radiance, ClosedFurnaceIsAGeometricSeries) {
    for (const int depth : {0, 1, 3, 10}) {
        RenderOptions options = in_memory({"emission", "diffuse", "direct"}, {"second C..O"});
        options.roulette_depth = -1;
        const Picture picture = render(furnace_room(depth, 0.7F), options);
        float truth = 0;
        for (int i = 0; i <= depth; ++i)
            truth += std::pow(0.7F, static_cast<float>(i));
        EXPECT_TRUE(check_constant(picture, "RGBA", Color::grey(truth), 1e-5)) << depth;
        EXPECT_TRUE(check_constant(picture, "emission", kWhite, 1e-6));
        EXPECT_TRUE(check_constant(picture, "diffuse", Color::grey(truth - 1), 2e-5));
        EXPECT_TRUE(check_constant(picture, "second", Color::grey(depth >= 2 ? 0.49F : 0), 1e-5));
        EXPECT_TRUE(check_black(picture, "direct"));
    }
}

TEST(Radiance, RouletteKeepsTheMean) {
    RenderOptions options = in_memory();
    options.roulette_depth = 1;
    const Picture picture = render(furnace_room(10, 0.7F), options);
    float truth = 0;
    for (int i = 0; i <= 10; ++i)
        truth += std::pow(0.7F, static_cast<float>(i));
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(truth)));
    EXPECT_FALSE(check_constant(picture, "RGBA", Color::grey(truth), 1e-5))
        << "roulette must have acted";
}

TEST(Radiance, SpecularDepthEndsMirrorsInMirrors) {
    // Two facing mirrors and one emitter between them that only the n-th reflection sees is hard to build; a mirror room
    // that emits is easy: e (1 + r + ... + r^n).
    std::string text = furnace_room(0, 0);
    text.replace(text.find("GI_diffuse_depth 0"), 18, "GI_specular_depth 3");
    text.replace(text.find("specular 0\n"), 11,
                 "specular 1\n metalness 1\n specular_roughness 0\n caustics on\n");
    text.replace(text.find("base_color 0 0 0"), 16, "base_color 0.5 0.5 0.5");
    const Picture picture = render(text, in_memory({"specular", "diffuse"}));
    // The mirror's reflectance depends on the angle a little; between 0.5 and 1 at grazing angles.
    const Color mean = picture.mean("RGBA");
    EXPECT_GT(mean.r, 1 + 0.5F + 0.25F + 0.125F - 1e-3F);
    EXPECT_LT(mean.r, 1.875F * 1.25F);
    EXPECT_TRUE(check_black(picture, "diffuse"));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"specular", "diffuse", "RGBA"}, 1))
        << "only that all layers are there";
}

}  // namespace
}  // namespace lightsieve::testing
