// Laws that the AOVs of any picture obey, on scenes that together have every lobe, every kind of light and groups.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "lpe/algebra.h"
#include "lpe/builtins.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// Names of all built-in expressions but the beauty.
std::vector<std::string> all_builtins() {
    std::vector<std::string> out;
    for (const lpe::Builtin& b : lpe::builtins())
        if (b.name != "RGBA") out.emplace_back(b.name);
    return out;
}

const std::vector<std::string> kWholes{"diffuse",      "specular", "coat",  "sheen",
                                       "transmission", "sss",      "volume"};
/// What a group suffix may follow.
const std::vector<std::string> kGrouped{"RGBA", "diffuse",  "specular",   "coat",   "transmission",
                                        "sss",  "emission", "background", "direct", "indirect"};

std::vector<std::string> names(const std::vector<std::string_view>& views) {
    return {views.begin(), views.end()};
}

/// Everything the laws speak of, of one scene, rendered once.
const Picture& picture_of(const std::string& scene) {
    static std::map<std::string, Picture> known;
    if (const auto found = known.find(scene); found != known.end()) return found->second;
    std::vector<std::string> aovs = all_builtins();
    for (const std::string& whole : kGrouped)
        aovs.push_back(whole + "_*");
    return known
        .emplace(scene, render(TestScene(scene_file(scene), in_memory(aovs), {"caustics"})))
        .first->second;
}

class AovLaws : public ::testing::TestWithParam<const char*> {
  protected:
    const Picture& picture() { return picture_of(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Scenes, AovLaws,
                         ::testing::Values("laws_lobes.ass", "laws_room.ass", "laws_media.ass"));

TEST_P(AovLaws, AdditiveSetsAddUpToTheBeauty) {
    for (const auto& set : lpe::additive_sets(lpe::BuiltinTable::Reference))
        EXPECT_TRUE(check_sum(picture(), "RGBA", names(set)));
}

TEST_P(AovLaws, DirectAndIndirectAddUp) {
    for (const std::string& whole : kWholes)
        EXPECT_TRUE(check_sum(picture(), whole, {whole + "_direct", whole + "_indirect"}));
    // `indirect` of the whole is not only that of reflection: emission and background seen directly are neither.
    EXPECT_TRUE(check_sum(picture(), "RGBA", {"direct", "indirect", "emission", "background"}));
}

TEST_P(AovLaws, LightGroupsAddUp) {
    for (const std::string& whole : kGrouped) {
        std::vector<std::string> parts;
        for (const FrameLayer& l : picture().result().layers)
            if (l.info.aov == whole && !l.info.light_group.empty()) parts.push_back(l.info.name);
        ASSERT_GE(parts.size(), 3U) << whole;
        EXPECT_TRUE(check_sum(picture(), whole, parts));
    }
}

TEST_P(AovLaws, SheenIsAPartOfSpecular) {
    std::size_t n_bright = 0;
    for (std::size_t i = 0; i < picture().n_pixels(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float sheen = picture().color("sheen", i)[c],
                        specular = picture().color("specular", i)[c];
            EXPECT_LE(sheen, specular * 1.00001F);
            n_bright += sheen > 0 ? 1 : 0;
        }
    EXPECT_GT(n_bright, 10U);
}

TEST_P(AovLaws, WhatNothingMakesIsExactlyBlack) {
    if (GetParam() == std::string("laws_media.ass")) GTEST_SKIP() << "it has volumes";
    for (const char* dead : {"volume", "volume_direct", "volume_indirect", "volume_albedo"})
        EXPECT_TRUE(check_black(picture(), dead));
}

TEST_P(AovLaws, AlphaIsTheBeautysEverywhere) {
    const TestScene scene(scene_file(GetParam()), in_memory({"diffuse RGBA", "specular_* RGBA"}),
                          {"caustics"});
    const Picture rgba = render(scene);
    for (const FrameLayer& l : rgba.result().layers) {
        ASSERT_EQ(l.info.n_channels, 4U) << l.info.name;
        for (std::size_t i = 0; i < rgba.n_pixels(); ++i)
            ASSERT_EQ(rgba.alpha(l.info.name, i), rgba.alpha("RGBA", i)) << l.info.name;
    }
}

TEST(AovLawsOfScenes, TheScenesLightEveryAov) {
    // Laws about nothing but zeros prove nothing.
    for (const std::string& name : all_builtins()) {
        const bool lit = check_lit(picture_of("laws_lobes.ass"), name) ||
                         check_lit(picture_of("laws_room.ass"), name) ||
                         check_lit(picture_of("laws_media.ass"), name);
        EXPECT_TRUE(lit) << name;
    }
    for (const char* layer : {"RGBA_key", "RGBA_fill", "RGBA_sky", "RGBA_default", "diffuse_key",
                              "specular_sky", "coat_fill", "background_sky", "emission_default"})
        EXPECT_TRUE(check_lit(picture_of("laws_lobes.ass"), layer));
}

TEST(AovLawsOfScenes, Arnold7TableAddsSheen) {
    RenderOptions options = in_memory(all_builtins());
    options.lpe_table = "arnold7";
    const Picture picture = render(TestScene(scene_file("laws_lobes.ass"), options, {"caustics"}));
    for (const auto& set : lpe::additive_sets(lpe::BuiltinTable::Arnold7))
        EXPECT_TRUE(check_sum(picture, "RGBA", names(set)));
    EXPECT_TRUE(check_sum(picture_of("laws_lobes.ass"), "specular", {"specular", "volume"}));
    EXPECT_FALSE(check_sum(picture, "RGBA",
                           {"diffuse", "specular", "coat", "transmission", "sss", "volume",
                            "emission", "background"}))
        << "sheen is missing, the check must notice";
    EXPECT_TRUE(check_lit(picture, "sheen"));
}

TEST(AovLawsOfScenes, ExpressionsThatPartitionAnythingAddUp) {
    // Custom partitions, proved by the engine first, then seen in pixels.
    const std::vector<std::string> lpes{"first_d C<RD>.*",
                                        "first_s C<RS>.*",
                                        "first_t C<T.>.*",
                                        "rest C[LOB]",
                                        "seen_by_mirror C[S]+<RD>.*",
                                        "whole C.*",
                                        "last_l C.*L",
                                        "last_o C.*O",
                                        "last_b C.*B",
                                        "short C.?[LOB]",
                                        "long C..+[LOB]",
                                        "coat_anywhere C.*'coat'.*",
                                        "coat_nowhere C[^'coat']*"};
    const Picture picture =
        render(TestScene(scene_file("laws_lobes.ass"), in_memory({}, lpes), {"caustics"}));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"first_d", "first_s", "first_t", "rest"}));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"last_l", "last_o", "last_b"}));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"short", "long"}));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"coat_anywhere", "coat_nowhere"}));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "whole"));
    for (const char* lit : {"seen_by_mirror", "coat_anywhere", "last_o", "long"})
        EXPECT_TRUE(check_lit(picture, lit));
}

