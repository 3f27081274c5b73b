// Extensions of the language in rendered pictures: labels of objects, `&`, `-`, `$name`, and their refusal.
#include <gtest/gtest.h>

#include <stdexcept>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A labelled ball and an unlabelled one above a floor that sees both; a labelled panel that shines; two lights.
std::string stage(
    std::string_view hero = " declare lpe_label constant STRING\n lpe_label \"hero\"\n") {
    return frame_text(24, 24, 3, persp_camera({0, 3, 7}, {0, 0.5F, 0}, 45),
                      " GI_diffuse_depth 2\n GI_specular_depth 2\n") +
           node("standard_surface", "shiny",
                " base 0.6\n specular 0.8\n specular_roughness 0.3\n coat 0.5\n") +
           lambert("clay", 0.7F) + node("flat", "glow", " color 2 1 0.5\n") +
           sphere("hero_ball", {-1.2F, 0.8F, 0}, 0.8F, "shiny", hero) +
           sphere("other_ball", {1.2F, 0.8F, 0}, 0.8F, "shiny") + floor("ground", 0, 4, "clay") +
           quad("panel", {-0.5F, 0.2F, -2}, {0.5F, 0.2F, -2}, {0.5F, 1.2F, -2}, {-0.5F, 1.2F, -2},
                "glow", " declare lpe_label constant STRING\n lpe_label \"sign\"\n") +
           square_light("key", 5, 1, " aov \"key\"\n intensity 20\n");
}

const std::vector<std::string> kExpressions{
    "hero_diffuse C<RD'hero'>.*",
    "other_diffuse C<RD[^'hero']>.*",
    "all_diffuse C<RD>.*",
    "hero C'hero'.*",
    "not_hero C.* - C'hero'.*",
    "hero_coat C<RS'coat''hero'>.*",
    "sign C.*<O.'sign'>",
    "sign_seen C<O.'sign'>",
    "no_sign !(C.*<O.'sign'>)",
    "light_label C.*<[LB].'hero'>",
    "caustics CD.*S.*L",
    "indirect_less $indirect - $caustics",
    "indirect_caustics $indirect & $caustics",
};

const Picture& picture() {
    static const Picture rendered =
        render(TestScene(stage(), in_memory({"indirect"}, kExpressions), {"caustics", "hero"}));
    return rendered;
}

/// What is said of a scene that does not compile; empty if it does.
std::string errors_of(const std::string& text, const RenderOptions& options = in_memory()) {
    try {
        const TestScene scene(text, options);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

TEST(ObjectLabels, HoldThatObjectsLightExactly) {
    EXPECT_TRUE(check_sum(picture(), "all_diffuse", {"hero_diffuse", "other_diffuse"}));
    EXPECT_TRUE(check_sum(picture(), "RGBA", {"hero", "not_hero"}));
    for (const char* layer :
         {"hero_diffuse", "other_diffuse", "hero", "not_hero", "hero_coat", "sign", "sign_seen"})
        EXPECT_TRUE(check_lit(picture(), layer)) << layer;
    // Where the camera sees the ball everything came from it, elsewhere nothing.
    const Picture ids =
        render(TestScene(stage(), in_memory({"ID UINT"}, kExpressions), {"caustics", "hero"}));
    std::size_t n_hero = 0;
    for (std::size_t i = 0; i < ids.n_pixels(); ++i)
        n_hero += ids.color("hero", i).g > 0 ? 1 : 0;
    EXPECT_GT(n_hero, 10U);
    EXPECT_LT(n_hero, ids.n_pixels() / 3);
}

TEST(ObjectLabels, AreCarriedByEmissionAndNeverByLights) {
    EXPECT_TRUE(check_sum(picture(), "RGBA", {"sign", "no_sign"}));
    EXPECT_TRUE(check_black(picture(), "light_label"));
}

TEST(ObjectLabels, OfAnInstanceAreItsSourcesUnlessItHasItsOwn) {
    const auto with = [](std::string_view label) {
        const std::string text =
            stage() +
            node("ginstance", "copy",
                 " node \"hero_ball\"\n inherit_xform off\n matrix 1 0 0 0 0 1 0 0 0 0 1 0 "
                 "0 1.5 1 1\n" +
                     std::string(label));
        return render(
            TestScene(text, in_memory({}, {"hero C'hero'.*", "twin C'twin'.*"}), {"twin"}));
    };
    const Picture same = with("");
    const Picture own = with(" declare lpe_label constant STRING\n lpe_label \"twin\"\n");
    EXPECT_TRUE(check_black(same, "twin"));
    EXPECT_TRUE(check_lit(own, "twin"));
    EXPECT_TRUE(check_lit(own, "hero"));
    EXPECT_GT(estimate(same, "hero", 1).mean, estimate(own, "hero", 1).mean);
}

TEST(ObjectLabels, ThatMeanSomethingElseAreErrors) {
    const auto error = [](const std::string& type, const std::string& value) -> std::string {
        return errors_of(
            stage(" declare lpe_label constant " + type + "\n lpe_label " + value + "\n"));
    };
    const auto has = [](const std::string& errors, const char* text) {
        return errors.find(text) != std::string::npos;
    };
    EXPECT_TRUE(has(error("STRING", "\"coat\""),
                    "error[object-label]: the object label \"coat\" is that of a lobe"));
    EXPECT_TRUE(has(error("STRING", "\"key\""), "the object label \"key\" is also a light group"));
    EXPECT_TRUE(has(error("STRING", "\"it's\""), "the object label \"it's\" has a quote in it"));
    EXPECT_TRUE(has(error("INT", "3"), "lpe_label of \"hero_ball\" is no label"));
    EXPECT_EQ(error("STRING", "\"\""), "");
}

TEST(Extensions, NamedExpressionsAreTheDifference) {
    EXPECT_TRUE(check_sum(picture(), "indirect", {"indirect_less", "indirect_caustics"}));
    EXPECT_TRUE(check_lit(picture(), "indirect_less"));
}

TEST(Extensions, AreRefusedWhereOnlyTheStandardLanguageIsAllowed) {
    RenderOptions options = in_memory({}, {"a C.* - CD.*", "b $direct", "c C<RD>.*"});
    options.lpe_standard = true;
    const std::string errors = errors_of(stage(), options);
    EXPECT_NE(errors.find("error[lpe-standard]: AOV \"a\": \"-\" is no part"), std::string::npos);
    EXPECT_NE(errors.find("error[lpe-standard]: AOV \"b\": \"$direct\""), std::string::npos);
    EXPECT_EQ(errors.find("AOV \"c\""), std::string::npos);
}

}  // namespace
}  // namespace lightsieve::testing
