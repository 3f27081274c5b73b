// Light below surfaces: energy, colour, reach, and the AOVs that it arrives in. And bodies that absorb.
#include <gtest/gtest.h>

#include "core/sampling.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

std::string skin(std::string_view more) {
    return node("standard_surface", "skin",
                " base 0\n specular 0\n subsurface 1\n" + std::string(more));
}

std::string sky() { return node("skydome_light", "sky", " camera 0"); }

/// A floor so large that no walk finds its end, straight from above, under a white sky.
Picture half_space(std::string_view more, int aa = 6) {
    return render(frame_text(16, 16, aa, from_above(1)) + skin(more) +
                      floor("plane", 0, 100, "skin") + sky(),
                  in_memory({"sss", "sss_direct", "diffuse", "sss_albedo"}));
}

TEST(Subsurface, AHalfSpaceHasItsColour) {
    // Under an even sky the floor is as bright as its reflectance, whatever wanders below. 2 %: the fit of the inversion.
    const Picture p =
        half_space(" subsurface_color 0.8 0.5 0.2\n subsurface_radius 0.02 0.02 0.02");
    EXPECT_TRUE(check_mean(p, "RGBA", {0.8F, 0.5F, 0.2F}, 0.02));
    EXPECT_TRUE(check_constant(p, "sss_albedo", {0.8F, 0.5F, 0.2F}, 1e-4));
}

TEST(Subsurface, AnisotropyAndRadiusDoNotChangeTheColour) {
    const Color truth{0.7F, 0.7F, 0.7F};
    for (const char* more :
         {" subsurface_anisotropy 0.7", " subsurface_anisotropy -0.4", " subsurface_scale 0.1"}) {
        SCOPED_TRACE(more);
        EXPECT_TRUE(check_mean(half_space(" subsurface_color 0.7 0.7 0.7\n subsurface_radius 0.03 "
                                          "0.01 0.02\n" +
                                          std::string(more)),
                               "RGBA", truth, 0.03));
    }
}

TEST(Subsurface, AWhiteBallInAFurnaceIsInvisible) {
    // Nothing is absorbed, so the ball is as bright as what surrounds it, thin places and thick ones alike.
    const std::string text = frame_text(16, 16, 6, ortho_camera({0, 0, 4}, {0, 0, 0}, 1.2F)) +
                             skin(" subsurface_color 1 1 1\n subsurface_radius 0.5 0.2 0.05") +
                             sphere("ball", {0, 0, 0}, 1, "skin") + sky();
    EXPECT_TRUE(check_mean(render(text), "RGBA", kWhite, 0.01));
}

TEST(Subsurface, IsOneEventAndItsLightIsDirect) {
    const Picture p =
        half_space(" subsurface_color 0.6 0.6 0.6\n subsurface_radius 0.1 0.1 0.1", 2);
    // A single flat floor: all light comes straight from the sky after one event, TD.
    EXPECT_TRUE(check_lit(p, "sss_direct"));
    EXPECT_TRUE(check_equal(p, "sss", p, "RGBA"));
    EXPECT_TRUE(check_identical(p, "sss", p, "sss_direct"));
    EXPECT_TRUE(check_black(p, "diffuse"));
}

TEST(Subsurface, LongerPathsReachFurtherIntoShadow) {
    // Light falls on one half of a slab only; behind the edge red, which wanders furthest, is left over.
    const std::string text =
        frame_text(32, 4, 12, ortho_camera({0, 2, 0}, {0, 0, 0}, 2, {0, 0, -1}),
                   " GI_diffuse_depth 0") +
        skin(" subsurface_color 0.8 0.8 0.8\n subsurface_radius 0.3 0.1 0.03") +
        floor("slab", 0, 50, "skin") + lambert("black", 0) +
        quad("screen", {0, 3, -50}, {0, 3, 50}, {50, 3, 50}, {50, 3, -50}, "black") +
        node("distant_light", "sun", " direction 0 -1 0\n intensity 3");
    const Picture p = render(text);
    const auto column = [&](std::size_t x) {
        Color sum;
        for (std::size_t y = 0; y < 4; ++y)
            sum += p.color("RGBA", y * 32 + x);
        return sum;
    };
    // 0.1 behind the edge and 0.5 behind it: each channel fades, the longer its way the slower.
    const Color near = column(17), far = column(24);
    EXPECT_GT(near.r, near.g);
    EXPECT_GT(near.g, 2 * near.b);
    EXPECT_GT(far.r, 4 * far.g);
    EXPECT_LT(far.b, 1e-3F * column(4).b);
    EXPECT_LT(far.g / near.g, far.r / near.r);
}

TEST(Subsurface, OfAStrandIsDiffuse) {
    // A wide ribbon that fills the picture, under a white sky: as bright as its reflectance.
    const Picture p = render(
        frame_text(8, 8, 8, ortho_camera({0, 0, 3}, {0, 0, 0}, 0.2F)) +
        skin(" subsurface_color 0.8 0.5 0.2") +
        node("curves", "strand",
             " shader \"skin\"\n mode \"ribbon\"\n basis \"linear\"\n num_points 2\n points 2 1 "
             "VECTOR 0 -2 0 0 2 0\n radius 1") +
        sky());
    EXPECT_TRUE(check_mean(p, "RGBA", {0.8F, 0.5F, 0.2F}, 0.01));
}