// Disjoint AOVs where one must be exactly dark ---------------------------------------------------------------------------

/// A plane of one shader under a quad light and a dome, seen by a camera above; no indirect light.
std::string plane_scene(std::string_view shader, std::string_view options = "") {
    return frame_text(12, 12, 2, persp_camera({0, 3, 3}, {0, 0, 0}, 40), options) +
           std::string(shader) + floor("plane", 0, 2, "surface") +
           node("quad_light", "key",
                " vertices 4 1 VECTOR -1 3 -1  1 3 -1  1 3 1  -1 3 1\n intensity 20\n "
                "transmission 1\n aov \"key\"") +
           node("skydome_light", "sky", " intensity 0.3\n aov \"sky\"");
}

struct OneLobe {
    const char* shader;
    const char* aov;
};

class SingleLobe : public ::testing::TestWithParam<OneLobe> {};

INSTANTIATE_TEST_SUITE_P(
    Lobes, SingleLobe,
    ::testing::Values(
        OneLobe{"specular 0", "diffuse"}, OneLobe{"base 0\n specular_roughness 0.4", "specular"},
        OneLobe{"metalness 1\n specular_roughness 0.3\n base_color 0.9 0.6 0.3", "specular"},
        OneLobe{"base 0\n specular 0\n coat 1\n coat_roughness 0.3", "coat"},
        OneLobe{"base 0\n specular 0\n sheen 1", "sheen"},
        OneLobe{"base 0\n specular 0\n thin_walled on\n transmission 1\n specular_roughness 0.5",
                "transmission"},
        OneLobe{"base 0\n specular 0\n thin_walled on\n subsurface 1", "sss"}));

