// Radiance that is known in closed form, and what lights, opacity and masks do to it.
#include <gtest/gtest.h>

#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// Parallel rays straight down onto the origin, a square `width` wide.
std::string from_above(float width, float height = 2) { return ortho_camera({0, height, 0}, {0, 0, 0}, width, {0, 0, -1}); }
std::string lambert(std::string_view name, float kd) { return node("lambert", name, " Kd " + text_of(kd)); }
/// Rays toward the origin from the side, all to nearly the same point: each pixel is an estimate of the same radiance.
std::string at_the_origin() { return ortho_camera({0.7F, 0.5F, 0.4F}, {0, 0, 0}, 1e-3F); }
std::string square_light(std::string_view name, float y, float half, std::string_view more) {
    // Shines downward.
    const float h = half;
    return node("quad_light", name, " vertices 4 1 VECTOR " + text_of(Vec3f{-h, y, -h}) + "  " + text_of(Vec3f{h, y, -h}) + "  " + text_of(Vec3f{h, y, h}) + "  " + text_of(Vec3f{-h, y, h}) + '\n' + std::string(more));
}

// Lights -----------------------------------------------------------------------------------------------------------------

TEST(Radiance, SphereInAFurnaceIsItsAlbedo) {
    // A convex body under an even dome of radiance 1: exactly Kd, from wherever it is seen.
    const Picture picture = render(frame_text(24, 24, 6, ortho_camera({0, 0, 5}, {0, 0, 0}, 1.3F)) + lambert("grey", 0.65F) + sphere("ball", {0, 0, 0}, 1, "grey") + node("skydome_light", "sky", ""));
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(0.65F)));
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        ASSERT_EQ(picture.alpha("RGBA", i), 1);
}

TEST(Radiance, DistantLightOnALambertPlane) {
    // E cos albedo / pi, without any noise.
    const Picture picture = render(frame_text(6, 6, 2, from_above(1)) + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey") + node("distant_light", "sun", " direction 0.6 -0.8 0\n intensity 3\n color 1 0.5 0.25\n exposure 1"));
    const float e = 6 * 0.8F * 0.5F * kInvPi;
    EXPECT_TRUE(check_constant(picture, "RGBA", {e, e / 2, e / 4}, 1e-5));
}

TEST(Radiance, DistantLightWithAnAngleHasTheSameIrradiance) {
    // The disc of the sky lies wholly above the horizon, so that E cos holds for its centre.
    const Picture picture = render(frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey") + node("distant_light", "sun", " direction 0.6 -0.8 0\n angle 30\n intensity 3"));
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(3 * 0.8F * 0.5F * kInvPi)));
}

