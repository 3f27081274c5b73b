// What hides light or lets it through: opacity, shadows, masks, matte, multipliers and groups of lights, caustics.
#include <gtest/gtest.h>

#include <cmath>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

// Opacity ----------------------------------------------------------------------------------------------------------------

TEST(Opacity, BlendsOverWhatIsBehind) {
    const std::string veil =
        node(
            "standard_surface", "veil",
            " base 0\n specular 0\n emission 1\n emission_color 1 0.5 0\n opacity 0.25 0.5 0.75") +
        floor("sheet", 1, 1, "veil");
    // Over nothing.
    const Picture alone =
        render(frame_text(16, 16, 4, from_above(1)) + veil, in_memory({"emission"}));
    EXPECT_TRUE(check_constant(alone, "RGBA", {0.25F, 0.25F, 0}, 1e-5));
    for (std::size_t i = 0; i < alone.n_pixels(); ++i)
        ASSERT_NEAR(alone.alpha("RGBA", i), 0.5F, 1e-6F) << "the mean of the channels";
    // Over an opaque emitter: alpha becomes 1 in the mean.
    const Picture over =
        render(frame_text(16, 16, 4, from_above(1)) + veil + node("flat", "glow", " color 2 2 2") +
                   floor("ground", 0, 1, "glow"),
               in_memory({"emission"}));
    EXPECT_TRUE(check_mean(over, "RGBA", {0.25F + 0.75F * 2, 0.25F + 0.5F * 2, 0.25F * 2}));
    EXPECT_NEAR(over.mean_alpha("RGBA"), 1, 1e-3);
    EXPECT_TRUE(check_equal(over, "RGBA", over, "emission"))
        << "passing straight through is no event";
}

TEST(Opacity, BackgroundShowsThrough) {
    const Picture picture =
        render(frame_text(16, 16, 4, from_above(1), " background haze") +
                   node("flat", "haze", " color 1 2 4") +
                   node("standard_surface", "veil", " base 0\n specular 0\n opacity 0.5 0.5 0.5") +
                   floor("sheet", 1, 1, "veil"),
               in_memory({"background"}));
    EXPECT_TRUE(check_mean(picture, "RGBA", {0.5F, 1, 2}));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "background"));
}

/// A floor under veils that let a colour through each.
std::string veiled_floor(int n_veils, std::string_view light, std::string_view options = "") {
    std::string veils;
    for (int i = 0; i < n_veils; ++i)
        veils += floor("veil" + std::to_string(i), 0.5F + 0.1F * static_cast<float>(i), 20,
                       "veil_shader");
    return frame_text(16, 16, 4, ortho_camera({0.3F, 0.4F, 0.1F}, {0, 0, 0}, 1e-3F), options) +
           node("standard_surface", "veil_shader", " base 0\n specular 0\n opacity 0.2 0.5 0.8") +
           lambert("grey", 0.5F) + floor("plane", 0, 20, "grey") + veils + std::string(light);
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
    EXPECT_TRUE(check_mean(with, "RGBA", through * open, 0.004))
        << "the slack is the noise of the open picture's mean";
}

TEST(Opacity, TransparencyDepthIsALimit) {
    const std::string sun = node("distant_light", "sun", " direction 0 -1 0\n intensity 3");
    const Color through(0.8F, 0.5F, 0.2F);
    const float e = 3 * 0.5F * kInvPi;
    EXPECT_TRUE(check_constant(render(veiled_floor(3, sun, " auto_transparency_depth 3")), "RGBA",
                               through * through * through * e, 1e-5));
    EXPECT_TRUE(check_black(render(veiled_floor(3, sun, " auto_transparency_depth 2")), "RGBA"));
    // Camera rays as well: three veils before an emitter.
    const auto picture = [](int depth) {
        return render(
            frame_text(16, 16, 4, from_above(1, 5),
                       " auto_transparency_depth " + std::to_string(depth)) +
            node("standard_surface", "veil", " base 0\n specular 0\n opacity 0.5 0.5 0.5") +
            node("flat", "glow", " color 8 8 8") + floor("a", 1, 1, "veil") +
            floor("b", 2, 1, "veil") + floor("c", 3, 1, "veil") + floor("ground", 0, 1, "glow"));
    };
    EXPECT_TRUE(check_mean(picture(3), "RGBA", kWhite));
    EXPECT_TRUE(check_black(picture(2), "RGBA"));
}

