// Curves as rays meet them, and hair as light sees it.
#include <gtest/gtest.h>

#include "lpe/builtins.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A fibre along y through the origin, from -2 to 2, in five points.
std::string fibre(const std::string& shader, float radius, const std::string& more) {
    return node("curves", "strand",
                " points 5 1 VECTOR 0 -2 0  0 -1 0  0 0 0  0 1 0  0 2 0\n radius " +
                    text_of(radius) + "\n shader " + shader + '\n' + more);
}

/// Parallel rays along -z onto a square of width 1.
std::string from_the_front(int pixels, int aa, const std::string& options = "") {
    return frame_text(pixels, pixels, aa, ortho_camera({0, 0, 5}, {0, 0, 0}, 1), options);
}

const std::string kSky = node("skydome_light", "sky", " camera 0");
/// Hair without pigment: nothing is lost in it.
const std::string kWhiteHair = " melanin 0\n";
/// Rays that leave the fibre may meet nothing but lights: one that met the fibre again would be lost.
const std::string kNoBounces =
    " GI_diffuse_depth 0\n GI_specular_depth 0\n GI_transmission_depth 0\n";

struct Kind {
    const char* name;
    const char* params;
};
constexpr std::array kKinds{
    Kind{"flat ribbon", " basis linear\n mode ribbon\n"},
    Kind{"curved ribbon", " basis b-spline\n mode ribbon\n"},
    Kind{"straight tube", " basis linear\n mode thick\n"},
    Kind{"curved tube", " basis catmull-rom\n mode thick\n"},
    Kind{"oriented",
         " basis linear\n mode oriented\n orientations 5 1 VECTOR 0 0 1 0 0 1 0 0 1 0 "
         "0 1 0 0 1\n"}};

// Geometry ---------------------------------------------------------------------------------------------------------------

TEST(Curves, AreAsWideAsTheirRadiusSays) {
    for (const Kind& kind : kKinds) {
        const Picture picture = render(from_the_front(16, 8) + node("flat", "f1", "") +
                                       fibre("f1", 0.2F, kind.params));
        EXPECT_NEAR(picture.mean_alpha("RGBA"), 0.4, 2e-3) << kind.name;
    }
}

TEST(Curves, InstancesAndMatricesScaleThem) {
    // Twice as wide and, squashed, half as wide.
    for (const auto& [matrix, width] : {std::pair{"2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1", 0.4},
                                        std::pair{"0.5 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", 0.1}})
        for (const char* mode : {" mode ribbon\n", " mode thick\n"}) {
            const std::string placed = std::string(" matrix 1 1 MATRIX ") + matrix + '\n';
            const std::string front = from_the_front(16, 8) + node("flat", "f1", "");
            EXPECT_NEAR(render(front + fibre("f1", 0.1F, " basis linear\n" + placed + mode))
                            .mean_alpha("RGBA"),
                        width, 2e-3)
                << matrix << mode;
            const std::string hidden =
                fibre("f1", 0.1F, std::string(" basis linear\n visibility 0\n") + mode);
            EXPECT_NEAR(
                render(front + hidden +
                       node("ginstance", "copy", " node strand\n visibility 255\n" + placed))
                    .mean_alpha("RGBA"),
                width, 2e-3)
                << matrix << mode;
        }
}

TEST(Curves, MoveByTheirKeys) {
    // From x = -0.25 to 0.25 while the shutter is open: half the time the left half is covered.
    const std::string camera =
        node("ortho_camera", "cam",
             " position 0 0 5\n look_at 0 0 0\n up 0 1 0\n screen_window_min -0.5 -0.5\n "
             "screen_window_max 0.5 0.5\n shutter_start 0\n shutter_end 1");
    const Picture picture = render(
        frame_text(2, 1, 64, camera) + node("flat", "f1", "") +
        node("curves", "strand",
             " basis linear\n mode thick\n shader f1\n radius 0.1\n points 2 2 VECTOR -0.25 -2 0 "
             "-0.25 2 0 0.25 -2 0 0.25 2 0"));
    EXPECT_NEAR(picture.alpha("RGBA", 0), 0.2, 0.02);
    EXPECT_NEAR(picture.alpha("RGBA", 1), 0.2, 0.02);
}