TEST(Radiance, PointLightFallsOffWithTheSquare) {
    const Picture picture = render(frame_text(6, 6, 2, at_the_origin()) + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey") + node("point_light", "bulb", " position 1.5 2 0\n intensity 10"));
    // cos = 2 / 2.5, r = 2.5; the picture is 1e-3 wide.
    EXPECT_TRUE(check_constant(picture, "RGBA", Color::grey(10 * 0.8F / 6.25F * 0.5F * kInvPi), 1e-3));
}

TEST(Radiance, SphereLightIsAPointLightFromOutside) {
    // Irradiance of a sphere that the horizon does not cut: pi L (R/d)^2 cos = I cos / d^2.
    const Picture picture = render(frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey") + node("point_light", "bulb", " position 1.5 2 0\n intensity 10\n radius 1.2"));
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
    const double h = 0.8, f = corner_factor(0.6 / h, 0.4 / h) + corner_factor(0.6 / h, 0.9 / h) + corner_factor(1 / h, 0.4 / h) + corner_factor(1 / h, 0.9 / h);
    const std::string vertices = " vertices 4 1 VECTOR -0.6 0.8 -0.4  1 0.8 -0.4  1 0.8 0.9  -0.6 0.8 0.9";
    const std::string scene = frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey");
    const double area = 1.6 * 1.3;
    EXPECT_TRUE(check_mean(render(scene + node("quad_light", "key", vertices + "\n normalize off\n intensity 2")), "RGBA", Color::grey(static_cast<float>(0.5 * 2 * f))));
    EXPECT_TRUE(check_mean(render(scene + node("quad_light", "key", vertices + "\n intensity 2")), "RGBA", Color::grey(static_cast<float>(0.5 * 2 / area * f))));
}

TEST(Radiance, MeshLightIsTheSameQuad) {
    const std::string scene = frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey");
    const std::string mesh = node("mesh_light", "key", " mesh shape\n intensity 2") + quad("shape", {-0.6F, 0.8F, -0.4F}, {1, 0.8F, -0.4F}, {1, 0.8F, 0.9F}, {-0.6F, 0.8F, 0.9F}, "grey", " visibility 0");
    const double h = 0.8, f = corner_factor(0.6 / h, 0.4 / h) + corner_factor(0.6 / h, 0.9 / h) + corner_factor(1 / h, 0.4 / h) + corner_factor(1 / h, 0.9 / h);
    EXPECT_TRUE(check_mean(render(scene + mesh), "RGBA", Color::grey(static_cast<float>(0.5 * 2 / (1.6 * 1.3) * f))));
}

TEST(Radiance, ManyLightsAddUp) {
    // The choice among lights is a matter of noise only: 25 small lights are one large one.
    std::string many, one = square_light("large", 1, 1, " intensity 4");
    for (int x = 0; x < 5; ++x)
        for (int z = 0; z < 5; ++z) {
            const float cx = -0.8F + 0.4F * static_cast<float>(x), cz = -0.8F + 0.4F * static_cast<float>(z);
            many += node("quad_light", "l" + std::to_string(x) + std::to_string(z),
                         " intensity 0.16\n matrix 0.2 0 0 0  0 0 -0.2 0  0 0.2 0 0  " + text_of(cx) + " 1 " + text_of(cz) + " 1");
        }
    const std::string scene = frame_text(20, 20, 4, at_the_origin()) + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey");
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

INSTANTIATE_TEST_SUITE_P(Lights, LightStrategies,
                         ::testing::Values(AnyLight{"quad", "quad_light", " vertices 4 1 VECTOR -1 1 -1  0.5 1 -1  0.5 1 0.5  -1 1 0.5"}, AnyLight{"skewed_quad", "quad_light", " vertices 4 1 VECTOR -1 1 -1  0.5 1.5 -1  0.9 1 0.5  -1.5 1 0.8"},
                                           AnyLight{"disk", "disk_light", " radius 0.8\n matrix 1 0 0 0  0 0 -1 0  0 1 0 0  -0.3 1 -0.3 1"}, AnyLight{"cylinder", "cylinder_light", " radius 0.3\n top -1 1.2 -0.5\n bottom 0.6 1.2 -0.5"},
                                           AnyLight{"sphere", "point_light", " radius 0.6\n position -0.5 1.2 -0.3"}, AnyLight{"spot", "spot_light", " radius 0.5\n matrix 1 0 0 0  0 0 -1 0  0 1 0 0  -0.5 1.2 -0.3 1"},
                                           AnyLight{"distant", "distant_light", " angle 40\n direction 0.6 -1 0.3"}, AnyLight{"mesh", "mesh_light", " mesh lamp_shape"}, AnyLight{"even_dome", "skydome_light", ""},
                                           AnyLight{"dome", "skydome_light", " color cells\n resolution 64"}, AnyLight{"textured_quad", "quad_light", " color cells\n vertices 4 1 VECTOR -1 1 -1  0.5 1 -1  0.5 1 0.5  -1 1 0.5"}),
                         [](const auto& made) { return std::string(made.param.name); });

TEST_P(LightStrategies, Agree) {
    const auto with = [&](const char* more) {
        return render(frame_text(20, 20, 8, at_the_origin()) + node("standard_surface", "gloss", " base_color 0.3 0.3 0.3\n specular_IOR 2.5\n specular_roughness 0.35") + floor("plane", 0, 1, "gloss") +
                          node("checkerboard", "cells", " color1 1 0.2 0.1\n color2 0.1 0.5 1\n u_frequency 2\n v_frequency 2") +                           node("polymesh", "lamp_shape", " visibility 0\n nsides 2 1 UINT 3 3\n vidxs 6 1 UINT 0 1 2 3 4 5\n vlist 6 1 VECTOR -1 1 -1  0.5 1.3 -1  -0.5 1 0.5  -1 0.7 0.6  0.4 0.8 -0.2  0.3 0.9 0.9") +
                          node(GetParam().type, "key", std::string(GetParam().body) + more),
                      in_memory({"diffuse", "specular"}));
    };
    const Picture both = with(""), samples = with("\n cast_shadows off");
    for (const char* layer : {"diffuse", "specular"}) {
        EXPECT_TRUE(check_lit(both, layer));
        EXPECT_TRUE(check_same_mean(both, layer, samples, layer));
    }
}

// Emission and bounces ---------------------------------------------------------------------------------------------------

TEST(Radiance, EmissiveObjectsShowTheirColor) {
    const std::string scene = frame_text(4, 4, 2, from_above(1));
    const Picture flat = render(scene + node("flat", "glow", " color 0.2 3 0.5") + floor("plane", 0, 1, "glow"), in_memory({"emission"}));
    EXPECT_TRUE(check_constant(flat, "RGBA", {0.2F, 3, 0.5F}, 1e-6));
    EXPECT_TRUE(check_equal(flat, "RGBA", flat, "emission"));
    const Picture surface = render(scene + node("standard_surface", "glow", " base 0\n specular 0\n emission 2\n emission_color 0.1 1 0.5") + floor("plane", 0, 1, "glow"), in_memory({"emission"}));
    EXPECT_TRUE(check_constant(surface, "emission", {0.2F, 2, 1}, 1e-6));
}

TEST(Radiance, EmissiveObjectsLightOthers) {
    // The same closed form as for the quad light, found by rays alone; it is O and so indirect.
    const double h = 0.8, f = corner_factor(0.6 / h, 0.4 / h) + corner_factor(0.6 / h, 0.9 / h) + corner_factor(1 / h, 0.4 / h) + corner_factor(1 / h, 0.9 / h);
    const Picture picture = render(frame_text(20, 20, 6, ortho_camera({0.3F, 0.5F, 0.2F}, {0, 0, 0}, 1e-3F), " GI_diffuse_depth 1") + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey") + node("flat", "glow", " color 2 2 2") +
                                       quad("lamp", {-0.6F, 0.8F, -0.4F}, {1, 0.8F, -0.4F}, {1, 0.8F, 0.9F}, {-0.6F, 0.8F, 0.9F}, "glow"),
                                   in_memory({"diffuse_indirect"}));
    EXPECT_TRUE(check_mean(picture, "RGBA", Color::grey(static_cast<float>(0.5 * 2 * f))));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "diffuse_indirect"));
}

/// Inside of a closed sphere-like room whose walls emit 1 and reflect `albedo`.
std::string furnace_room(int depth, float albedo) {
    std::string room = node("standard_surface", "wall", " specular 0\n base_color " + text_of(Vec3f{albedo, albedo, albedo}) + "\n emission 1");
    room += floor("below", -1, 1, "wall") + floor("above", 1, 1, "wall");
    room += quad("left", {-1, -1, -1}, {-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1}, "wall") + quad("right", {1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, "wall");
    room += quad("back", {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, "wall") + quad("front", {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, "wall");
    return frame_text(8, 8, 4, persp_camera({0.1F, 0.2F, 0.3F}, {0.5F, -0.2F, -1}, 80), " GI_diffuse_depth " + std::to_string(depth)) + room;
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
    EXPECT_FALSE(check_constant(picture, "RGBA", Color::grey(truth), 1e-5)) << "roulette must have acted";
}

TEST(Radiance, SpecularDepthEndsMirrorsInMirrors) {
    // Two facing mirrors and one emitter between them that only the n-th reflection sees is hard to build; a mirror room
    // that emits is easy: e (1 + r + ... + r^n).
    std::string text = furnace_room(0, 0);
    text.replace(text.find("GI_diffuse_depth 0"), 18, "GI_specular_depth 3");
    text.replace(text.find("specular 0\n"), 11, "specular 1\n metalness 1\n specular_roughness 0\n caustics on\n");
    text.replace(text.find("base_color 0 0 0"), 16, "base_color 0.5 0.5 0.5");
    const Picture picture = render(text, in_memory({"specular", "diffuse"}));
    // The mirror's reflectance depends on the angle a little; between 0.5 and 1 at grazing angles.
    const Color mean = picture.mean("RGBA");
    EXPECT_GT(mean.r, 1 + 0.5F + 0.25F + 0.125F - 1e-3F);
    EXPECT_LT(mean.r, 1.875F * 1.25F);
    EXPECT_TRUE(check_black(picture, "diffuse"));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"specular", "diffuse", "RGBA"}, 1)) << "only that all layers are there";
}

// Opacity ----------------------------------------------------------------------------------------------------------------

TEST(Opacity, BlendsOverWhatIsBehind) {
    const std::string veil = node("standard_surface", "veil", " base 0\n specular 0\n emission 1\n emission_color 1 0.5 0\n opacity 0.25 0.5 0.75") + floor("sheet", 1, 1, "veil");
    // Over nothing.
    const Picture alone = render(frame_text(16, 16, 4, from_above(1)) + veil, in_memory({"emission"}));
    EXPECT_TRUE(check_constant(alone, "RGBA", {0.25F, 0.25F, 0}, 1e-5));
    for (std::size_t i = 0; i < alone.n_pixels(); ++i)
        ASSERT_NEAR(alone.alpha("RGBA", i), 0.5F, 1e-6F) << "the mean of the channels";
    // Over an opaque emitter: alpha becomes 1 in the mean.
    const Picture over = render(frame_text(16, 16, 4, from_above(1)) + veil + node("flat", "glow", " color 2 2 2") + floor("ground", 0, 1, "glow"), in_memory({"emission"}));
    EXPECT_TRUE(check_mean(over, "RGBA", {0.25F + 0.75F * 2, 0.25F + 0.5F * 2, 0.25F * 2}));
    EXPECT_NEAR(over.mean_alpha("RGBA"), 1, 1e-3);
    EXPECT_TRUE(check_equal(over, "RGBA", over, "emission")) << "passing straight through is no event";
}

TEST(Opacity, BackgroundShowsThrough) {
    const Picture picture = render(frame_text(16, 16, 4, from_above(1), " background haze") + node("flat", "haze", " color 1 2 4") + node("standard_surface", "veil", " base 0\n specular 0\n opacity 0.5 0.5 0.5") + floor("sheet", 1, 1, "veil"),
                                   in_memory({"background"}));
    EXPECT_TRUE(check_mean(picture, "RGBA", {0.5F, 1, 2}));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "background"));
}

