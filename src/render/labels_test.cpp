// Labels that a scene gives: to closures, through a wrapper, to shapes. And shaders that are made of shaders.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A floor under a lamp and a sky, seen from the side, with `shaders`; the floor's shader is "top".
std::string floor_scene(const std::string& shaders, std::string_view more_of_floor = "") {
    return frame_text(16, 12, 3, persp_camera({0, 1, 3}, {0, 0, 0}, 40),
                      " GI_diffuse_depth 2\n GI_specular_depth 2\n GI_transmission_depth 4\n "
                      "GI_total_depth 4") +
           shaders + floor("ground", 0, 1.5F, "top", more_of_floor) +
           square_light("key", 2, 0.4F, " intensity 20\n aov \"key\"") +
           node("skydome_light", "sky", " color 0.3 0.4 0.5\n camera 0");
}

std::string varnished_wood(std::string_view more_of_layer = "") {
    return node("dielectric_bsdf", "varnish",
                " roughness 0.04 0.04\n ior 1.5\n label \"varnish\"") +
           node("oren_nayar_diffuse_bsdf", "wood", " color 0.6 0.4 0.2\n label \"wood\"") +
           node("layer", "top", " top \"varnish\"\n base \"wood\"" + std::string(more_of_layer));
}

TEST(ClosureLabels, NameTheLightOfEachClosure) {
    const Picture p = render(
        floor_scene(varnished_wood()),
        in_memory({"diffuse", "specular"}, {"by_varnish C'varnish'.*", "by_wood C<RD'wood'>.*",
                                            "by_none C[^'varnish''wood'OLB].*"}));
    EXPECT_TRUE(check_lit(p, "by_varnish"));
    EXPECT_TRUE(check_identical(p, "by_varnish", p, "specular"));
    EXPECT_TRUE(check_identical(p, "by_wood", p, "diffuse"));
    EXPECT_TRUE(check_black(p, "by_none"));
    EXPECT_TRUE(check_sum(p, "RGBA", {"by_varnish", "by_wood"}));
}

TEST(Layer, IsWhatStandardSurfaceIsMadeOf) {
    // The base gets 1 - E of the top: the same layering, written out.
    const Picture layers = render(floor_scene(varnished_wood()));
    const Picture whole = render(
        floor_scene(node("standard_surface", "top",
                         " base_color 0.6 0.4 0.2\n specular_roughness 0.2\n caustics on")));
    EXPECT_TRUE(check_equal(layers, "RGBA", whole, "RGBA"));
}