TEST(Curves, ShadersSeeAcrossAndAlong) {
    // utility shows uv: across from left to right, along from root to tip.
    const Picture picture = render(from_the_front(32, 1) +
                                   node("utility", "show", " color_mode uv\n shade_mode flat") +
                                   fibre("show", 0.4F, " basis linear\n mode ribbon\n"));
    const auto uv = [&](std::size_t x, std::size_t y) {
        return picture.color("RGBA", y * 32 + x);
    };
    EXPECT_LT(std::min(uv(4, 16).r, uv(27, 16).r), 0.1F);
    EXPECT_GT(std::max(uv(4, 16).r, uv(27, 16).r), 0.9F);
    EXPECT_NEAR(uv(16, 0).g, 0.62F, 0.01F);
    EXPECT_NEAR(uv(16, 31).g, 0.38F, 0.01F);
}

// Light ------------------------------------------------------------------------------------------------------------------

TEST(Hair, WhiteFurnace) {
    // Nothing is lost, and no ray that leaves the fibre meets it again.
    for (const Kind& kind : kKinds)
        for (const char* more : {"", " diffuse 1\n", " roughness 0.6\n diffuse 0.5\n shift 6\n"}) {
            const Picture picture =
                render(from_the_front(8, 8, kNoBounces) +
                       node("standard_hair", "hair", kWhiteHair + more + " extra_depth 0\n") +
                       fibre("hair", 1.5F, kind.params) + kSky);
            // The lobes along a rough, tilted fibre are cut off at its poles.
            EXPECT_TRUE(check_mean(
                picture, "RGBA", kWhite,
                std::string_view(more).find("roughness") != std::string_view::npos ? 1e-2 : 3e-3))
                << kind.name << more;
        }
}

TEST(Hair, FurnaceOfTheClosure) {
    const Picture picture =
        render(from_the_front(8, 8, kNoBounces) +
               node("chiang_hair_bsdf", "hair", " roughness_R 0.05 0.2\n cuticle_angle 0.52\n") +
               fibre("hair", 1.5F, " basis linear\n mode thick\n") + kSky);
    EXPECT_TRUE(check_mean(picture, "RGBA", kWhite, 3e-3));
}

TEST(Hair, LightFromBehindComesThrough) {
    const std::string behind = node("distant_light", "sun", " direction 0 0 1\n intensity 2\n");
    for (const Kind& kind : kKinds) {
        const Picture picture =
            render(from_the_front(8, 4) + node("standard_hair", "hair", kWhiteHair) +
                       fibre("hair", 0.3F, kind.params) + behind,
                   in_memory({"transmission", "specular", "diffuse"}));
        EXPECT_TRUE(check_lit(picture, "transmission")) << kind.name;
        // Without pigment and from right behind, most of the light goes straight through.
        EXPECT_GT(picture.mean("transmission").g, 3 * picture.mean("specular").g) << kind.name;
        EXPECT_TRUE(check_black(picture, "diffuse"));
        EXPECT_TRUE(check_sum(picture, "RGBA", {"transmission", "specular"}));
    }
}

TEST(Hair, MeltsIntoNothingAtZeroRadius) {
    const Picture picture = render(TestScene(
        from_the_front(8, 2) + node("flat", "f1", "") + fibre("f1", 0, " basis linear\n"),
        in_memory(), {"left out"}));
    EXPECT_EQ(picture.mean_alpha("RGBA"), 0);
}

// AOVs -------------------------------------------------------------------------------------------------------------------