/// A floor under veils that let a colour through each.
std::string veiled_floor(int n_veils, std::string_view light, std::string_view options = "") {
    std::string veils;
    for (int i = 0; i < n_veils; ++i)
        veils += floor("veil" + std::to_string(i), 0.5F + 0.1F * static_cast<float>(i), 20, "veil_shader");
    return frame_text(16, 16, 4, ortho_camera({0.3F, 0.4F, 0.1F}, {0, 0, 0}, 1e-3F), options) + node("standard_surface", "veil_shader", " base 0\n specular 0\n opacity 0.2 0.5 0.8") + lambert("grey", 0.5F) +
           floor("plane", 0, 20, "grey") + veils + std::string(light);
}

TEST(Opacity, ShadowsAreTinted) {
    const Color through(0.8F, 0.5F, 0.2F);
    const std::string sun = node("distant_light", "sun", " direction 0 -1 0\n intensity 3");
    const float e = 3 * 0.5F * kInvPi;
    EXPECT_TRUE(check_constant(render(veiled_floor(1, sun)), "RGBA", through * e, 1e-5));
    EXPECT_TRUE(check_constant(render(veiled_floor(2, sun)), "RGBA", through * through * e, 1e-5));
    // Area lights are found by shadow rays and by rays that pass the veil by chance: both must agree.
    const std::string key = square_light("key", 2, 1.5F, " intensity 9");
    const Picture with = render(veiled_floor(1, key)), without = render(veiled_floor(0, key));
    const Color open = without.mean("RGBA");
    EXPECT_TRUE(check_mean(with, "RGBA", through * open, 0.004)) << "the slack is the noise of the open picture's mean";
}

