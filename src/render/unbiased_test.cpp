// What saves work must not move means: roulette, low-light threshold, dropped terms, dead paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "render/path_log.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

const std::vector<std::string> kAovs{"diffuse_direct", "diffuse_indirect", "specular_indirect",
                                     "coat", "transmission"};

/// Means of the beauty and of AOVs agree, pixel by pixel in pairs: 6 layers of 3 channels, a false alarm in 8000 seeds.
void expect_same_means(const Picture& a, const Picture& b) {
    EXPECT_TRUE(check_same_mean(a, "RGBA", b, "RGBA"));
    for (const std::string& aov : kAovs)
        EXPECT_TRUE(check_same_mean(a, aov, b, aov));
}

TEST(Unbiased, RouletteMovesNoAov) {
    RenderOptions early = in_memory(kAovs), never = early;
    early.spp = never.spp = 16;
    early.roulette_depth = 0;
    never.roulette_depth = -1;
    const Picture a = render(TestScene(scene_file("laws_lobes.ass"), early, {"caustics"})),
                  b = render(TestScene(scene_file("laws_lobes.ass"), never, {"caustics"}));
    EXPECT_FALSE(check_identical(a, "RGBA", b, "RGBA")) << "roulette must have acted";
    expect_same_means(a, b);
}

TEST(Unbiased, LowLightThresholdMovesNoAov) {
    RenderOptions options = in_memory(kAovs);
    options.spp = 16;
    const auto with = [&](const char* threshold) {
        std::string text = scene_file("laws_lobes.ass");
        text.replace(text.find("AA_samples 2"), 12,
                     std::string("AA_samples 2\n low_light_threshold ") + threshold);
        return render(TestScene(text, options, {"caustics"}));
    };
    const Picture a = with("0"), b = with("0.2");
    EXPECT_FALSE(check_identical(a, "RGBA", b, "RGBA")) << "the threshold must have acted";
    expect_same_means(a, b);
}

TEST(Unbiased, LowLightThresholdAsksWhatASampleStandsFor) {
    // Twenty equal lamps of which each vertex asks some: alone each is too faint to matter, together they are not.
    const auto lit = [](float threshold) {
        std::string text = frame_text(8, 8, 4, ortho_camera({0.7F, 0.5F, 0.4F}, {0, 0, 0}, 1e-3F),
                                      " low_light_threshold " + std::to_string(threshold) + '\n') +
                           lambert("grey", 0.5F) + floor("ground", 0, 3, "grey");
        for (int i = 0; i < 20; ++i)
            text += node("point_light", "lamp" + std::to_string(i), " position 0 1 0");
        return render(text);
    };
    const Picture all = lit(0);
    const float each = average(all.mean("RGBA")) / 20;
    EXPECT_TRUE(check_identical(all, "RGBA", lit(2 * each), "RGBA"));
}

// Terms --------------------------------------------------------------------------------------------------------------------