TEST_P(SingleLobe, GivesAllItsLightToItsAovAndNoneToOthers) {
    const std::string shader = node("standard_surface", "surface", GetParam().shader);
    const Picture picture = render(plane_scene(shader), in_memory(all_builtins()));
    const std::string own = GetParam().aov;
    EXPECT_TRUE(check_lit(picture, own));
    EXPECT_TRUE(check_sum(picture, "RGBA", {own, "background"}));
    EXPECT_TRUE(check_equal(picture, own, picture, own + "_direct")) << "no bounce has light";
    EXPECT_TRUE(check_lit(picture, own + "_albedo"));
    for (const std::string& other : kWholes) {
        if (other == own || (own == "sheen" && other == "specular")) continue;
        EXPECT_TRUE(check_black(picture, other));
        EXPECT_TRUE(check_black(picture, other + "_albedo"));
    }
    EXPECT_TRUE(check_black(picture, "indirect"));
    EXPECT_TRUE(check_black(picture, "emission"));
}

TEST(AovLawsOfScenes, ALightIsDirectByWhicheverStrategyItIsFound) {
    // A convex object and no depth: all light is direct, also what rays found that left by a lobe.
    const std::string shader =
        node("standard_surface", "surface", " specular_roughness 0.05\n base_color 0.5 0.5 0.5");
    const std::string emitter =
        node("flat", "glow", " color 0 0 0") + sphere("dark", {0, 8, 0}, 0.1F, "glow");
    const Picture picture = render(plane_scene(shader) + emitter, in_memory(all_builtins()));
    EXPECT_TRUE(check_black(picture, "indirect"));
    EXPECT_TRUE(check_equal(picture, "specular", picture, "specular_direct"));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"direct", "background"}));
}

// Names, types, tables ---------------------------------------------------------------------------------------------------

const char* const kPlaneShader =
    "standard_surface\n{\n name surface\n specular_roughness 0.3\n coat 0.5\n}\n";

TEST(AovNames, CustomExpressionReplacesABuiltin) {
    const std::string text = plane_scene(
        kPlaneShader, " light_path_expressions 2 1 STRING \"diffuse C<RS>.*\" \"mine C<RD>.*\"");
    const Picture picture = render(text, in_memory({"diffuse", "mine"}));
    const Picture plain =
        render(plane_scene(kPlaneShader), in_memory({"diffuse", "specular", "coat"}));
    EXPECT_TRUE(check_identical(picture, "mine", plain, "diffuse"));
    EXPECT_TRUE(check_sum(plain, "specular", {"specular"}));
    const std::vector<std::string> both{"specular", "coat"};
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(picture.color("diffuse", i)[c],
                        plain.color("specular", i)[c] + plain.color("coat", i)[c], 1e-5F);
    EXPECT_TRUE(check_lit(picture, "diffuse"));
}

TEST(AovNames, BeautyCanBeReplacedToo) {
    const std::string text = plane_scene(kPlaneShader, " light_path_expressions \"RGBA C<RD>.*\"");
    const Picture picture = render(text, in_memory({"diffuse"}));
    EXPECT_TRUE(check_equal(picture, "RGBA", picture, "diffuse"));
}

TEST(AovNames, GroupsByNameWildcardAndDefault) {
    const std::string lamp = node("point_light", "lamp", " position 1 1 1\n intensity 2") +
                             node("flat", "glow", " color 0.5 1 0.2") +
                             sphere("lit", {-1, 0.5F, 0}, 0.3F, "glow");
    const Picture picture =
        render(plane_scene(kPlaneShader) + lamp,
               in_memory({"diffuse", "diffuse_key", "diffuse_default", "emission",
                          "emission_default", "RGBA_*"},
                         {"by_label C<RD><L.'key'>", "direct_key C<RD>'key'"}));
    EXPECT_TRUE(check_equal(picture, "diffuse_key", picture, "by_label"));
    EXPECT_TRUE(check_equal(picture, "diffuse_key", picture, "direct_key"));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"RGBA_key", "RGBA_sky", "RGBA_default"}));
    // Light of no light counts to `default`, so that groups add up.
    EXPECT_TRUE(check_equal(picture, "emission", picture, "emission_default"));
    EXPECT_TRUE(check_lit(picture, "emission_default"));
    EXPECT_TRUE(check_lit(picture, "diffuse_default"));
    EXPECT_FALSE(picture.has("RGBA_*"));
}

TEST(AovNames, FloatIsLuminance) {
    const Picture picture =
        render(plane_scene(kPlaneShader), in_memory({"diffuse", "specular FLOAT"}, {}));
    const Picture colors = render(plane_scene(kPlaneShader), in_memory({"specular"}));
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        EXPECT_FLOAT_EQ(picture.color("specular", i).r, luminance(colors.color("specular", i)));
    EXPECT_EQ(picture.layer("specular").info.n_channels, 1U);
}

