// The white furnace: whatever standard_surface is made of, an even white surrounding must not become brighter, and where
// nothing is lost it must vanish.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

struct Combination {
    const char* name;
    const char* shader;
    const char* type = "standard_surface";
};

/// White layers return what came in: the layering takes the albedo of upper layers for the viewer's direction, and
/// microfacets, the rough diffuse base of openpbr_surface and sheen give back or pass on what they do not reflect.
constexpr double kLoss = 0.01;

class WhiteFurnace : public ::testing::TestWithParam<Combination> {};

INSTANTIATE_TEST_SUITE_P(
    Combinations, WhiteFurnace,
    ::testing::Values(
        Combination{"diffuse", "specular 0\n base_color 1 1 1"},
        Combination{"plastic_smooth", "base_color 1 1 1\n specular_roughness 0"},
        Combination{"plastic", "base_color 1 1 1\n specular_roughness 0.3"},
        Combination{"plastic_rough", "base_color 1 1 1\n specular_roughness 0.9"},
        Combination{"plastic_ior_2_5",
                    "base_color 1 1 1\n specular_roughness 0.5\n specular_IOR 2.5"},
        Combination{"metal_smooth", "metalness 1\n base_color 1 1 1\n specular_roughness 0"},
        Combination{"metal", "metalness 1\n base_color 1 1 1\n specular_roughness 0.4"},
        Combination{"metal_rough", "metalness 1\n base_color 1 1 1\n specular_roughness 1"},
        Combination{"half_metal", "metalness 0.5\n base_color 1 1 1\n specular_roughness 0.4"},
        Combination{"anisotropic",
                    "base_color 1 1 1\n specular_roughness 0.4\n specular_anisotropy 0.7"},
        Combination{"coated", "base_color 1 1 1\n coat 1\n coat_roughness 0.2"},
        Combination{"half_coated", "base_color 1 1 1\n coat 0.5\n coat_roughness 0.6"},
        Combination{"sheen", "base_color 1 1 1\n specular 0\n sheen 1"},
        Combination{"sheen_rough",
                    "base_color 1 1 1\n specular 0\n sheen 1\n sheen_roughness 0.9"},
        Combination{"filmed", "base_color 1 1 1\n thin_film_thickness 400\n thin_film_IOR 1.8"},
        Combination{"thin_sss", "base_color 1 1 1\n thin_walled on\n subsurface 0.6\n specular 0"},
        Combination{"thin_glass", "thin_walled on\n transmission 1\n specular_roughness 0"},
        Combination{"glass_smooth", "transmission 1\n specular_roughness 0\n caustics on"},
        Combination{"glass_rough", "transmission 1\n specular_roughness 0.4\n caustics on"},
        Combination{"half_opaque", "specular 0\n base_color 1 1 1\n opacity 0.5 0.5 0.5"},
        Combination{"everything",
                    "base_color 1 1 1\n coat 0.7\n sheen 0.6\n metalness 0.3\n "
                    "specular_roughness 0.3\n transmission 0.3\n opacity "
                    "0.8 0.8 0.8\n caustics on\n thin_film_thickness 300"},
        Combination{"everything_thin",
                    "base_color 1 1 1\n coat 0.7\n sheen 0.6\n metalness 0.3\n "
                    "specular_roughness 0.3\n transmission 0.3\n subsurface 0.4\n thin_walled "
                    "on\n caustics on"},
        Combination{"openpbr_rough",
                    "base_color 1 1 1\n specular_weight 0\n base_diffuse_roughness 0.8",
                    "openpbr_surface"},
        Combination{"openpbr",
                    "base_color 1 1 1\n coat_weight 0.7\n coat_darkening 0\n fuzz_weight "
                    "0.6\n caustics on\n thin_film_weight 0.5",
                    "openpbr_surface"},
        Combination{"openpbr_glass",
                    "transmission_weight 1\n specular_roughness 0.2\n caustics on\n "
                    "transmission_dispersion_scale 1",
                    "openpbr_surface"}),
    [](const auto& made) { return std::string(made.param.name); });

TEST_P(WhiteFurnace, KeepsEnergy) {
    // Depth enough for what is caught inside of glass; no clamp, which loses; no roulette, so that noise is small.
    RenderOptions options = in_memory();
    options.roulette_depth = -1;
    const Picture picture =
        render(frame_text(24, 24, 6, ortho_camera({0, 0, 5}, {0, 0, 0}, 1.9F),
                          " GI_specular_depth 20\n GI_transmission_depth 20\n GI_diffuse_depth "
                          "20\n GI_total_depth 20\n indirect_sample_clamp 1e+30") +
                   node(GetParam().type, "made", GetParam().shader) +
                   sphere("ball", {0, 0, 0}, 1, "made") + node("skydome_light", "sky", ""),
               options);
    for (int c = 0; c < 3; ++c) {
        const Estimate e = estimate(picture, "RGBA", c);
        EXPECT_LT(e.error, 0.008) << "too much noise to tell";
        EXPECT_NEAR(e.mean, 1, kLoss + kZ * e.error);
    }
}

}  // namespace
}  // namespace lightsieve::testing