TEST(Mix, IsHalfOfEach) {
    const auto with = [](std::string_view mix) {
        return render(
            floor_scene(node("oren_nayar_diffuse_bsdf", "a", " color 0.8 0 0.1") +
                        node("oren_nayar_diffuse_bsdf", "b", " color 0 0.6 0.3 \n roughness 0") +
                        node("mix", "top", " fg \"a\"\n bg \"b\"\n mix " + std::string(mix))));
    };
    const Picture all_a = with("1"), all_b = with("0"), half = with("0.5");
    // A single bounce on an open floor: linear in the albedo.
    for (std::size_t i = 0; i < half.n_pixels(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(half.color("RGBA", i)[c],
                        (all_a.color("RGBA", i)[c] + all_b.color("RGBA", i)[c]) / 2,
                        1e-5 * (1 + half.color("RGBA", i)[c]));
}

TEST(Surface, EmitsAndHasHoles) {
    const Picture p =
        render(floor_scene(node("uniform_edf", "glow", " color 3 2 1\n label \"fire\"") +
                           node("oren_nayar_diffuse_bsdf", "ash", " color 0.1 0.1 0.1") +
                           node("surface", "top", " bsdf \"ash\"\n edf \"glow\"\n opacity 0.25")),
               in_memory({"emission", "diffuse"},
                         {"emission_fire C<O.'fire'>", "other_fire C<O.'ice'>"}));
    EXPECT_TRUE(check_lit(p, "emission_fire"));
    EXPECT_TRUE(check_identical(p, "emission_fire", p, "emission"));
    EXPECT_TRUE(check_black(p, "other_fire"));
    EXPECT_TRUE(check_sum(p, "RGBA", {"emission", "diffuse"}));
    // The middle of the picture is floor: a quarter of it is there.
    const std::size_t middle = 6 * 16 + 8;
    EXPECT_NEAR(p.color("emission", middle).r, 0.75, 1e-5);
    EXPECT_NEAR(p.alpha("RGBA", middle), 0.25, 1e-5);
}

TEST(AddAndMultiply, ComputeWithColoursToo) {
    // Arnold's nodes of these names: no closures are linked, so they drive parameters.
    const Picture p =
        render(frame_text(8, 8, 2, from_above(1)) +
               node("add", "sum", " input1 0.1 0.2 0.3\n input2 0.1 0.1 0.1") +
               node("multiply", "product", " input1 \"sum\"\n input2 2 2 0.5") +
               node("flat", "shown", " color \"product\"") + floor("plane", 0, 1, "shown"));
    EXPECT_TRUE(check_constant(p, "RGBA", {0.4F, 0.6F, 0.2F}, 1e-5));
}

TEST(LabelClosure, NamesEveryLobeOfAnyShader) {
    const std::string coated = node("standard_surface", "paint",
                                    " base_color 0.5 0.1 0.1\n coat 1\n sheen 0.5\n caustics on") +
                               node("label_closure", "top", " closure \"paint\"\n label \"car\"");
    const Picture p = render(
        floor_scene(coated),
        in_memory({"coat", "specular", "diffuse"}, {"car C'car'.*", "car_specular C<RS'car'>.*"}));
    EXPECT_TRUE(check_lit(p, "car_specular"));
    EXPECT_TRUE(check_equal(p, "car", p, "RGBA"));
    // The wrapper's label takes the place of the lobes' own.
    EXPECT_TRUE(check_black(p, "coat"));
    EXPECT_TRUE(check_identical(p, "car_specular", p, "specular"));
}

TEST(LabelClosure, OneShaderHasALabelForEachUse) {
    const std::string shaders =
        node("oren_nayar_diffuse_bsdf", "clay", " color 0.5 0.5 0.5") +
        node("label_closure", "left", " closure \"clay\"\n label \"left\"") +
        node("label_closure", "inner", " closure \"clay\"\n label \"inner\"") +
        node("label_closure", "right", " closure \"inner\"\n label \"right\"");
    const Picture p = render(
        frame_text(16, 8, 2, from_above(4)) + shaders +
            floor("a", 0, 0.5F, "left", " matrix 1 0 0 0 0 1 0 0 0 0 1 0 -1 0 0 1") +
            floor("b", 0, 0.5F, "right", " matrix 1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1") +
            node("skydome_light", "sky", " camera 0"),
        in_memory({},
                  {"l C'left'.*", "r C'right'.*", "i C'inner'.*", "own C<RD[^'left''right']>.*"}));
    EXPECT_TRUE(check_lit(p, "l"));
    EXPECT_TRUE(check_lit(p, "r"));
    EXPECT_TRUE(check_black(p, "i"));  // the outermost label holds
    EXPECT_TRUE(check_black(p, "own"));
    EXPECT_TRUE(check_sum(p, "RGBA", {"l", "r"}));
    for (std::size_t i = 0; i < p.n_pixels(); ++i)
        EXPECT_EQ(p.color("l", i).r * p.color("r", i).r, 0) << i;
}

TEST(ObjectLabels, JoinScatteringAndEmission) {
    const std::string shaders =
        node("standard_surface", "top",
             " base_color 0.5 0.4 0.3\n coat 0.5\n emission 0.1\n caustics on");
    const std::string label = " declare lpe_label constant STRING\n lpe_label \"hero\"";
    const std::string other = sphere("ball", {0.5F, 0.4F, 0}, 0.3F, "top");
    const std::vector<std::string> lpes{"hero C'hero'.*",           "hero_diffuse C<RD'hero'>.*",
                                        "hero_coat C<RS'coat'>.*",  "hero_glow C<O.'hero'>",
                                        "hero_light C.*<L.'hero'>", "rest C[^'hero'].*"};
    const Picture p = render(floor_scene(shaders, label) + other,
                             in_memory({"coat", "emission", "diffuse"}, lpes));
    for (const char* lit : {"hero_diffuse", "hero_coat", "hero_glow", "rest"})
        EXPECT_TRUE(check_lit(p, lit));
    EXPECT_TRUE(check_black(p, "hero_light"));
    EXPECT_TRUE(check_sum(p, "RGBA", {"hero", "rest"}));
    // Built-in AOVs do not mind, and the beauty is the same bits.
    const Picture plain = render(floor_scene(shaders) + other, in_memory({"coat", "emission"}));
    EXPECT_TRUE(check_identical(p, "RGBA", plain, "RGBA"));
    EXPECT_TRUE(check_identical(p, "coat", plain, "coat"));
    EXPECT_TRUE(check_identical(p, "emission", plain, "emission"));
}

TEST(ClosureLabels, CannotHaveQuotes) {
    const std::string text =
        floor_scene(node("oren_nayar_diffuse_bsdf", "top", " label \"o'clock\""));
    EXPECT_THROW(render(text), std::exception);
}

TEST(ShadersOfShaders, ArePathsInTheLog) {
    // The oracle: every path as text, matched by the naive matcher, adds up to each AOV.
    const std::string text =
        floor_scene(varnished_wood(), " declare lpe_label constant STRING\n lpe_label \"hero\"") +
        sphere("ball", {0.5F, 0.4F, 0}, 0.3F, "top");
    const TestScene scene(text,
                          in_memory({"diffuse", "specular_indirect"},
                                    {"a C<RD'wood'><.S'varnish'>.*", "b C'hero'[^'hero'].*"}));
    EXPECT_TRUE(check_oracle(scene.scene(), render(scene), log_paths(scene.scene())));
}

TEST(TwoSided, ShadesEachSideByItsOwn) {
    const std::string shaders = lambert("white", 0.8F) + lambert("grey", 0.2F) +
                                node("two_sided", "top", " front \"white\"\n back \"grey\"");
    const auto seen = [&](float y) {
        return render(frame_text(8, 8, 2, ortho_camera({0, y, 0}, {0, 0, 0}, 0.5F, {0, 0, 1})) +
                      shaders + floor("plane", 0, 1, "top") +
                      node("skydome_light", "sky", " camera 0"));
    };
    EXPECT_TRUE(check_mean(seen(2), "RGBA", Color::grey(0.8F), 1e-3));
    EXPECT_TRUE(check_mean(seen(-2), "RGBA", Color::grey(0.2F), 1e-3));
}

TEST(RaySwitch, ShowsEachRayTypeItsOwn) {
    // The wall is black to the camera and white to rays that the floor scatters; in the mirror it glows.
    const std::string shaders =
        lambert("black", 0) + node("flat", "glow", " color 2 1 0.5") +
        node("ray_switch_shader", "switch",
             " camera \"black\"\n diffuse_reflection \"glow\"\n specular_reflection \"black\"") +
        node("standard_surface", "ground", " base_color 0.5 0.5 0.5\n specular_roughness 0.3");
    const auto scene = [&](std::string_view wall) {
        return frame_text(16, 12, 5, persp_camera({0, 1, 3}, {0, 0.4F, 0}, 40),
                          " GI_diffuse_depth 1\n GI_specular_depth 1") +
               shaders + floor("plane", 0, 1, "ground") +
               quad("wall", {-1, 0, -1}, {1, 0, -1}, {1, 1, -1}, {-1, 1, -1}, wall);
    };
    const std::vector<std::string> aovs{"diffuse_indirect", "specular_indirect", "emission"};
    const Picture p = render(scene("switch"), in_memory(aovs)),
                  glowing = render(scene("glow"), in_memory(aovs));
    EXPECT_TRUE(check_black(p, "emission"));
    EXPECT_TRUE(check_black(p, "specular_indirect"));
    EXPECT_TRUE(check_lit(p, "diffuse_indirect"));
    EXPECT_TRUE(check_same_mean(p, "diffuse_indirect", glowing, "diffuse_indirect"));
}

TEST(MixShader, MixesTransparencyToo) {
    const std::string shaders =
        lambert("solid", 0.5F) + node("lambert", "hole", " opacity 0 0 0") +
        node("mix_shader", "top", " shader1 \"solid\"\n shader2 \"hole\"\n mix 0.25");
    const Picture p =
        render(frame_text(8, 8, 3, from_above(0.5F)) + shaders + floor("plane", 0, 1, "top") +
               node("skydome_light", "sky", " camera 0"));
    EXPECT_NEAR(p.alpha("RGBA", 20), 0.75, 1e-5);
    EXPECT_TRUE(check_mean(p, "RGBA", Color::grey(0.375F), 1e-3));
}

}  // namespace
}  // namespace lightsieve::testing