TEST(Opacity, TransparencyDepthIsALimit) {
    const std::string sun = node("distant_light", "sun", " direction 0 -1 0\n intensity 3");
    const Color through(0.8F, 0.5F, 0.2F);
    const float e = 3 * 0.5F * kInvPi;
    EXPECT_TRUE(check_constant(render(veiled_floor(3, sun, " auto_transparency_depth 3")), "RGBA", through * through * through * e, 1e-5));
    EXPECT_TRUE(check_black(render(veiled_floor(3, sun, " auto_transparency_depth 2")), "RGBA"));
    // Camera rays as well: three veils before an emitter.
    const auto picture = [](int depth) {
        return render(frame_text(16, 16, 4, from_above(1, 5), " auto_transparency_depth " + std::to_string(depth)) + node("standard_surface", "veil", " base 0\n specular 0\n opacity 0.5 0.5 0.5") +
                      node("flat", "glow", " color 8 8 8") + floor("a", 1, 1, "veil") + floor("b", 2, 1, "veil") + floor("c", 3, 1, "veil") + floor("ground", 0, 1, "glow"));
    };
    EXPECT_TRUE(check_mean(picture(3), "RGBA", kWhite));
    EXPECT_TRUE(check_black(picture(2), "RGBA"));
}

TEST(Opacity, ShadowDensityAndColorOfLights) {
    const std::string wall = node("flat", "black", " color 0 0 0") + floor("lid", 1, 20, "black");
    const auto with = [&](std::string_view light) { return render(veiled_floor(0, node("distant_light", "sun", " direction 0 -1 0\n intensity 3\n" + std::string(light))) + wall); };
    const float e = 3 * 0.5F * kInvPi;
    EXPECT_TRUE(check_black(with(""), "RGBA"));
    EXPECT_TRUE(check_constant(with(" shadow_density 0.75"), "RGBA", Color::grey(0.25F * e), 1e-5));
    EXPECT_TRUE(check_constant(with(" shadow_color 0.1 0.2 0.3"), "RGBA", Color(0.1F, 0.2F, 0.3F) * e, 1e-5));
    EXPECT_TRUE(check_constant(with(" cast_shadows off"), "RGBA", Color::grey(e), 1e-5));
}

TEST(Opacity, AreaLightWithoutShadowsKeepsAllItsLight) {
    // Rays that leave by a lobe would be stopped by the lid: only light samples may count.
    const std::string lid = node("flat", "black", " color 0 0 0") + floor("lid", 1, 20, "black");
    const Picture open = render(veiled_floor(0, square_light("key", 2, 1.5F, " intensity 9")));
    EXPECT_TRUE(check_same_mean(render(veiled_floor(0, square_light("key", 2, 1.5F, " intensity 9\n cast_shadows off")) + lid), "RGBA", open, "RGBA"));
    // A lid that casts no shadows is as good as none to a light, but rays meet it.
    const std::string ghost = node("flat", "black", " color 0 0 0") + floor("lid", 1, 20, "black", " visibility 253");
    EXPECT_TRUE(check_same_mean(render(veiled_floor(0, square_light("key", 2, 1.5F, " intensity 9")) + ghost), "RGBA", open, "RGBA"));
    // The other way round: the lid casts shadows but no ray meets it.
    const std::string shade = node("flat", "black", " color 0 0 0") + floor("lid", 1, 20, "black", " visibility 2");
    EXPECT_TRUE(check_black(render(veiled_floor(0, square_light("key", 2, 1.5F, " intensity 9")) + shade), "RGBA"));
}