/// Two strands over a floor with every lobe of hair, emission too, between two lights.
std::string hair_scene() {
    return frame_text(16, 16, 3, persp_camera({0, 1, 4}, {0, 0.2F, 0}, 35),
                      " GI_diffuse_depth 2\n GI_specular_depth 1\n light_path_expressions 2 1 "
                      "STRING \"hair C'hair'.*\" \"other C[^'hair'].*\"\n") +
           node("standard_hair", "fur",
                " melanin 0.2\n diffuse 0.3\n diffuse_color 0.8 0.6 0.4\n emission 0.05\n") +
           lambert("grey", 0.5F) + floor("ground", -0.5F, 3, "grey") +
           node(
               "curves", "strands",
               " basis catmull-rom\n mode thick\n shader fur\n radius 0.2\n num_points 2 1 UINT 5 "
               "5\n points 10 1 VECTOR -0.4 -1 0 -0.4 -0.5 0 -0.4 0 0 -0.2 0.5 0 0 1 0  0.4 -1 0 "
               "0.4 -0.5 0 0.4 0 0.2 0.3 0.5 0 0.2 1 0") +
           node("quad_light", "key",
                " intensity 9\n aov key\n vertices 4 1 VECTOR -1 2 -1  1 2 -1  1 2 1  -1 2 1") +
           node("skydome_light", "sky", " intensity 0.2\n camera 0");
}

std::vector<std::string> builtin_names() {
    std::vector<std::string> out;
    for (const lpe::Builtin& b : lpe::builtins())
        if (b.name != "RGBA") out.emplace_back(b.name);
    return out;
}

TEST(Hair, ItsLabelTakesAllThatHairScatters) {
    std::vector<std::string> aovs = builtin_names();
    aovs.insert(aovs.end(), {"hair", "other"});
    const Picture picture = render(hair_scene(), in_memory(aovs));
    for (const char* layer : {"hair", "other", "diffuse", "specular", "transmission", "emission"})
        EXPECT_TRUE(check_lit(picture, layer));
    EXPECT_TRUE(check_sum(picture, "RGBA", {"hair", "other"}));
    for (const auto& set : lpe::additive_sets(lpe::BuiltinTable::Reference))
        EXPECT_TRUE(check_sum(picture, "RGBA", {set.begin(), set.end()}));
    // Pixels on hair alone: no light of theirs is elsewhere.
    const Picture close =
        render(from_the_front(8, 2, " light_path_expressions \"hair C'hair'.*\"\n") +
                   node("standard_hair", "fur", " melanin 0.3\n diffuse 0.5\n emission 0.1\n") +
                   fibre("fur", 1.5F, " basis linear\n mode thick\n") + kSky,
               in_memory({"hair"}));
    EXPECT_TRUE(check_equal(close, "RGBA", close, "hair"));
}

TEST(Hair, ThePathLogAgrees) {
    std::vector<std::string> aovs = builtin_names();
    aovs.insert(aovs.end(), {"hair", "other"});
    RenderOptions options = in_memory(aovs);
    options.spp = 1;
    const TestScene scene(hair_scene(), options);
    EXPECT_TRUE(check_oracle(scene.scene(), render(scene), log_paths(scene.scene())));
}

TEST(Hair, ExtraDepthLetsHighlightsGoOn) {
    // A tuft: most light of pale hair has passed several strands.
    std::string points;
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 4; ++k) {
            const float x = 0.25F * static_cast<float>(i) - 0.5F,
                        z = -0.3F * static_cast<float>(k);
            points += text_of(Vec3f{x, -2, z}) + ' ' + text_of(Vec3f{x, 2, z}) + ' ';
        }
    const auto brightness = [&](int extra_depth) {
        return render(from_the_front(8, 6, " GI_specular_depth 0\n GI_transmission_depth 0\n") +
                      node("standard_hair", "fur",
                           kWhiteHair + " extra_depth " + std::to_string(extra_depth)) +
                      node("curves", "tuft",
                           " basis linear\n mode ribbon\n shader fur\n radius 0.14\n num_points "
                           "2\n points 40 1 VECTOR " +
                               points) +
                      kSky)
            .mean("RGBA")
            .g;
    };
    const float without = brightness(0), with = brightness(9);
    EXPECT_LT(without, 0.8F);
    EXPECT_GT(with, without + 0.1F);
}

}  // namespace
}  // namespace lightsieve::testing