TEST(Opacity, ClearPanesTintShadowsOfDiffuseLight) {
    // With `caustics` off no light is focused; what the pane lets through reaches diffuse surfaces straight.
    const auto under = [](std::string_view pane, std::string_view light) {
        return render(frame_text(16, 16, 4, ortho_camera({0.3F, 0.4F, 0.1F}, {0, 0, 0}, 1e-3F),
                                 " GI_diffuse_depth 1") +
                      lambert("grey", 0.5F) + floor("plane", 0, 20, "grey") +
                      (pane.empty() ? std::string()
                                    : node("standard_surface", "pane_shader",
                                           " base 0\n specular 0\n thin_walled on\n transmission "
                                           "1\n transmission_color 0.2 0.5 0.8\n" +
                                               std::string(pane)) +
                                          floor("pane", 0.5F, 20, "pane_shader")) +
                      std::string(light));
    };
    const Color tint(0.2F, 0.5F, 0.8F);
    for (const std::string& light :
         {node("distant_light", "sun", " direction 0 -1 0\n intensity 3"),
          square_light("key", 2, 1.5F, " intensity 9"),
          node("skydome_light", "sky", " camera 0\n transmission 0")}) {
        const Color open = under("", light).mean("RGBA");
        // The slack is the noise of the open picture's mean.
        EXPECT_TRUE(check_mean(under(" caustics off", light), "RGBA", tint * open, 0.01));
        EXPECT_TRUE(check_mean(under(" caustics off\n opacity 0.5 0.5 0.5", light), "RGBA",
                               (tint * 0.5F + Color::grey(0.5F)) * open, 0.01));
    }
}

TEST(Opacity, ShadowDensityAndColorOfLights) {
    const std::string wall = node("flat", "black", " color 0 0 0") + floor("lid", 1, 20, "black");
    const auto with = [&](std::string_view light) {
        return render(
            veiled_floor(0, node("distant_light", "sun",
                                 " direction 0 -1 0\n intensity 3\n" + std::string(light))) +
            wall);
    };
    const float e = 3 * 0.5F * kInvPi;
    EXPECT_TRUE(check_black(with(""), "RGBA"));
    EXPECT_TRUE(
        check_constant(with(" shadow_density 0.75"), "RGBA", Color::grey(0.25F * e), 1e-5));
    EXPECT_TRUE(check_constant(with(" shadow_color 0.1 0.2 0.3"), "RGBA",
                               Color(0.1F, 0.2F, 0.3F) * e, 1e-5));
    EXPECT_TRUE(check_constant(with(" cast_shadows off"), "RGBA", Color::grey(e), 1e-5));
}

TEST(Opacity, AreaLightWithoutShadowsKeepsAllItsLight) {
    // Rays that leave by a lobe would be stopped by the lid: only light samples may count.
    const std::string lid = node("flat", "black", " color 0 0 0") + floor("lid", 1, 20, "black");
    const Picture open = render(veiled_floor(0, square_light("key", 2, 1.5F, " intensity 9")));
    EXPECT_TRUE(check_same_mean(
        render(veiled_floor(0, square_light("key", 2, 1.5F, " intensity 9\n cast_shadows off")) +
               lid),
        "RGBA", open, "RGBA"));
    // A lid that casts no shadows is as good as none to a light, but rays meet it.
    const std::string ghost =
        node("flat", "black", " color 0 0 0") + floor("lid", 1, 20, "black", " visibility 253");
    EXPECT_TRUE(check_same_mean(
        render(veiled_floor(0, square_light("key", 2, 1.5F, " intensity 9")) + ghost), "RGBA",
        open, "RGBA"));
    // The other way round: the lid casts shadows but no ray meets it.
    const std::string shade =
        node("flat", "black", " color 0 0 0") + floor("lid", 1, 20, "black", " visibility 2");
    EXPECT_TRUE(check_black(
        render(veiled_floor(0, square_light("key", 2, 1.5F, " intensity 9")) + shade), "RGBA"));
}

TEST(Opacity, SelfShadowsAndReceivedShadows) {
    // Floor and lid are one mesh.
    const std::string mesh =
        "polymesh\n{\n name both\n nsides 2 1 UINT 4 4\n vidxs 8 1 UINT 0 1 2 3 4 5 6 7\n vlist 8 "
        "1 VECTOR -9 0 -9  -9 0 9  9 0 9  9 0 -9  -9 1 -9  -9 1 9  9 1 9  9 1 -9\n shader grey\n";
    const std::string head =
        frame_text(16, 16, 4, ortho_camera({0.3F, 0.4F, 0.1F}, {0, 0, 0}, 1e-3F)) +
        lambert("grey", 0.5F) + square_light("key", 2, 1.5F, " intensity 9");
    const Picture open = render(head + floor("plane", 0, 9, "grey"));
    EXPECT_TRUE(check_black(render(head + mesh + "}\n"), "RGBA"));
    EXPECT_TRUE(
        check_same_mean(render(head + mesh + " self_shadows off\n}\n"), "RGBA", open, "RGBA"));
    EXPECT_TRUE(
        check_same_mean(render(head + floor("plane", 0, 9, "grey", " receive_shadows off") +
                               floor("lid", 1, 9, "grey")),
                        "RGBA", open, "RGBA"));
}