TEST(AovNames, EmptyOrForeignGroupIsBlackWithAWarning) {
    const TestScene scene(plane_scene(kPlaneShader), in_memory({"diffuse_kye"}), {"kye"});
    EXPECT_TRUE(check_black(render(scene), "diffuse_kye"));
    EXPECT_EQ(scene.diagnostics().n_warnings(), 1U);
}

// Albedo -----------------------------------------------------------------------------------------------------------------

TEST(Albedo, DiffuseOverAlbedoIsTheLightingWithoutTexture) {
    // Under an even dome of radiance 1 an open plane receives the same everywhere: the texture must vanish.
    const std::string text =
        frame_text(24, 16, 3, persp_camera({0, 2, 3}, {0, 0, 0}, 50)) +
        node("checkerboard", "checks",
             " color1 0.9 0.5 0.2\n color2 0.1 0.2 0.7\n u_frequency 5\n v_frequency 5") +
        node("lambert", "surface", " Kd 1\n Kd_color checks") + floor("plane", 0, 50, "surface") +
        node("skydome_light", "sky", " color 1 0.5 2");
    const Picture picture =
        render(text, in_memory({"diffuse", "diffuse_albedo", "albedo", "denoise_albedo"}));
    const Color light(1, 0.5F, 2);
    // Cells of both colours alike: 2 times 3 comparisons, a false alarm in 25000 seeds.
    std::array<std::array<std::vector<double>, 3>, 2> ratios;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
        if (picture.alpha("RGBA", i) < 1) continue;
        const Color albedo = picture.color("diffuse_albedo", i),
                    diffuse = picture.color("diffuse", i);
        for (std::size_t c = 0; c < 3; ++c)
            ratios[albedo.r > 0.5F ? 1 : 0][c].push_back(
                static_cast<double>(diffuse[static_cast<int>(c)] / albedo[static_cast<int>(c)]));
    }
    for (std::size_t cell : {0U, 1U})
        for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_GT(ratios[cell][c].size(), 60U) << "the texture must show in the albedo";
            EXPECT_TRUE(check_mean_of(ratios[cell][c],
                                      static_cast<double>(light[static_cast<int>(c)]),
                                      cell == 0 ? "dark cells" : "bright cells"));
        }
    EXPECT_TRUE(check_equal(picture, "diffuse_albedo", picture, "albedo"));
    EXPECT_TRUE(check_equal(picture, "diffuse_albedo", picture, "denoise_albedo"));
}

TEST(Albedo, ProbesSeeThroughGlassAndNeverEnterLight) {
    const std::string text =
        frame_text(8, 8, 2, ortho_camera({0, 4, 0}, {0, 0, 0}, 1, {0, 0, 1})) +
        node("lambert", "ground", " Kd 0.5\n Kd_color 1 0.8 0.6") +
        floor("plane", 0, 5, "ground") +
        node("standard_surface", "glass",
             " base 0\n specular_IOR 1\n thin_walled on\n transmission 1\n"
             " transmission_color 0.5 0.5 1\n specular_roughness 0") +
        floor("pane", 1, 5, "glass");
    // Not one light: radiance is exactly 0 while probes are not.
    const Picture picture = render(
        text, in_memory({"direct", "indirect", "transmission_albedo"}, {"through C<TS>+<RD>A"}));
    EXPECT_TRUE(check_black(picture, "RGBA"));
    EXPECT_TRUE(check_constant(picture, "transmission_albedo", {0.5F, 0.5F, 1}, 1e-5));
    EXPECT_TRUE(check_constant(picture, "through", {0.25F, 0.2F, 0.3F}, 1e-5));
}

TEST(Albedo, ProbesAreNotClamped) {
    const std::string clamped = " AA_sample_clamp 0.05\n indirect_sample_clamp 0.05";
    const Picture with = render(plane_scene(kPlaneShader, clamped),
                                in_memory({"albedo", "diffuse_albedo", "diffuse"}));
    const Picture without =
        render(plane_scene(kPlaneShader), in_memory({"albedo", "diffuse_albedo", "diffuse"}));
    EXPECT_TRUE(check_identical(with, "albedo", without, "albedo"));
    EXPECT_TRUE(check_identical(with, "diffuse_albedo", without, "diffuse_albedo"));
    EXPECT_FALSE(check_identical(with, "diffuse", without, "diffuse"))
        << "the clamp must have acted";
}

