// The white furnace: whatever standard_surface is made of, an even white surrounding must not become brighter, and where
// nothing is lost it must vanish.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

struct Combination {
    const char* name;
    const char* shader;
    double least, most;  ///< of the mean over the ball, seen from all angles
};

/// The layering takes the albedo of upper layers for the viewer's direction alone, so white layers return what came in up
/// to the error of the albedo tables (half a percent). Layers that lose light have a wide lower bound: microfacets without
/// multiple scattering (metal edges are compensated), sheen.
class WhiteFurnace : public ::testing::TestWithParam<Combination> {};

INSTANTIATE_TEST_SUITE_P(
    Combinations, WhiteFurnace,
    ::testing::Values(
        Combination{"diffuse", "specular 0\n base_color 1 1 1", 1 - 1e-4, 1 + 1e-4},
        Combination{"oren_nayar", "specular 0\n base_color 1 1 1\n diffuse_roughness 0.8", 0.97,
                    1.003},
        Combination{"plastic_smooth", "base_color 1 1 1\n specular_roughness 0", 0.995, 1.003},
        Combination{"plastic", "base_color 1 1 1\n specular_roughness 0.3", 0.992, 1.004},
        Combination{"plastic_rough", "base_color 1 1 1\n specular_roughness 0.9", 0.99, 1.005},
        Combination{"plastic_ior_2_5",
                    "base_color 1 1 1\n specular_roughness 0.5\n specular_IOR 2.5", 0.99, 1.005},
        Combination{"metal_smooth", "metalness 1\n base_color 1 1 1\n specular_roughness 0", 0.98,
                    1.002},
        Combination{"metal", "metalness 1\n base_color 1 1 1\n specular_roughness 0.4", 0.97,
                    1.005},
        Combination{"metal_rough", "metalness 1\n base_color 1 1 1\n specular_roughness 1", 0.95,
                    1.01},
        Combination{"half_metal", "metalness 0.5\n base_color 1 1 1\n specular_roughness 0.4",
                    0.97, 1.005},
        Combination{"anisotropic",
                    "base_color 1 1 1\n specular_roughness 0.4\n specular_anisotropy 0.7", 0.97,
                    1.02},
        Combination{"coated", "base_color 1 1 1\n coat 1\n coat_roughness 0.2", 0.985, 1.006},
        Combination{"half_coated", "base_color 1 1 1\n coat 0.5\n coat_roughness 0.6", 0.985,
                    1.006},
        Combination{"sheen", "base_color 1 1 1\n specular 0\n sheen 1", 0.98, 1.006},
        Combination{
            "everything",
            "base_color 1 1 1\n coat 0.7\n sheen 0.6\n metalness 0.3\n specular_roughness 0.3",
            0.97, 1.01},
        Combination{"thin_sss", "base_color 1 1 1\n thin_walled on\n subsurface 0.6\n specular 0",
                    1 - 1e-3, 1 + 1e-3},
        Combination{"thin_glass", "thin_walled on\n transmission 1\n specular_roughness 0", 0.995,
                    1.003},
        Combination{"glass_smooth", "transmission 1\n specular_roughness 0\n caustics on", 0.99,
                    1.003},
        Combination{"glass_rough", "transmission 1\n specular_roughness 0.4\n caustics on", 0.96,
                    1.01},
        Combination{"half_opaque", "specular 0\n base_color 1 1 1\n opacity 0.5 0.5 0.5", 1 - 3e-3,
                    1 + 3e-3}),
    [](const auto& made) { return std::string(made.param.name); });

TEST_P(WhiteFurnace, KeepsEnergy) {
    // Depth enough for what is caught inside of glass; no roulette, so that noise is small.
    RenderOptions options = in_memory();
    options.roulette_depth = -1;
    const Picture picture =
        render(frame_text(24, 24, 6, ortho_camera({0, 0, 5}, {0, 0, 0}, 1.9F),
                          " GI_specular_depth 20\n GI_transmission_depth 20\n GI_diffuse_depth "
                          "20\n GI_total_depth 20") +
                   node("standard_surface", "made", GetParam().shader) +
                   sphere("ball", {0, 0, 0}, 1, "made") + node("skydome_light", "sky", ""),
               options);
    for (int c = 0; c < 3; ++c) {
        const Estimate e = estimate(picture, "RGBA", c);
        EXPECT_LT(e.error, 0.008) << "too much noise to tell";
        EXPECT_GE(e.mean, GetParam().least - kZ * e.error);
        EXPECT_LE(e.mean, GetParam().most + kZ * e.error);
    }
}

}  // namespace
}  // namespace lightsieve::testing