// Masks, matte, light visibility -------------------------------------------------------------------------------------------

TEST(Matte, ShapeIsAHoleThatStillActs) {
    const std::string text = frame_text(16, 16, 3, persp_camera({0, 1, 3}, {0, 0.5F, 0}, 50)) +
                             lambert("grey", 0.5F) + floor("plane", 0, 5, "grey") +
                             sphere("ball", {0, 0.5F, 0}, 0.5F, "grey", " matte on") +
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
        shadowed += picture.alpha("RGBA", i) == 1 &&
                            picture.color("RGBA", i).r < 0.5F * open.color("RGBA", i).r
                        ? 1
                        : 0;
    EXPECT_GT(shadowed, 3U);
}

TEST(Matte, ShaderHasAnAlphaOfItsOwn) {
    const Picture picture =
        render(frame_text(4, 4, 2, from_above(1)) + node("matte", "cut", " color 0.5 0.25 1 0.4") +
               floor("plane", 0, 1, "cut"));
    EXPECT_TRUE(check_constant(picture, "RGBA", {0.5F, 0.25F, 1}, 1e-6));
    EXPECT_NEAR(picture.mean_alpha("RGBA"), 0.4, 1e-6);
}

TEST(LightsSeen, ByTheCameraAsFarAsTheySay) {
    // From below into a light of radiance 4 / 4.
    const auto seen = [](std::string_view camera, std::string_view behind) {
        return render(
            frame_text(8, 8, 4, ortho_camera({0, 0, 0}, {0, 1, 0}, 1, {0, 0, 1})) +
                square_light("key", 2, 1, " intensity 4\n camera " + std::string(camera)) +
                std::string(behind),
            in_memory({"emission", "background"}));
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
    const Picture seen = render(head + node("skydome_light", "sky", " color 1 2 3\n aov \"s\""),
                                in_memory({"background", "emission", "background_s"}));
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
        return render(frame_text(8, 8, 2, from_above(1)) + lambert("grey", 0.5F) +
                          floor("plane", 0, 1, "grey") +
                          node("skydome_light", "sky", std::string(more)),
                      in_memory({"direct", "indirect", "diffuse_direct", "diffuse_indirect"}));
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
    return frame_text(16, 16, 3, persp_camera({0.4F, 1, 2}, {0, 0.4F, 0}, 50),
                      " GI_diffuse_depth 2\n GI_specular_depth 2\n low_light_threshold 0") +
           node("standard_surface", "gloss",
                " base_color 0.6 0.5 0.4\n specular_roughness 0.3\n caustics on") +
           floor("plane", 0, 1.5F, "gloss") +
           quad("back", {-1.5F, 0, -1}, {1.5F, 0, -1}, {1.5F, 2, -1}, {-1.5F, 2, -1}, "gloss") +
           square_light("key", 2.5F, 0.8F, " intensity 10\n" + std::string(light));
}

TEST(LightMultipliers, ScaleExactlyTheirShare) {
    const std::vector<std::string> aovs{"diffuse", "diffuse_direct", "specular_direct", "direct",
                                        "indirect"};
    const std::vector<std::string> lpes{"last_d C.*<RD>L", "last_s C.*<RS>L"};
    const Picture plain = render(corner(""), in_memory(aovs, lpes));
    const auto scaled = [&](const Picture& p, const std::string& layer, float factor) {
        for (std::size_t i = 0; i < p.n_pixels(); ++i)
            for (int c = 0; c < 3; ++c) {
                const float expected = plain.color(layer, i)[c] * factor;
                if (std::abs(p.color(layer, i)[c] - expected) > 1e-4F * expected + 1e-7F)
                    return ::testing::AssertionFailure()
                           << layer << " pixel " << i << ": " << p.color(layer, i)[c]
                           << ", expected " << expected;
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
        return render(frame_text(8, 8, 2, ortho_camera({0, 0, 0}, {0, 1, 0}, 1, {0, 0, 1})) +
                          node("standard_surface", "pane",
                               " base 0\n specular_IOR 1\n thin_walled on\n transmission 1\n "
                               "specular_roughness 0\n transmission_color 0.5 1 1") +
                          floor("glass", 1, 2, "pane") +
                          square_light("key", 2, 1, " intensity 4\n" + std::string(light)),
                      in_memory({"transmission_direct"}));
    };
    EXPECT_TRUE(check_black(with(""), "RGBA"));
    const Picture seen = with(" transmission 0.5");
    EXPECT_TRUE(check_constant(seen, "transmission_direct", {0.25F, 0.5F, 0.5F}, 1e-5));
}

TEST(LightMultipliers, SssScalesWhatScattersBelowTheSurface) {
    const auto with = [](std::string_view shader, std::string_view light,
                         const std::vector<std::string>& warnings) {
        const std::string text =
            frame_text(8, 8, 2, from_above(1)) +
            node("standard_surface", "skin",
                 " base 1\n base_color 0.5 0.5 0.5\n specular 0\n subsurface 0.5\n" +
                     std::string(shader)) +
            floor("plane", 0, 2, "skin") +
            node("distant_light", "sun", " direction 0 -1 0\n" + std::string(light)) +
            // Thin walls pass light on to the other side.
            node("distant_light", "below", " direction 0 1 0\n" + std::string(light));
        return render(TestScene(text, in_memory({"diffuse", "sss"}), warnings));
    };
    const auto mean = [](const Picture& p, const char* layer) {
        return static_cast<double>(p.mean(layer).g);
    };
    // Subsurface scattering is drawn as diffuse reflection for now; its light is that of sss all the same.
    const std::vector<std::string> drawn_otherwise{"subsurface scattering is not supported yet"};
    const Picture plain = with("", "", drawn_otherwise),
                  none = with("", " sss 0", drawn_otherwise),
                  no_diffuse = with("", " diffuse 0", drawn_otherwise);
    ASSERT_TRUE(check_lit(plain, "sss"));
    EXPECT_TRUE(check_black(none, "sss"));
    EXPECT_NEAR(mean(none, "diffuse"), mean(plain, "diffuse"), 1e-6);
    EXPECT_NEAR(mean(no_diffuse, "sss"), mean(plain, "sss"), 1e-6);
    EXPECT_TRUE(check_black(no_diffuse, "diffuse"));
    // In thin walls the same lobe is diffuse transmission: the factor is that of diffuse light.
    const Picture thin = with(" thin_walled on", "", {}),
                  thin_none = with(" thin_walled on", " sss 0", {});
    ASSERT_TRUE(check_lit(thin, "sss"));
    EXPECT_TRUE(check_identical(thin_none, "sss", thin, "sss"));
    EXPECT_TRUE(check_black(with(" thin_walled on", " diffuse 0", {}), "sss"));
}

TEST(LightGroupsOfShapes, ChooseLightsAndShadows) {
    const std::string lights =
        node("distant_light", "a", " direction 0 -1 0\n intensity 3\n color 1 0 0") +
        node("distant_light", "b", " direction 0 -1 0\n intensity 3\n color 0 1 0");
    const std::string head =
        frame_text(4, 4, 2, ortho_camera({0.3F, 0.4F, 0.1F}, {0, 0, 0}, 0.01F)) +
        lambert("grey", 0.5F) + lights;
    const float e = 3 * 0.5F * kInvPi;
    EXPECT_TRUE(
        check_constant(render(head + floor("plane", 0, 1, "grey")), "RGBA", {e, e, 0}, 1e-5));
    EXPECT_TRUE(check_constant(
        render(head + floor("plane", 0, 1, "grey", " use_light_group on\n light_group \"b\"")),
        "RGBA", {0, e, 0}, 1e-5));
    EXPECT_TRUE(
        check_black(render(head + floor("plane", 0, 1, "grey", " use_light_group on")), "RGBA"));
    // A lid casts shadows in the lights of its shadow group.
    EXPECT_TRUE(check_constant(
        render(head + floor("plane", 0, 1, "grey") +
               floor("lid", 1, 2, "grey", " use_shadow_group on\n shadow_group \"b\"")),
        "RGBA", {e, 0, 0}, 1e-5));
}

TEST(LightGroupsOfShapes, ShadowGroupsKeepAllOfAnAreaLight) {
    const std::string head = frame_text(16, 16, 4, at_the_origin()) + lambert("grey", 0.5F) +
                             square_light("a", 2, 1, " intensity 5") +
                             node("distant_light", "none", " intensity 0");
    const Picture open = render(head + floor("plane", 0, 9, "grey"));
    const auto under = [&](const std::string& group) {
        return render(head + floor("plane", 0, 9, "grey") +
                      floor("lid", 1, 9, "grey", " use_shadow_group on\n shadow_group " + group));
    };
    EXPECT_TRUE(check_same_mean(under("\"none\""), "RGBA", open, "RGBA"));
    EXPECT_TRUE(check_black(under("\"a\""), "RGBA"));
}

TEST(LightGroupsOfShapes, AlsoHoldForRaysThatMeetTheLight) {
    // Area lights: what rays find must obey the group as well.
    const std::string head = frame_text(16, 16, 4, at_the_origin()) +
                             node("standard_surface", "gloss", " specular_roughness 0.2") +
                             square_light("a", 2, 1, " intensity 5\n color 1 0 0") +
                             square_light("b", 3, 2, " intensity 5\n color 0 1 0");
    const Picture only_b =
        render(head + floor("plane", 0, 1, "gloss", " use_light_group on\n light_group \"b\""));
    for (std::size_t i = 0; i < only_b.n_pixels(); ++i)
        ASSERT_EQ(only_b.color("RGBA", i).r, 0);
    std::string without_a = head;
    without_a.replace(without_a.find("intensity 5"), 11, "intensity 0");
    EXPECT_TRUE(check_same_mean(only_b, "RGBA", render(without_a + floor("plane", 0, 1, "gloss")),
                                "RGBA"));
}

// Caustics -----------------------------------------------------------------------------------------------------------------

TEST(Caustics, AreSeenByDiffuseRaysOnlyWhereTheShaderSaysSo) {
    const auto with = [](std::string_view caustics) {
        return render(
            frame_text(16, 16, 4, persp_camera({0, 1.5F, 2.5F}, {0, 0.3F, 0}, 45),
                       " GI_diffuse_depth 2\n GI_specular_depth 2") +
                lambert("grey", 0.5F) + floor("plane", 0, 1.5F, "grey") +
                node("standard_surface", "mirror",
                     " base_color 0.9 0.9 0.9\n metalness 1\n specular_roughness 0.2\n caustics " +
                         std::string(caustics)) +
                quad("back", {-1.5F, 0, -1}, {1.5F, 0, -1}, {1.5F, 2, -1}, {-1.5F, 2, -1},
                     "mirror") +
                square_light("key", 2.5F, 0.8F, " intensity 10"),
            in_memory({"diffuse_direct", "specular"},
                      {"caustic C<RD><RS>.*", "seen_in_mirror C<RS><RD>L"}));
    };
    const Picture off = with("off"), on = with("on");
    EXPECT_TRUE(check_black(off, "caustic"));
    EXPECT_TRUE(check_lit(on, "caustic"));
    EXPECT_TRUE(check_lit(off, "seen_in_mirror"));
    EXPECT_TRUE(check_equal(off, "diffuse_direct", on, "diffuse_direct"));
}

// Background -------------------------------------------------------------------------------------------------------------

TEST(Background, FillsTheFrameAndLightsWithOneColour) {
    // A cell is a quarter of the frame: black at the lower left and upper right of every pair.
    const std::string text =
        frame_text(8, 8, 2, from_above(2), " background checks\n GI_diffuse_depth 1") +
        node("checkerboard", "checks",
             " color1 0.25 0.5 1\n color2 1 0.5 0\n u_frequency 1\n v_frequency 1") +
        node("lambert", "white", " Kd 1") + sphere("ball", {0, 0, 0}, 0.3F, "white");
    const Picture picture = render(text, in_memory({"diffuse", "background"}));
    // Cells as seen from the lower left: even, odd; odd, even.
    EXPECT_EQ(picture.color("background", 56), (Color{1, 0.5F, 0}));
    EXPECT_EQ(picture.color("background", 63), (Color{0.25F, 0.5F, 1}));
    EXPECT_EQ(picture.color("background", 0), (Color{0.25F, 0.5F, 1}));
    EXPECT_EQ(picture.color("background", 7), (Color{1, 0.5F, 0}));
    // The ball sees uv 0 0 all around.
    const Color lit = picture.color("diffuse", 27);
    EXPECT_NEAR(lit.r, 1, 1e-4F);
    EXPECT_NEAR(lit.b, 0, 1e-4F);
}

}  // namespace
}  // namespace lightsieve::testing