TEST(Albedo, ExposureBrightensLightAndNoAlbedo) {
    const auto with = [](std::string_view camera) {
        std::string text = plane_scene(kPlaneShader, " low_light_threshold 0");
        text.insert(text.find(" position "), camera);
        return render(text, in_memory({"diffuse", "diffuse_albedo", "albedo"}));
    };
    const Picture plain = with(""), exposed = with(" exposure 3\n");
    EXPECT_TRUE(check_identical(exposed, "albedo", plain, "albedo"));
    EXPECT_TRUE(check_identical(exposed, "diffuse_albedo", plain, "diffuse_albedo"));
    ASSERT_TRUE(check_lit(plain, "diffuse"));
    for (std::size_t i = 0; i < plain.n_pixels(); ++i)
        EXPECT_FLOAT_EQ(exposed.color("diffuse", i).g, plain.color("diffuse", i).g * 8);
}

// Clamping ---------------------------------------------------------------------------------------------------------------

TEST(Clamping, KeepsSums) {
    RenderOptions options = in_memory(all_builtins());
    std::string text = scene_file("laws_lobes.ass");
    text.replace(text.find("indirect_sample_clamp 5"), 23,
                 "indirect_sample_clamp 0.2\n AA_sample_clamp 0.5");
    const Picture picture = render(TestScene(text, options, {"caustics"}));
    for (const auto& set : lpe::additive_sets(lpe::BuiltinTable::Reference))
        EXPECT_TRUE(check_sum(picture, "RGBA", names(set)));
    EXPECT_FALSE(check_identical(picture, "RGBA", picture_of("laws_lobes.ass"), "RGBA"));
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        EXPECT_LE(max_component(picture.color("RGBA", i)), 0.5F * 1.0001F);
}

// Determinism ------------------------------------------------------------------------------------------------------------

TEST(Determinism, BeautyIsTheSameBitsWhateverIsAskedFor) {
    for (const char* scene : {"laws_lobes.ass", "laws_room.ass"}) {
        const std::string text = scene_file(scene);
        const Picture alone = render(TestScene(text, in_memory(), {"caustics"}));
        EXPECT_TRUE(check_lit(alone, "RGBA"));
        EXPECT_TRUE(check_identical(alone, "RGBA", picture_of(scene), "RGBA"));
        const Picture few = render(TestScene(
            text, in_memory({"diffuse_direct", "N VECTOR", "Z FLOAT", "albedo"}), {"caustics"}));
        EXPECT_TRUE(check_identical(alone, "RGBA", few, "RGBA"));
        const Picture odd = render(
            TestScene(text, in_memory({}, {"d C.{3}D.*", "e C(S|D)*'coat'L"}), {"caustics"}));
        EXPECT_TRUE(check_identical(alone, "RGBA", odd, "RGBA"));
    }
}

TEST(Determinism, AovsDoNotDependOnTheirCompany) {
    // Not required bit for bit (fewer terms merge in another order), but up to rounding.
    const Picture few =
        render(TestScene(scene_file("laws_lobes.ass"),
                         in_memory({"coat_indirect", "diffuse_indirect"}), {"caustics"}));
    EXPECT_TRUE(check_equal(few, "coat_indirect", picture_of("laws_lobes.ass"), "coat_indirect"));
    EXPECT_TRUE(
        check_equal(few, "diffuse_indirect", picture_of("laws_lobes.ass"), "diffuse_indirect"));
}

TEST(Determinism, ThreadsAndBucketsDoNotMatter) {
    const std::string text = scene_file("laws_lobes.ass");
    const std::vector<std::string> aovs{"diffuse", "specular_*", "albedo", "Z FLOAT"};
    RenderOptions options = in_memory(aovs);
    const Picture one = render(TestScene(text, options, {"caustics"}));
    options.threads = 2;
    for (const char* size : {"8", "13", "64"}) {
        std::string cut = text;
        cut.replace(cut.find("AA_samples 2"), 12,
                    std::string("AA_samples 2\n bucket_size ") + size);
        const Picture two = render(TestScene(cut, options, {"caustics"}));
        for (const FrameLayer& l : one.result().layers)
            EXPECT_TRUE(check_identical(one, l.info.name, two, l.info.name))
                << l.info.name << ", buckets of " << size;
    }
}

TEST(Determinism, SeedChangesTheNoiseOnly) {
    RenderOptions options = in_memory();
    const std::string text = scene_file("laws_lobes.ass");
    const Picture one = render(TestScene(text, options, {"caustics"}));
    options.seed = 7;
    const Picture other = render(TestScene(text, options, {"caustics"}));
    EXPECT_FALSE(check_identical(one, "RGBA", other, "RGBA"));
    EXPECT_TRUE(check_same_mean(one, "RGBA", other, "RGBA"));
}

}  // namespace
}  // namespace lightsieve::testing