TEST(Subsurface, TakesTheLightsSssFactor) {
    const auto lit = [](std::string_view factor) {
        return render(frame_text(8, 8, 4, from_above(1)) +
                      skin(" subsurface_color 0.5 0.5 0.5\n subsurface_radius 0.1 0.1 0.1") +
                      floor("plane", 0, 50, "skin") +
                      node("skydome_light", "sky", " camera 0\n " + std::string(factor)));
    };
    const Picture whole = lit(""), half = lit("sss 0.5"), diffuse = lit("diffuse 0");
    EXPECT_TRUE(check_equal(whole, "RGBA", diffuse, "RGBA"));
    for (std::size_t i = 0; i < whole.n_pixels(); ++i)
        EXPECT_NEAR(half.color("RGBA", i).g, 0.5 * whole.color("RGBA", i).g, 1e-5);
}

std::string skin_room() {
    return frame_text(12, 8, 3, persp_camera({0, 1, 3}, {0, 0.3F, 0}, 45),
                      " GI_diffuse_depth 2\n GI_specular_depth 2") +
           node("standard_surface", "skin",
                " base_color 0.5 0.4 0.3\n subsurface 0.6\n subsurface_color 0.9 0.5 0.3\n "
                "subsurface_radius 0.3 0.1 0.05\n coat 0.4\n caustics on") +
           lambert("wall", 0.7F) + sphere("ball", {0, 0.4F, 0}, 0.4F, "skin") +
           floor("ground", 0, 2, "wall") +
           square_light("key", 2, 0.4F, " intensity 20\n aov \"key\"") +
           node("skydome_light", "sky", " color 0.2 0.3 0.4\n camera 0");
}

TEST(Subsurface, ObeysTheLawsOfAovs) {
    const std::vector<std::string> parts{"diffuse_direct",
                                         "diffuse_indirect",
                                         "specular_direct",
                                         "specular_indirect",
                                         "coat",
                                         "transmission",
                                         "sss",
                                         "volume",
                                         "emission",
                                         "background"};
    std::vector<std::string> asked = parts;
    for (const char* more : {"sss_direct", "sss_indirect", "sss_key", "sss_default"})
        asked.emplace_back(more);
    const Picture p = render(skin_room(), in_memory(asked));
    for (const char* lit : {"sss_direct", "sss_indirect", "sss_key", "sss_default"})
        EXPECT_TRUE(check_lit(p, lit));
    EXPECT_TRUE(check_sum(p, "RGBA", parts));
    EXPECT_TRUE(check_sum(p, "sss", {"sss_direct", "sss_indirect"}));
    EXPECT_TRUE(check_sum(p, "sss", {"sss_key", "sss_default"}));
    EXPECT_TRUE(check_identical(p, "RGBA", render(skin_room()), "RGBA"));
}

TEST(Subsurface, IsInThePathLog) {
    const TestScene scene(skin_room(),
                          in_memory({"sss_direct", "sss_indirect", "diffuse_indirect"}));
    EXPECT_TRUE(check_oracle(scene.scene(), render(scene), log_paths(scene.scene())));
}

TEST(Subsurface, ClosuresCarryTheirLabel) {
    const Picture p =
        render(frame_text(8, 8, 2, from_above(1)) +
                   node("subsurface_bsdf", "flesh",
                        " color 0.8 0.5 0.4\n radius 0.05 0.05 0.05\n label \"skin\"") +
                   floor("plane", 0, 50, "flesh") + sky(),
               in_memory({"sss"}, {"sss_skin C<TD'skin'>.*"}));
    EXPECT_TRUE(check_lit(p, "sss_skin"));
    EXPECT_TRUE(check_identical(p, "sss_skin", p, "sss"));
    EXPECT_TRUE(check_equal(p, "sss_skin", p, "RGBA"));
}

TEST(Absorption, FollowsBeerAndLambert) {
    // A slab of glass of index 1 seen through its thickness: transmission_color at transmission_depth, squared at twice that.
    const auto seen = [](float thickness) {
        const float h = thickness / 2;
        return render(
            frame_text(4, 4, 2, ortho_camera({0, 5, 0}, {0, 0, 0}, 0.5F, {0, 0, 1}),
                       " GI_transmission_depth 4\n GI_total_depth 6") +
            node("standard_surface", "glass",
                 " base 0\n specular 0\n transmission 1\n specular_roughness 0\n specular_IOR 1\n "
                 "transmission_color 0.9 0.5 0.1\n transmission_depth 0.4\n caustics on") +
            floor("top", h, 2, "glass") +
            quad("bottom", {-2, -h, -2}, {2, -h, -2}, {2, -h, 2}, {-2, -h, 2}, "glass") + sky());
    };
    EXPECT_TRUE(check_constant(seen(0.4F), "RGBA", {0.9F, 0.5F, 0.1F}, 2e-3));
    EXPECT_TRUE(check_constant(seen(0.8F), "RGBA", {0.81F, 0.25F, 0.01F}, 2e-3));
}

}  // namespace
}  // namespace lightsieve::testing
