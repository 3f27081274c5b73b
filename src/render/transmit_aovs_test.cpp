// transmit_aovs: what is seen through glass goes to its own AOVs, alpha and data layers; the beauty stays as it is.
#include <gtest/gtest.h>

#include "lpe/builtins.h"
#include "render/path_log.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

std::vector<std::string> all_builtins() {
    std::vector<std::string> out;
    for (const lpe::Builtin& b : lpe::builtins())
        if (b.name != "RGBA") out.emplace_back(b.name);
    return out;
}

struct Glass {
    const char* name;
    const char* shader;
    bool thin = false;
};

/// Two bodies of glass before a wall, a glowing ball and the sky.
std::string scene_with(const Glass& glass, bool on, std::string_view options = "") {
    const std::string shader = std::string(" base 0\n transmission 1\n ") + glass.shader +
                               (on ? "\n transmit_aovs on" : "");
    return frame_text(16, 12, 3, persp_camera({0, 1.2F, 5}, {0, 0.8F, 0}, 45),
                      " GI_diffuse_depth 2\n GI_specular_depth 6\n GI_transmission_depth 12\n "
                      "GI_total_depth 16\n indirect_sample_clamp 1e6" +
                          std::string(options)) +
           node("standard_surface", "glass", shader) +
           node("standard_surface", "wall",
                " base_color 0.7 0.5 0.3\n specular_roughness 0.4\n coat 0.4") +
           node("standard_surface", "glow", " base 0\n specular 0\n emission 2") +
           sphere("marble", {-0.5F, 0.9F, 0.5F}, 0.7F, "glass") +
           quad("pane", {0.3F, 0, 1}, {1.6F, 0, 1}, {1.6F, 1.6F, 1}, {0.3F, 1.6F, 1}, "glass") +
           floor("ground", 0, 3, "wall") + sphere("ember", {0.9F, 0.6F, -0.5F}, 0.4F, "glow") +
           node("distant_light", "sun", " direction -0.3 -1 -0.4\n aov \"sun\"") +
           node("skydome_light", "dome", " intensity 0.5\n aov \"sky\"");
}

class TransmitAovs : public ::testing::TestWithParam<Glass> {};

INSTANTIATE_TEST_SUITE_P(
    Kinds, TransmitAovs,
    ::testing::Values(
        Glass{"smooth", "specular_roughness 0\n caustics on"},
        Glass{"rough", "specular_roughness 0.3\n caustics on"},
        Glass{"no_caustics", "specular_roughness 0.1"},
        Glass{"tinted", "transmission_color 0.5 0.8 0.9\n transmission_depth 1\n caustics on"},
        Glass{"dispersing", "specular_roughness 0.2\n transmission_dispersion 25\n caustics on"},
        Glass{"half_wood", "transmission 0.5\n base 1\n caustics on"},
        Glass{"thin", "thin_walled on\n specular_roughness 0\n caustics on", true}),
    [](const auto& made) { return std::string(made.param.name); });

TEST_P(TransmitAovs, LightGoesToWhatIsSeen) {
    // The sun through rough glass is a light that the camera sees; the sky is background, whoever found it.
    const std::vector<std::string> past{"past_d C<TS>*<RD>.*", "past_c C<TS>*<RS'coat'>.*",
                                        "past_o C<TS>*(O|<L.'sun'>)",
                                        "past_b C<TS>*(B|<L.'sky'>)"};
    const Picture off = render(scene_with(GetParam(), false), in_memory(all_builtins(), past));
    const Picture on = render(scene_with(GetParam(), true), in_memory(all_builtins()));
    // No random choice depends on it, so the pictures are the same.
    EXPECT_TRUE(check_equal(on, "RGBA", off, "RGBA"));
    EXPECT_TRUE(check_equal(on, "diffuse", off, "past_d"));
    EXPECT_TRUE(check_equal(on, "coat", off, "past_c"));
    EXPECT_TRUE(check_equal(on, "emission", off, "past_o"));
    EXPECT_TRUE(check_equal(on, "background", off, "past_b"));
    EXPECT_TRUE(check_lit(off, "transmission"));
    EXPECT_TRUE(check_black(on, "transmission"));
    EXPECT_TRUE(check_black(on, "transmission_albedo"));
    EXPECT_TRUE(check_lit(on, "emission"));
    for (const auto& set : lpe::additive_sets(lpe::BuiltinTable::Reference))
        EXPECT_TRUE(check_sum(on, "RGBA", {set.begin(), set.end()}));
}

TEST_P(TransmitAovs, ThePathLogAgrees) {
    const TestScene scene(
        scene_with(GetParam(), true),
        in_memory(all_builtins(), {"second C.<RD>.*", "odd C(<RS>|<TS>)*<RD>A"}));
    EXPECT_TRUE(check_oracle(scene.scene(), render(scene), log_paths(scene.scene())));
}