TEST(Opacity, SelfShadowsAndReceivedShadows) {
    // Floor and lid are one mesh.
    const std::string mesh = "polymesh\n{\n name both\n nsides 2 1 UINT 4 4\n vidxs 8 1 UINT 0 1 2 3 4 5 6 7\n vlist 8 1 VECTOR -9 0 -9  -9 0 9  9 0 9  9 0 -9  -9 1 -9  -9 1 9  9 1 9  9 1 -9\n shader grey\n";
    const std::string head = frame_text(16, 16, 4, ortho_camera({0.3F, 0.4F, 0.1F}, {0, 0, 0}, 1e-3F)) + lambert("grey", 0.5F) + square_light("key", 2, 1.5F, " intensity 9");
    const Picture open = render(head + floor("plane", 0, 9, "grey"));
    EXPECT_TRUE(check_black(render(head + mesh + "}\n"), "RGBA"));
    EXPECT_TRUE(check_same_mean(render(head + mesh + " self_shadows off\n}\n"), "RGBA", open, "RGBA"));
    EXPECT_TRUE(check_same_mean(render(head + floor("plane", 0, 9, "grey", " receive_shadows off") + floor("lid", 1, 9, "grey")), "RGBA", open, "RGBA"));
}

// Masks, matte, light visibility -------------------------------------------------------------------------------------------

TEST(Matte, ShapeIsAHoleThatStillActs) {
    const std::string text = frame_text(16, 16, 3, persp_camera({0, 1, 3}, {0, 0.5F, 0}, 50)) + lambert("grey", 0.5F) + floor("plane", 0, 5, "grey") + sphere("ball", {0, 0.5F, 0}, 0.5F, "grey", " matte on") +
                             node("distant_light", "sun", " direction 0 -1 0\n intensity 3");
    const Picture picture = render(text);
    const std::size_t center = 8 * 16 + 8;
    EXPECT_EQ(picture.color("RGBA", center), kBlack);
    EXPECT_EQ(picture.alpha("RGBA", center), 0);
    // Its shadow stays on the floor.
    std::string without = text;
    without.replace(without.find("radius 0.5"), 10, "radius 0.5\n visibility 0");
    const Picture open = render(without);
    std::size_t shadowed = 0;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        shadowed += picture.alpha("RGBA", i) == 1 && picture.color("RGBA", i).r < 0.5F * open.color("RGBA", i).r ? 1 : 0;
    EXPECT_GT(shadowed, 3U);
}

TEST(Matte, ShaderHasAnAlphaOfItsOwn) {
    const Picture picture = render(frame_text(4, 4, 2, from_above(1)) + node("matte", "cut", " color 0.5 0.25 1 0.4") + floor("plane", 0, 1, "cut"));
    EXPECT_TRUE(check_constant(picture, "RGBA", {0.5F, 0.25F, 1}, 1e-6));
    EXPECT_NEAR(picture.mean_alpha("RGBA"), 0.4, 1e-6);
}

TEST(LightsSeen, ByTheCameraAsFarAsTheySay) {
    // From below into a light of radiance 4 / 4.
    const auto seen = [](std::string_view camera, std::string_view behind) {
        return render(frame_text(8, 8, 4, ortho_camera({0, 0, 0}, {0, 1, 0}, 1, {0, 0, 1})) + square_light("key", 2, 1, " intensity 4\n camera " + std::string(camera)) + std::string(behind), in_memory({"emission", "background"}));
    };
    const std::string glow = node("flat", "glow", " color 3 3 3") + floor("above", 4, 5, "glow");
    EXPECT_TRUE(check_black(seen("0", ""), "RGBA"));
    EXPECT_EQ(seen("0", "").mean_alpha("RGBA"), 0);
    const Picture full = seen("1", glow), half = seen("0.5", glow), alone = seen("0.5", "");
    EXPECT_TRUE(check_constant(full, "RGBA", kWhite, 1e-5));
    EXPECT_EQ(full.mean_alpha("RGBA"), 1);
    EXPECT_TRUE(check_equal(full, "RGBA", full, "emission")) << "CL is emission";
    EXPECT_TRUE(check_constant(half, "RGBA", Color::grey(0.5F + 0.5F * 3), 1e-5));
    EXPECT_NEAR(half.mean_alpha("RGBA"), 1, 1e-6);
    EXPECT_NEAR(alone.mean_alpha("RGBA"), 0.5, 1e-6);
}

