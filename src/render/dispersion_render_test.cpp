// transmission_dispersion in pictures: colours part where they should, white stays white, layers add up.
#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/dispersion.h"
#include "lpe/builtins.h"
#include "render/path_log.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

const char* const kDepths =
    " GI_specular_depth 20\n GI_transmission_depth 20\n GI_diffuse_depth 2\n GI_total_depth "
    "24\n indirect_sample_clamp 1e6";

std::string ball_in_a_furnace(std::string_view shader) {
    return frame_text(24, 24, 10, ortho_camera({0, 0, 5}, {0, 0, 0}, 1.9F), kDepths) +
           node("standard_surface", "glass",
                " base 0\n transmission 1\n caustics on\n " + std::string(shader)) +
           sphere("ball", {0, 0, 0}, 1, "glass") + node("skydome_light", "sky", "");
}

TEST(DispersionInPictures, WhiteStaysWhite) {
    RenderOptions options = in_memory();
    options.roulette_depth = -1;
    for (const char* roughness : {"0", "0.35"}) {
        const Picture picture = render(ball_in_a_furnace("transmission_dispersion 15\n "
                                                         "specular_roughness " +
                                                         std::string(roughness)),
                                       options);
        for (int c = 0; c < 3; ++c) {
            const Estimate e = estimate(picture, "RGBA", c);
            EXPECT_LT(e.error, 0.01);
            EXPECT_NEAR(e.mean, 1, 0.01 + kZ * e.error) << roughness << " channel " << c;
        }
    }
}

/// A slab of strong dispersion, seen slanting, over a ground that glows up to an edge.
std::string slab_before_an_edge(double edge, double abbe, std::string_view roughness = "0") {
    const float s = std::sqrt(0.5F), far = 30;
    const std::string x = std::to_string(edge);
    return frame_text(16, 16, 8, ortho_camera({5 * s, 5 * s, 0}, {0, 0, 0}, 1e-3F), kDepths) +
           node("standard_surface", "glass",
                " base 0\n transmission 1\n caustics on\n specular_IOR 1.5\n "
                "transmission_dispersion " +
                    std::to_string(abbe) + "\n specular_roughness " + std::string(roughness)) +
           floor("top", 0, far, "glass") +
           quad("bottom", {-far, -4, -far}, {far, -4, -far}, {far, -4, far}, {-far, -4, far},
                "glass") +
           node("standard_surface", "glow", " base 0\n specular 0\n emission 1") +
           quad("lit", {-20, -4.5F, 20}, {static_cast<float>(edge), -4.5F, 20},
                {static_cast<float>(edge), -4.5F, -20}, {-20, -4.5F, -20}, "glow");
}

/// x where a ray of that index meets the ground.
double landing(double n) {
    const double sine = std::sqrt(0.5), in = sine / n;
    return -4 * in / std::sqrt(1 - in * in) - 0.5;
}

TEST(DispersionInPictures, EachWavelengthGoesItsWay) {
    constexpr double kAbbe = 10;
    const double edge = landing(1.5);
    // By hand: wavelengths that land beyond the edge, with their colours and Fresnel's factors.
    constexpr int kSteps = 20000;
    std::array<double, 3> hand{};
    const double mean_reflected = [&] {
        const double c = std::sqrt(0.5), ct = std::sqrt(1 - 0.5 / 2.25);
        const double rs = (c - 1.5 * ct) / (c + 1.5 * ct), rp = (1.5 * c - ct) / (1.5 * c + ct);
        return 0.5 * (rs * rs + rp * rp);
    }();
    for (int i = 0; i < kSteps; ++i) {
        const Wavelength w = sample_wavelength((static_cast<float>(i) + 0.5F) / kSteps);
        const double n = static_cast<double>(dispersed_ior(1.5F, kAbbe, w.nm));
        if (landing(n) > edge) continue;
        const double ct = std::sqrt(0.5), c = std::sqrt(1 - 0.5 / (n * n));
        const double rs = (n * c - ct) / (n * c + ct), rp = (c - n * ct) / (c + n * ct);
        // In: the mean index decides; out: the path has its wavelength.
        for (std::size_t k = 0; k < 3; ++k)
            hand[k] += static_cast<double>(w.weight[static_cast<int>(k)]) * (1 - mean_reflected) *
                       (1 - 0.5 * (rs * rs + rp * rp)) / kSteps;
    }
    const Picture picture =
        render(slab_before_an_edge(edge, kAbbe), in_memory({}, {"straight C<TS><TS>O"}));
    EXPECT_TRUE(check_mean(
        picture, "straight",
        {static_cast<float>(hand[0]), static_cast<float>(hand[1]), static_cast<float>(hand[2])},
        2e-3));
    EXPECT_GT(hand[0], 4 * hand[2]) << "red bends least";
}

