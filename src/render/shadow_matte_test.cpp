// shadow_matte: shadows over a background, with alpha and AOVs of their own.
#include <gtest/gtest.h>

#include "render/path_log.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A matte ground seen from above; a card at height 1 hides the sun from its left half.
std::string ground(std::string_view matte, std::string_view more = "",
                   std::string_view options = "") {
    return frame_text(8, 8, 3, from_above(1), options) + node("shadow_matte", "catcher", matte) +
           floor("ground", 0, 3, "catcher") + lambert("grey", 0.5F) +
           quad("card", {-3, 1, 3}, {0, 1, 3}, {0, 1, -3}, {-3, 1, -3}, "grey",
                " visibility 254") +
           node("distant_light", "sun", " direction 0 -1 0\n intensity 2") + std::string(more);
}

const std::vector<std::string> kAovs{"shadow RGB", "shadow_diff RGB", "shadow_mask RGB",
                                     "background", "emission",        "diffuse",
                                     "specular"};

void expect_halves(const Picture& picture, const std::string& layer, Color left, Color right) {
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(picture.color(layer, i)[c], (i % 8 < 4 ? left : right)[c], 1e-5F)
                << layer << " pixel " << i;
}

TEST(ShadowMatte, ShadowsOverABackgroundColor) {
    const Picture picture =
        render(ground(" background background_color\n background_color 0.2 0.4 "
                      "0.8\n shadow_color 0.1 0 0\n shadow_opacity 0.75"),
               in_memory(kAovs));
    const Color behind{0.2F, 0.4F, 0.8F}, shaded{0.05F + 0.075F, 0.1F, 0.2F};
    expect_halves(picture, "RGBA", shaded, behind);
    expect_halves(picture, "background", behind * 0.25F, behind);
    expect_halves(picture, "emission", {0.075F, 0, 0}, kBlack);
    EXPECT_TRUE(check_black(picture, "diffuse"));
    // Alpha is the shadow itself, whatever its opacity.
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        EXPECT_NEAR(picture.alpha("RGBA", i), i % 8 < 4 ? 1 : 0, 1e-6F);
    expect_halves(picture, "shadow_mask", kWhite, kBlack);
    expect_halves(picture, "shadow", kWhite, kBlack);
    expect_halves(picture, "shadow_diff", Color::grey(0.7F * 2 * kInvPi), kBlack);
}

TEST(ShadowMatte, ShowsItsShareOfAMixture) {
    // Half of the ground is black: half of the picture's light, and alpha where no shadow is.
    const std::string text = ground(
        " background background_color\n background_color 0.2 0.4 0.8\n shadow_color 0.1 0 0",
        lambert("black", 0) +
            node("mix_shader", "half", " shader1 catcher\n shader2 black\n mix 0.5"));
    const std::string whole = "shader catcher", part = "shader half";
    const std::size_t at = text.find(whole);
    ASSERT_NE(at, std::string::npos);
    const Picture picture =
        render(std::string(text).replace(at, whole.size(), part), in_memory(kAovs));
    expect_halves(picture, "RGBA", {0.05F, 0, 0}, {0.1F, 0.2F, 0.4F});
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        EXPECT_NEAR(picture.alpha("RGBA", i), i % 8 < 4 ? 1 : 0.5F, 1e-6F);
}

TEST(ShadowMatte, ShowsTheScenesBackground) {
    const Picture picture =
        render(ground("", node("flat", "haze", " color 0.3 0.6 0.9"), " background haze"),
               in_memory(kAovs));
    expect_halves(picture, "RGBA", kBlack, {0.3F, 0.6F, 0.9F});
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "background"));
}

TEST(ShadowMatte, OpaqueWithoutAlphaMask) {
    const Picture picture = render(ground(" alpha_mask off"));
    EXPECT_NEAR(picture.mean_alpha("RGBA"), 1, 1e-6);
}

TEST(ShadowMatte, HalfOfTheLightIsHalfAShadow) {
    // A second sun, as bright and of another colour, from the side, passes below the card.
    const Picture picture =
        render(ground("", node("distant_light", "other",
                               " direction 1 -0.01 0\n intensity 200\n color 0 0 1")),
               in_memory(kAovs));
    // Sun: 2 in each channel. Other: 200 * 0.01 = 2 in blue. Mean of the channels: 2 of 2.667 is missing.
    for (const std::size_t i : {1U, 9U, 33U}) {
        EXPECT_NEAR(picture.color("shadow", i).r, 1, 1e-4F);
        EXPECT_NEAR(picture.color("shadow", i).b, 0.5F, 1e-2F);
        EXPECT_NEAR(picture.color("shadow_mask", i).g, 0.75F, 1e-2F);
    }
}

TEST(ShadowMatte, ReflectsIndirectLightAlone) {
    const std::string glow =
        node("standard_surface", "glow", " base 0\n specular 0\n emission 5") +
        sphere("ember", {0.3F, 0.6F, 0}, 0.1F, "glow", " visibility 254");
    const char* const depth = " GI_diffuse_depth 1\n GI_specular_depth 1";
    const Picture none = render(ground("", glow, depth), in_memory(kAovs)),
                  diffuse =
                      render(ground(" indirect_diffuse_enable on\n diffuse_use_background off",
                                    glow, depth),
                             in_memory(kAovs)),
                  mirror = render(
                      ground(" indirect_specular_enable on\n specular_roughness 0.4", glow, depth),
                      in_memory(kAovs, {"direct_d C<RD>L", "direct_s C<RS>L"}));
    EXPECT_TRUE(check_black(none, "diffuse"));
    EXPECT_TRUE(check_black(none, "specular"));
    EXPECT_TRUE(check_lit(diffuse, "diffuse"));
    EXPECT_TRUE(check_lit(mirror, "specular"));
    EXPECT_TRUE(check_black(mirror, "direct_s"));
    EXPECT_TRUE(check_black(mirror, "direct_d"));
    EXPECT_TRUE(check_sum(diffuse, "RGBA", {"background", "emission", "diffuse", "specular"}));
}

TEST(ShadowMatte, WithoutLightsThereIsNoShadow) {
    std::string text = ground(" background background_color\n background_color 0.2 0.4 0.8");
    text.erase(text.find("distant_light"));
    const Picture picture = render(text, in_memory(kAovs));
    EXPECT_TRUE(check_constant(picture, "RGBA", {0.2F, 0.4F, 0.8F}, 1e-5));
    EXPECT_TRUE(check_black(picture, "shadow_mask"));
    EXPECT_EQ(picture.mean_alpha("RGBA"), 0);
}

TEST(ShadowMatte, LayersAddUpAndTheLogAgrees) {
    const std::string text = ground(
        " indirect_diffuse_enable on\n diffuse_use_background off\n shadow_opacity 0.5\n "
        "indirect_specular_enable on",
        node("skydome_light", "dome", " intensity 0.4") +
            node("standard_surface", "mirror", " base 0\n metalness 1\n base_color 1 1 1") +
            sphere("ball", {0.2F, 0.4F, 0.2F}, 0.2F, "mirror") +
            square_light("lamp", 2, 0.4F, " intensity 3"),
        " GI_diffuse_depth 1\n GI_specular_depth 2");
    const TestScene scene(text, in_memory({"direct", "indirect", "emission", "background"}));
    const Picture picture = render(scene);
    EXPECT_TRUE(check_sum(picture, "RGBA", {"direct", "indirect", "emission", "background"}));
    EXPECT_TRUE(check_oracle(scene.scene(), picture, log_paths(scene.scene())));
}

}  // namespace
}  // namespace lightsieve::testing