// Alpha and data ---------------------------------------------------------------------------------------------------------

/// A pane of thin glass, seen straight on, over a part of a floor.
std::string pane(std::string_view shader, std::string_view more) {
    return frame_text(8, 8, 6, from_above(1)) +
           node("standard_surface", "glass",
                " base 0\n specular_roughness 0\n thin_walled on\n transmission 1\n " +
                    std::string(shader)) +
           floor("pane", 1, 2, "glass") + std::string(more);
}

constexpr float kReflected = 0.04F;  // of an index of 1.5, face on

TEST(TransmitAovsAlpha, GlassBeforeNothingIsAHoleButForItsReflection) {
    const Picture off = render(pane("", "")), on = render(pane("transmit_aovs on", ""));
    for (std::size_t i = 0; i < on.n_pixels(); ++i) {
        EXPECT_NEAR(off.alpha("RGBA", i), 1, 1e-6F);
        EXPECT_NEAR(on.alpha("RGBA", i), kReflected, 1e-5F);
    }
    // Tinted glass covers what it takes away.
    const Picture tinted = render(pane("transmit_aovs on\n transmission_color 0.5 0.5 0.5", ""));
    EXPECT_NEAR(tinted.mean_alpha("RGBA"), 1 - 0.5 * (1 - kReflected), 1e-5);
}

TEST(TransmitAovsAlpha, GlassBeforeSomethingIsOpaque) {
    const std::string floor_below = lambert("grey", 0.5F) + floor("ground", 0, 2, "grey");
    const Picture on = render(pane("transmit_aovs on", floor_below));
    EXPECT_NEAR(on.mean_alpha("RGBA"), 1, 4 * std::sqrt(0.04 / (64 * 36)));
    // A matte hole behind it stays one.
    const Picture hole = render(
        pane("transmit_aovs on", node("matte", "hole", "") + floor("ground", 0, 2, "hole")));
    EXPECT_NEAR(hole.mean_alpha("RGBA"), kReflected, 1e-5);
}

TEST(TransmitAovsAlpha, PastTheDepthLimitIsBlackAndNotAHole) {
    std::string text = pane("transmit_aovs on", "");
    for (const float y : {0.8F, 0.6F})
        text += floor(y > 0.7F ? "second" : "third", y, 2, "glass");
    text.replace(text.find("AA_samples"), 10, "GI_transmission_depth 1\n AA_samples");
    EXPECT_GT(render(text).mean_alpha("RGBA"), 0.95);
}

TEST(TransmitAovsData, LayersShowWhatIsBehind) {
    const std::string behind = lambert("grey", 0.5F) + floor("ground", 0, 2, "grey", " id 77");
    const std::vector<std::string> data{"Z FLOAT", "N VECTOR", "P VECTOR", "ID UINT",
                                        "opacity RGB"};
    const Picture on = render(pane("transmit_aovs on", behind), in_memory(data)),
                  off = render(pane("", behind), in_memory(data));
    const std::string bare = frame_text(8, 8, 6, from_above(1)) + behind;
    const Picture alone = render(bare, in_memory(data));
    for (const char* layer : {"Z", "N", "P", "ID", "opacity"}) {
        EXPECT_TRUE(check_equal(on, layer, alone, layer, 1e-4)) << layer;
    }
    EXPECT_FALSE(check_equal(off, "Z", alone, "Z"));
    EXPECT_FALSE(check_equal(off, "ID", alone, "ID"));
}

TEST(TransmitAovsData, OpenPbrHasItToo) {
    const std::string text = frame_text(8, 8, 3, from_above(1)) +
                             node("openpbr_surface", "glass",
                                  " specular_roughness 0\n geometry_thin_walled on\n "
                                  "transmission_weight 1\n transmission_transmit_aovs on") +
                             floor("pane", 1, 2, "glass") + lambert("grey", 0.5F) +
                             floor("ground", 0, 2, "grey") + node("skydome_light", "dome", "");
    const Picture picture = render(text, in_memory({"diffuse", "transmission", "Z FLOAT"}));
    EXPECT_TRUE(check_black(picture, "transmission"));
    EXPECT_TRUE(check_lit(picture, "diffuse"));
    EXPECT_TRUE(check_constant(picture, "Z", Color::grey(2), 1e-5));
}

TEST(TransmitAovs, ProbesShowTheAlbedoBehind) {
    const std::string behind = lambert("grey", 0.5F) + floor("ground", 0, 2, "grey");
    const Picture picture =
        render(pane("transmit_aovs on", behind), in_memory({"diffuse_albedo", "albedo"}));
    EXPECT_TRUE(check_mean(picture, "diffuse_albedo", Color::grey(0.5F * (1 - kReflected))));
    EXPECT_TRUE(
        check_mean(picture, "albedo", Color::grey(0.5F * (1 - kReflected) + kReflected), 1e-4));
}

}  // namespace
}  // namespace lightsieve::testing
