// Bodies within bodies: which surfaces are there, how they bend light, and that none is lost.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

std::string body(std::string_view name, double ior, int priority, std::string_view more = "") {
    return node("standard_surface", name,
                " base 0\n transmission 1\n specular_roughness 0\n caustics on\n specular_IOR " +
                    std::to_string(ior) + "\n dielectric_priority " + std::to_string(priority) +
                    "\n " + std::string(more));
}

/// A horizontal slab: two squares that face away from each other.
std::string slab(std::string_view name, float bottom, float top, std::string_view shader) {
    const std::string n(name);
    const float s = 40;
    return floor(n + "_top", top, s, shader) + quad(n + "_bottom", {-s, bottom, -s},
                                                    {s, bottom, -s}, {s, bottom, s},
                                                    {-s, bottom, s}, shader);
}

constexpr double kWater = 1.33, kGlassIor = 1.5, kTilt = 0.7;  // tilt: angle from above [rad]

/// Water under the bottom of a glass and reaching into it: from 1 down to 0 it is glass, from there to -2 water. The ground
/// lies at -3. Parallel rays from the side, all to the origin of the surface.
std::string glass_of_water(std::string_view glass_more, std::string_view options = "") {
    const float s = static_cast<float>(std::sin(kTilt)), c = static_cast<float>(std::cos(kTilt));
    return frame_text(8, 8, 8, ortho_camera({5 * s, 1 + 5 * c, 0}, {0, 1, 0}, 1e-3F),
                      " GI_transmission_depth 12\n GI_specular_depth 12\n GI_total_depth 24" +
                          std::string(options)) +
           body("glass", kGlassIor, 2, glass_more) + body("water", kWater, 1, glass_more) +
           slab("wall", 0, 1, "glass") + slab("drink", -2, 0.4F, "water") +
           node("standard_surface", "glow", " base 0\n specular 0\n emission 1") +
           floor("ground", -3, 60, "glow");
}

/// Reflectance from Snell's law and the two polarisations, and the sine on the far side.
double reflectance(double sin_i, double n_i, double n_t) {
    const double sin_t = sin_i * n_i / n_t;
    const double ci = std::sqrt(1 - sin_i * sin_i), ct = std::sqrt(1 - sin_t * sin_t);
    const double rs = (n_i * ci - n_t * ct) / (n_i * ci + n_t * ct),
                 rp = (n_t * ci - n_i * ct) / (n_t * ci + n_i * ct);
    return 0.5 * (rs * rs + rp * rp);
}

struct Layer {
    double ior, thickness;
};

/// What gets through without a reflection, and how far to the side.
struct Straight {
    double transmitted = 1, shift = 0;
};

template <std::size_t N>
Straight through(const std::array<Layer, N>& layers) {
    Straight out;
    const double sine = std::sin(kTilt);
    double before = 1;
    for (const Layer& layer : layers) {
        out.transmitted *= 1 - reflectance(sine / before, before, layer.ior);
        const double s = sine / layer.ior;
        out.shift += layer.thickness * s / std::sqrt(1 - s * s);
        before = layer.ior;
    }
    return out;
}

TEST(NestedDielectrics, GlassOfWaterIsAsComputedByHand) {
    const Straight hand = through(std::array{Layer{kGlassIor, 1}, Layer{kWater, 2}, Layer{1, 1}});
    const Picture picture =
        render(glass_of_water(""), in_memory({}, {"straight C<TS><TS><TS>O", "more C<TS>{4}O"}));
    EXPECT_TRUE(
        check_mean(picture, "straight", Color::grey(static_cast<float>(hand.transmitted))));
    // Where the way ends, by the data that glass passes on.
    const Picture data = render(glass_of_water("transmit_aovs on"), in_memory({"P VECTOR"}));
    for (std::size_t i = 0; i < data.n_pixels(); ++i) {
        EXPECT_NEAR(data.color("P", i).r, static_cast<float>(-hand.shift), 2e-3F);
        EXPECT_NEAR(data.color("P", i).g, -3, 1e-4F);
    }
}

TEST(NestedDielectrics, WithoutPrioritiesEverySurfaceBordersOnAir) {
    const Picture picture = render(glass_of_water("", "\n dielectric_priorities off"),
                                   in_memory({}, {"straight C<TS>{4}O"}));
    // Down the path: into glass, into water, out of glass, out of water, each as if from or to air.
    double transmitted = 1, sine = std::sin(kTilt);
    for (const auto& [from, to] : {std::pair{1.0, kGlassIor}, std::pair{1.0, kWater},
                                   std::pair{kGlassIor, 1.0}, std::pair{kWater, 1.0}}) {
        transmitted *= 1 - reflectance(sine, from, to);
        sine *= from / to;
    }
    EXPECT_TRUE(check_mean(picture, "straight", Color::grey(static_cast<float>(transmitted))));
}