TEST(DispersionInPictures, AHugeAbbeNumberIsNone) {
    const Picture with = render(slab_before_an_edge(-4, 1e7, "0.3")),
                  without = render(slab_before_an_edge(-4, 0, "0.3"));
    EXPECT_TRUE(check_same_mean(with, "RGBA", without, "RGBA"));
    EXPECT_FALSE(check_identical(with, "RGBA", without, "RGBA")) << "it must have acted";
}

TEST(DispersionInPictures, LayersAddUpAndTheLogAgrees) {
    std::vector<std::string> aovs;
    for (const lpe::Builtin& b : lpe::builtins())
        if (b.name != "RGBA") aovs.emplace_back(b.name);
    for (const char* shader :
         {"specular_roughness 0", "specular_roughness 0.4\n transmission 0.6\n base 1",
          "specular_roughness 0.3\n coat 0.5\n thin_walled off\n metalness 0.2"}) {
        const std::string text =
            frame_text(12, 12, 2, persp_camera({0, 2, 4}, {0, 0.5F, 0}, 40), kDepths) +
            node("standard_surface", "glass",
                 " base 0\n transmission 1\n caustics on\n transmission_dispersion 20\n " +
                     std::string(shader)) +
            sphere("ball", {0, 0.7F, 0}, 0.7F, "glass") + lambert("grey", 0.6F) +
            floor("ground", 0, 3, "grey") + square_light("lamp", 3, 0.7F, " intensity 8") +
            node("skydome_light", "dome", " intensity 0.3");
        const TestScene scene(text, in_memory(aovs));
        const Picture picture = render(scene);
        for (const auto& set : lpe::additive_sets(lpe::BuiltinTable::Reference))
            EXPECT_TRUE(check_sum(picture, "RGBA", {set.begin(), set.end()}));
        EXPECT_TRUE(check_oracle(scene.scene(), picture, log_paths(scene.scene()))) << shader;
    }
}

TEST(DispersionInPictures, OpenPbrScalesTheAbbeNumber) {
    const auto text = [](std::string_view more) {
        return frame_text(20, 20, 6, ortho_camera({0, 0, 5}, {0, 0, 0}, 1.9F), kDepths) +
               node("openpbr_surface", "glass",
                    " transmission_weight 1\n specular_roughness 0\n caustics on\n " +
                        std::string(more)) +
               sphere("ball", {0, 0, 0}, 1, "glass") +
               node("standard_surface", "glow", " base 0\n specular 0\n emission 1") +
               quad("lit", {-20, -20, -3}, {0.3F, -20, -3}, {0.3F, 20, -3}, {-20, 20, -3}, "glow");
    };
    const auto colourful = [](const Picture& picture) {
        double sum = 0;
        for (std::size_t i = 0; i < picture.n_pixels(); ++i)
            sum += static_cast<double>(
                std::abs(picture.color("RGBA", i).r - picture.color("RGBA", i).b));
        return sum;
    };
    EXPECT_EQ(colourful(render(text(""))), 0);
    EXPECT_GT(colourful(render(text("transmission_dispersion_scale 1"))), 1);
    // Scale over number is what counts.
    EXPECT_TRUE(check_identical(render(text("transmission_dispersion_scale 1\n "
                                            "transmission_dispersion_abbe_number 40")),
                                "RGBA",
                                render(text("transmission_dispersion_scale 0.5\n "
                                            "transmission_dispersion_abbe_number 20")),
                                "RGBA"));
}

}  // namespace
}  // namespace lightsieve::testing