TEST(LightsSeen, SkydomeIsBackground) {
    const std::string head = frame_text(4, 4, 2, ortho_camera({0, 0, 0}, {0, 1, 0}, 1, {0, 0, 1}));
    const Picture seen = render(head + node("skydome_light", "sky", " color 1 2 3\n aov \"s\""), in_memory({"background", "emission", "background_s"}));
    EXPECT_TRUE(check_constant(seen, "background", {1, 2, 3}, 1e-5));
    EXPECT_TRUE(check_equal(seen, "background", seen, "background_s"));
    EXPECT_TRUE(check_black(seen, "emission"));
    EXPECT_EQ(seen.mean_alpha("RGBA"), 1);
    const Picture hidden = render(head + node("skydome_light", "sky", " camera 0"));
    EXPECT_TRUE(check_black(hidden, "RGBA"));
    EXPECT_EQ(hidden.mean_alpha("RGBA"), 0);
}

TEST(LightsSeen, AovIndirectMakesADomeBackground) {
    const auto with = [](std::string_view more) {
        return render(frame_text(8, 8, 2, from_above(1)) + lambert("grey", 0.5F) + floor("plane", 0, 1, "grey") + node("skydome_light", "sky", std::string(more)), in_memory({"direct", "indirect", "diffuse_direct", "diffuse_indirect"}));
    };
    const Picture as_light = with(""), as_background = with(" aov_indirect on");
    EXPECT_TRUE(check_identical(as_light, "RGBA", as_background, "RGBA"));
    EXPECT_TRUE(check_black(as_light, "indirect"));
    EXPECT_TRUE(check_black(as_background, "direct"));
    EXPECT_TRUE(check_equal(as_light, "direct", as_background, "indirect"));
    EXPECT_TRUE(check_equal(as_background, "RGBA", as_background, "diffuse_indirect"));
}

// Multipliers of lights ----------------------------------------------------------------------------------------------------

/// A glossy coloured corner under one light with these lines.
std::string corner(std::string_view light) {
    return frame_text(16, 16, 3, persp_camera({0.4F, 1, 2}, {0, 0.4F, 0}, 50), " GI_diffuse_depth 2\n GI_specular_depth 2\n low_light_threshold 0") + node("standard_surface", "gloss", " base_color 0.6 0.5 0.4\n specular_roughness 0.3\n caustics on") +
           floor("plane", 0, 1.5F, "gloss") + quad("back", {-1.5F, 0, -1}, {1.5F, 0, -1}, {1.5F, 2, -1}, {-1.5F, 2, -1}, "gloss") + square_light("key", 2.5F, 0.8F, " intensity 10\n" + std::string(light));
}

TEST(LightMultipliers, ScaleExactlyTheirShare) {
    const std::vector<std::string> aovs{"diffuse", "diffuse_direct", "specular_direct", "direct", "indirect"};
    const std::vector<std::string> lpes{"last_d C.*<RD>L", "last_s C.*<RS>L"};
    const Picture plain = render(corner(""), in_memory(aovs, lpes));
    const auto scaled = [&](const Picture& p, const std::string& layer, float factor) {
        for (std::size_t i = 0; i < p.n_pixels(); ++i)
            for (int c = 0; c < 3; ++c) {
                const float expected = plain.color(layer, i)[c] * factor;
                if (std::abs(p.color(layer, i)[c] - expected) > 1e-4F * expected + 1e-7F) return ::testing::AssertionFailure() << layer << " pixel " << i << ": " << p.color(layer, i)[c] << ", expected " << expected;
            }
        return ::testing::AssertionSuccess();
    };
    for (const char* lit : {"last_d", "last_s", "indirect"})
        ASSERT_TRUE(check_lit(plain, lit));
    // The last scattering before the light decides between diffuse and specular.
    const Picture diffuse = render(corner(" diffuse 0.5"), in_memory(aovs, lpes));
    EXPECT_TRUE(scaled(diffuse, "last_d", 0.5F));
    EXPECT_TRUE(scaled(diffuse, "last_s", 1));
    const Picture specular = render(corner(" specular 0"), in_memory(aovs, lpes));
    EXPECT_TRUE(scaled(specular, "last_d", 1));
    EXPECT_TRUE(check_black(specular, "last_s"));
    const Picture indirect = render(corner(" indirect 0.25"), in_memory(aovs, lpes));
    EXPECT_TRUE(scaled(indirect, "direct", 1));
    EXPECT_TRUE(scaled(indirect, "indirect", 0.25F));
    const Picture direct_only = render(corner(" max_bounces 0"), in_memory(aovs, lpes));
    EXPECT_TRUE(scaled(direct_only, "direct", 1));
    EXPECT_TRUE(check_black(direct_only, "indirect"));
}

TEST(LightMultipliers, TransmissionHidesLightsBehindGlass) {
    const auto with = [](std::string_view light) {
        return render(frame_text(8, 8, 2, ortho_camera({0, 0, 0}, {0, 1, 0}, 1, {0, 0, 1})) + node("standard_surface", "pane", " base 0\n specular 0\n thin_walled on\n transmission 1\n specular_roughness 0\n transmission_color 0.5 1 1") +
                          floor("glass", 1, 2, "pane") + square_light("key", 2, 1, " intensity 4\n" + std::string(light)),
                      in_memory({"transmission_direct"}));
    };
    EXPECT_TRUE(check_black(with(""), "RGBA"));
    const Picture seen = with(" transmission 0.5");
    EXPECT_TRUE(check_constant(seen, "transmission_direct", {0.25F, 0.5F, 0.5F}, 1e-5));
}