/// A closed room of half metal, half diffuse walls with a lamp: two events at every vertex.
///
/// options  more lines for the options node
std::string two_lobe_room(const std::string& options = " indirect_sample_clamp 1e6") {
    std::string text =
        frame_text(10, 10, 4, persp_camera({0.1F, 0.2F, 0.5F}, {0.3F, -0.2F, -1}, 70),
                   " GI_diffuse_depth 8\n GI_specular_depth 8\n GI_total_depth 8\n" + options) +
        node("standard_surface", "wall",
             " specular 0\n metalness 0.5\n base_color 0.8 0.7 0.9\n specular_roughness 0.6\n "
             "caustics on");
    text += floor("below", -1, 1, "wall") + floor("above", 1, 1, "wall");
    text += quad("left", {-1, -1, -1}, {-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1}, "wall") +
            quad("right", {1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, "wall");
    text += quad("back", {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, "wall") +
            quad("front", {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, "wall");
    return text +
           node("quad_light", "key",
                " vertices 4 1 VECTOR -0.3 0.9 -0.3  0.3 0.9 -0.3  0.3 0.9 0.3  -0.3 0.9 0.3");
}

TEST(Unbiased, TooManyTermsAreReducedWithoutMovingMeansOrSums) {
    // Which lobe was the sixth before last: 64 states, more than a path keeps terms.
    RenderOptions options =
        in_memory({}, {"sixth_d C.*<RD>.{5}L", "sixth_s C.*<RS>.{5}L", "short C.{0,5}L"});
    options.roulette_depth = -1;
    const TestScene scene(two_lobe_room(), options);
    const Picture picture = render(scene);
    EXPECT_TRUE(check_sum(picture, "RGBA", {"sixth_d", "sixth_s", "short"}))
        << "reduction keeps the sum";
    const std::vector<LoggedPath> paths = log_paths(scene.scene());
    EXPECT_FALSE(check_oracle(scene.scene(), picture, paths))
        << "reduction must have acted, else this test shows nothing";
    // Against the log, which never reduces: differences have mean 0. 6 comparisons.
    std::array<std::array<std::vector<double>, 3>, 2> difference;
    for (auto& aov : difference)
        for (auto& channel : aov)
            channel.resize(picture.n_pixels());
    for (const LoggedPath& path : paths) {
        if (path.events.size() < 7) continue;
        const bool diffuse =
            scene.scene().events[path.events[path.events.size() - 7]].lobe == EventLobe::Diffuse;
        for (std::size_t c = 0; c < 3; ++c)
            difference[diffuse ? 0 : 1][c]
                      [static_cast<std::size_t>(path.y * picture.width() + path.x)] -=
                static_cast<double>(path.value[static_cast<int>(c)]) /
                scene.scene().settings.samples;
    }
    for (std::size_t aov : {0U, 1U})
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < picture.n_pixels(); ++i)
                difference[aov][c][i] += static_cast<double>(
                    picture.color(aov == 0 ? "sixth_d" : "sixth_s", i)[static_cast<int>(c)]);
            EXPECT_TRUE(check_mean_of(difference[aov][c], 0,
                                      aov == 0 ? "sixth_d minus log" : "sixth_s minus log"));
        }
}

/// The room with an AOV as output, with the beauty or without it.
Picture with_output(const std::string& aov, const std::string& options, bool with_beauty) {
    const std::string own = '"' + aov + " RGB f d\"",
                      outputs = with_beauty ? "2 1 STRING \"RGBA RGBA f d\" " + own : own;
    RenderOptions in = in_memory();
    in.roulette_depth = -1;
    return render(TestScene(two_lobe_room(options + "\n outputs " + outputs), in));
}

TEST(Culling, OnlyWhatIsAskedForIsTraced) {
    const std::string off = " indirect_sample_clamp 1e30", on = " indirect_sample_clamp 10";
    for (const std::string aov : {"direct", "diffuse_direct", "specular_indirect", "specular"}) {
        const Picture full = with_output(aov, off, true), part = with_output(aov, off, false);
        EXPECT_TRUE(check_lit(part, aov));
        EXPECT_TRUE(check_same_mean(part, aov, full, aov)) << aov;
        EXPECT_LT(part.result().rays, full.result().rays) << aov;
        // Where lobes are sampled as ever, fewer rays give the same bits.
        const Picture full_clamped = with_output(aov, on, true),
                      clamped = with_output(aov, on, false);
        EXPECT_TRUE(check_identical(clamped, aov, full_clamped, aov)) << aov;
        EXPECT_LE(clamped.result().rays, full_clamped.result().rays) << aov;
    }
    // Direct light is a camera ray, rays to the light, and rays that may meet it: nothing of the eight bounces.
    const RenderResult direct = with_output("direct", off, false).result();
    EXPECT_LT(static_cast<double>(direct.rays) / static_cast<double>(direct.samples), 12.0);
}

TEST(Culling, IsOffWhereSomethingLooksAtAllLight) {
    const auto rays = [](const std::string& options, bool with_beauty = false) {
        return with_output("diffuse_direct", options, with_beauty).result().rays;
    };
    const std::uint64_t all = rays(" AA_sample_clamp 5", true);
    EXPECT_LT(rays(""), all / 2);
    EXPECT_EQ(rays(" AA_sample_clamp 5"), all);
    // And it is said.
    for (const std::string param : {"AA_sample_clamp", "enable_adaptive_sampling"}) {
        const std::string value = param == "AA_sample_clamp" ? " 5" : " on";
        const TestScene scene(
            two_lobe_room(" " + param + value + "\n outputs \"direct RGB f d\""));
        ASSERT_EQ(scene.diagnostics().items().size(), 1U);
        EXPECT_EQ(scene.diagnostics().items()[0].code, Code::OutputCulling);
        EXPECT_NE(scene.diagnostics().items()[0].message.find(param + " looks at it"),
                  std::string::npos);
    }
    EXPECT_TRUE(
        TestScene(two_lobe_room("\n outputs \"direct RGB f d\"")).diagnostics().items().empty());
}

TEST(Unbiased, PathsEndOnlyWhenEveryTermIsDead) {
    // Without the beauty a path may stop early; what is asked for must be the same light.
    const auto only = [](const char* output) {
        std::string text = scene_file("laws_lobes.ass");
        text.replace(text.find("outputs \"RGBA RGBA f d\""), 23,
                     std::string("outputs \"") + output + " RGB f d\"");
        return render(TestScene(text, in_memory(), {"caustics"}));
    };
    const Picture all =
        render(TestScene(scene_file("laws_lobes.ass"),
                         in_memory({"emission", "coat_direct", "transmission_indirect",
                                    "diffuse_albedo", "background"}),
                         {"caustics"}));
    std::uint64_t rays = all.result().rays;
    for (const char* aov :
         {"transmission_indirect", "coat_direct", "diffuse_albedo", "emission", "background"}) {
        const Picture alone = only(aov);
        EXPECT_TRUE(check_lit(alone, aov));
        EXPECT_TRUE(check_equal(alone, aov, all, aov));
        EXPECT_LT(alone.result().rays, rays) << aov << " must not cost what everything costs";
    }
}

}  // namespace
}  // namespace lightsieve::testing