TEST(NestedDielectrics, TheOtherPriorityMakesTheOtherBodyThicker) {
    std::string text = glass_of_water("transmit_aovs on");
    text.replace(text.find("dielectric_priority 2"), 21, "dielectric_priority 0");
    const Straight hand =
        through(std::array{Layer{kGlassIor, 0.6}, Layer{kWater, 2.4}, Layer{1, 1}});
    const Picture data = render(text, in_memory({"P VECTOR"}));
    EXPECT_NEAR(data.color("P", 0).r, static_cast<float>(-hand.shift), 2e-3F);
}

TEST(NestedDielectrics, EqualsKnowNothingOfOneAnother) {
    std::string text = glass_of_water("");
    for (const char* priority : {"dielectric_priority 2", "dielectric_priority 1"})
        text.replace(text.find(priority), 21, "dielectric_priority 0");
    EXPECT_TRUE(check_identical(
        render(text), "RGBA", render(glass_of_water("", "\n dielectric_priorities off")), "RGBA"));
}

TEST(NestedDielectrics, TheBodyThatIsThereAbsorbs) {
    // Red water, blue glass: the overlap is glass, so blue.
    const std::string red = "transmission_depth 1\n transmission_color 1 0.5 0.5",
                      blue = "transmission_depth 1\n transmission_color 0.5 0.5 1";
    const std::string text =
        frame_text(8, 8, 10, from_above(1, 5),
                   " GI_transmission_depth 12\n GI_specular_depth 0\n GI_total_depth 24") +
        body("glass", 1.5, 2, blue) + body("water", 1.5, 1, red) + slab("wall", 0, 1, "glass") +
        slab("drink", -2, 0.5F, "water") +
        node("standard_surface", "glow", " base 0\n specular 0\n emission 1") +
        floor("ground", -3, 60, "glow");
    const Picture picture = render(text, in_memory({}, {"straight C<TS><TS><TS>O"}));
    const float passes = 0.96F * 0.96F;  // no reflection between glass and water of equal indices
    EXPECT_TRUE(check_mean(picture, "straight",
                           {passes * 0.5F, passes * 0.5F * 0.25F, passes * 0.25F}, 1e-4));
}

TEST(NestedDielectrics, LoseNoLight) {
    // Overlapping balls of three kinds in a white furnace.
    for (const char* roughness : {"0", "0.3"}) {
        RenderOptions options = in_memory();
        options.roulette_depth = -1;
        std::string text =
            frame_text(20, 20, 6, ortho_camera({0, 0, 5}, {0, 0, 0}, 1.5F),
                       " GI_specular_depth 40\n GI_transmission_depth 40\n GI_total_depth 60\n "
                       "indirect_sample_clamp 1e6") +
            body("glass", 1.5, 3) + body("water", 1.33, 1) + body("ice", 1.31, 1) +
            sphere("a", {-0.2F, 0, 0}, 0.8F, "glass") +
            sphere("b", {0.3F, 0, 0.1F}, 0.8F, "water") +
            sphere("c", {0.2F, 0.2F, 0}, 0.3F, "ice") + node("skydome_light", "sky", "");
        for (std::size_t at = 0;
             (at = text.find("specular_roughness 0\n", at)) != std::string::npos; ++at)
            text.replace(at, 20, std::string("specular_roughness ") + roughness);
        const Picture picture = render(text, options);
        const Estimate e = estimate(picture, "RGBA", 0);
        EXPECT_NEAR(e.mean, 1, 0.012 + kZ * e.error) << roughness;
    }
}

TEST(NestedDielectrics, ShadowsSkipSurfacesThatAreNotThere) {
    // Tinted shadows on a stone in the water: the top of the water lies in the glass and takes nothing away.
    std::string text =
        frame_text(6, 6, 2, ortho_camera({0.2F, -1.4F, 0.001F}, {0, -1.5F, 0}, 1e-3F)) +
        body("glass", 1.5, 2) + body("water", 3, 1) + slab("wall", 0, 1, "glass") +
        slab("drink", -2, 0.5F, "water") + lambert("grey", 0.5F) +
        floor("stone", -1.5F, 1, "grey") + node("distant_light", "sun", " direction 0 -1 0");
    for (std::size_t at; (at = text.find("caustics on")) != std::string::npos;)
        text.replace(at, 11, "caustics off");
    // The camera did not enter the water, so that the glass borders on air for it: twice 4 % are reflected.
    EXPECT_TRUE(check_constant(render(text), "RGBA", Color::grey(0.5F * kInvPi * 0.9216F), 1e-3));
}

}  // namespace
}  // namespace lightsieve::testing