TEST(LightGroupsOfShapes, ChooseLightsAndShadows) {
    const std::string lights = node("distant_light", "a", " direction 0 -1 0\n intensity 3\n color 1 0 0") + node("distant_light", "b", " direction 0 -1 0\n intensity 3\n color 0 1 0");
    const std::string head = frame_text(4, 4, 2, ortho_camera({0.3F, 0.4F, 0.1F}, {0, 0, 0}, 0.01F)) + lambert("grey", 0.5F) + lights;
    const float e = 3 * 0.5F * kInvPi;
    EXPECT_TRUE(check_constant(render(head + floor("plane", 0, 1, "grey")), "RGBA", {e, e, 0}, 1e-5));
    EXPECT_TRUE(check_constant(render(head + floor("plane", 0, 1, "grey", " use_light_group on\n light_group \"b\"")), "RGBA", {0, e, 0}, 1e-5));
    EXPECT_TRUE(check_black(render(head + floor("plane", 0, 1, "grey", " use_light_group on")), "RGBA"));
    // Under a lid only the lights of the shadow group cast shadows.
    const std::string lid = floor("lid", 1, 2, "grey");
    EXPECT_TRUE(check_constant(render(head + lid + floor("plane", 0, 1, "grey", " use_shadow_group on\n shadow_group \"b\"")), "RGBA", {e, 0, 0}, 1e-5));
}

TEST(LightGroupsOfShapes, AlsoHoldForRaysThatMeetTheLight) {
    // Area lights: what rays find must obey the group as well.
    const std::string head = frame_text(16, 16, 4, at_the_origin()) + node("standard_surface", "gloss", " specular_roughness 0.2") + square_light("a", 2, 1, " intensity 5\n color 1 0 0") + square_light("b", 3, 2, " intensity 5\n color 0 1 0");
    const Picture only_b = render(head + floor("plane", 0, 1, "gloss", " use_light_group on\n light_group \"b\""));
    for (std::size_t i = 0; i < only_b.n_pixels(); ++i)
        ASSERT_EQ(only_b.color("RGBA", i).r, 0);
    std::string without_a = head;
    without_a.replace(without_a.find("intensity 5"), 11, "intensity 0");
    EXPECT_TRUE(check_same_mean(only_b, "RGBA", render(without_a + floor("plane", 0, 1, "gloss")), "RGBA"));
}

// Caustics -----------------------------------------------------------------------------------------------------------------

TEST(Caustics, AreSeenByDiffuseRaysOnlyWhereTheShaderSaysSo) {
    const auto with = [](std::string_view caustics) {
        return render(frame_text(16, 16, 4, persp_camera({0, 1.5F, 2.5F}, {0, 0.3F, 0}, 45), " GI_diffuse_depth 2\n GI_specular_depth 2") + lambert("grey", 0.5F) + floor("plane", 0, 1.5F, "grey") +
                          node("standard_surface", "mirror", " base_color 0.9 0.9 0.9\n metalness 1\n specular_roughness 0.2\n caustics " + std::string(caustics)) +
                          quad("back", {-1.5F, 0, -1}, {1.5F, 0, -1}, {1.5F, 2, -1}, {-1.5F, 2, -1}, "mirror") + square_light("key", 2.5F, 0.8F, " intensity 10"),
                      in_memory({"diffuse_direct", "specular"}, {"caustic C<RD><RS>.*", "seen_in_mirror C<RS><RD>L"}));
    };
    const Picture off = with("off"), on = with("on");
    EXPECT_TRUE(check_black(off, "caustic"));
    EXPECT_TRUE(check_lit(on, "caustic"));
    EXPECT_TRUE(check_lit(off, "seen_in_mirror"));
    EXPECT_TRUE(check_equal(off, "diffuse_direct", on, "diffuse_direct"));
}

// Instances and motion -----------------------------------------------------------------------------------------------------

TEST(Instances, EqualACopiedShape) {
    const std::string move = " matrix 0.8 0 0.6 0  0 1.5 0 0  -0.6 0 0.8 0  0.3 0.1 -0.2 1";
    const std::string head = frame_text(24, 24, 3, persp_camera({0, 1.5F, 4}, {0, 0.3F, 0}, 45)) + node("standard_surface", "gloss", " specular_roughness 0.3") + node("distant_light", "sun", " direction 0.4 -0.8 -0.3\n intensity 3") +
                             node("skydome_light", "sky", " intensity 0.3");
    const std::string copy = sphere("ball", {0.2F, 0.1F, 0}, 0.6F, "gloss", move) + quad("wall", {-1, 0, -1}, {1, 0, -1}, {1, 1, -1}, {-1, 1, -1}, "gloss", move);
    const std::string source = sphere("ball", {0.2F, 0.1F, 0}, 0.6F, "gloss", " visibility 0") + quad("wall", {-1, 0, -1}, {1, 0, -1}, {1, 1, -1}, {-1, 1, -1}, "gloss", " visibility 0");
    const std::string instances = node("ginstance", "i1", " node ball\n visibility 255\n" + move) + node("ginstance", "i2", " node wall\n visibility 255\n" + move);
    const Picture a = render(head + copy), b = render(head + source + instances);
    EXPECT_TRUE(check_same_mean(a, "RGBA", b, "RGBA"));
    // The same samples meet the same points but for rounding, so nearly all pixels agree closely.
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.n_pixels(); ++i)
        differ += std::abs(a.color("RGBA", i).g - b.color("RGBA", i).g) > 1e-3F ? 1 : 0;
    EXPECT_LT(differ, a.n_pixels() / 50);
}

TEST(Instances, OverrideShaderAndNest) {
    const std::string head = frame_text(8, 8, 2, from_above(1)) + node("flat", "red", " color 1 0 0") + node("flat", "blue", " color 0 0 1");
    const std::string source = floor("plane", 0, 1, "red", " visibility 0");
    EXPECT_TRUE(check_constant(render(head + source + node("ginstance", "i", " node plane\n visibility 255\n shader blue")), "RGBA", {0, 0, 1}, 1e-6));
    const std::string nested = node("ginstance", "inner", " node plane\n visibility 0\n matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 -5 0 1") + node("ginstance", "outer", " node inner\n visibility 255\n matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 5 0 1");
    const Picture both = render(head + source + nested, in_memory({"Z FLOAT"}));
    EXPECT_TRUE(check_constant(both, "RGBA", {1, 0, 0}, 1e-6));
    EXPECT_NEAR(both.color("Z", 0).r, 2, 1e-5) << "the two matrices cancel";
}

TEST(Motion, CoverageOfAMovingEmitterIsItsShareOfTheShutter) {
    // A plate 1 wide slides from x in -1.5..-0.5 to 0.5..1.5 while the shutter is open: at x it covers for the part of
    // the time in which |x - center| < 1/2, which is 1/2 for |x| < 1/2 and falls to 0 at |x| = 3/2.
    const std::string camera = node("ortho_camera", "cam", " position 0 2 0\n look_at 0 0 0\n up 0 0 -1\n screen_window_min -2 -2\n screen_window_max 2 2\n shutter_start 0\n shutter_end 1");
    const std::string plate = node("flat", "glow", " color 1 1 1") + quad("plate", {-0.5F, 0, -3}, {-0.5F, 0, 3}, {0.5F, 0, 3}, {0.5F, 0, -3}, "glow", " matrix 1 2 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 -1 0 0 1  1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1");
    const Picture picture = render(frame_text(16, 16, 10, camera) + plate);
    for (int x = 0; x < 16; ++x) {
        double mean = 0, truth = 0;
        for (std::size_t y = 0; y < 16; ++y)
            mean += static_cast<double>(picture.color("RGBA", y * 16 + static_cast<std::size_t>(x)).r) / 16;
        for (int s = 0; s < 100; ++s) {
            const double at = std::abs((x + (s + 0.5) / 100) / 4 - 2);
            truth += (at < 0.5 ? 0.5 : at < 1.5 ? (1.5 - at) / 2 : 0) / 100;
        }
        // 1600 samples a column: 0.0125 at most for independent ones, which stratified ones are better than.
        EXPECT_NEAR(mean, truth, 0.03) << "column " << x;
    }
}

TEST(Motion, VerticesMoveToo) {
    const std::string camera = node("ortho_camera", "cam", " position 0 2 0\n look_at 0 0 0\n up 0 0 -1\n screen_window_min -2 -2\n screen_window_max 2 2\n shutter_start 0\n shutter_end 1");
    const std::string plate = node("flat", "glow", " color 1 1 1") + node("polymesh", "plate",
                                                                         " nsides 1 1 UINT 4\n vidxs 4 1 UINT 0 1 2 3\n shader glow\n vlist 4 2 VECTOR -1.5 0 -3  -1.5 0 3  -0.5 0 3  -0.5 0 -3  0.5 0 -3  0.5 0 3  1.5 0 3  1.5 0 -3");
    const std::string same = node("flat", "glow", " color 1 1 1") + quad("plate", {-0.5F, 0, -3}, {-0.5F, 0, 3}, {0.5F, 0, 3}, {0.5F, 0, -3}, "glow", " matrix 1 2 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 -1 0 0 1  1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1");
    EXPECT_TRUE(check_same_mean(render(frame_text(16, 16, 4, camera) + plate), "RGBA", render(frame_text(16, 16, 4, camera) + same), "RGBA"));
}

}  // namespace
}  // namespace lightsieve::testing
