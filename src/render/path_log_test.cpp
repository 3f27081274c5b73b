// The path-log oracle: every path of a render as events, matched by a naive matcher, adds up to the AOVs.
#include "render/path_log.h"

#include <gtest/gtest.h>

#include "lpe/builtins.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

std::vector<std::string> all_builtins() {
    std::vector<std::string> out;
    for (const lpe::Builtin& b : lpe::builtins())
        if (b.name != "RGBA") out.emplace_back(b.name);
    return out;
}

/// Labels, groups, repeats, negations, probes deep in a path, emission and background at any depth.
std::vector<std::string> custom(const std::string& group) {
    return {"mirrored C<RS[^'coat']>+<RD>L",
            "coated C.*'coat'.*",
            "no_coat C[^'coat']*",
            "grouped C<RD><L.'" + group + "'>",
            "through C<TS>*<RD>A",
            "second C.<RD>.*",
            "third C..D.*L",
            "either C(<RD>|<TD>)S*[LO]",
            "glow C[DS]*O",
            "sky C[DS]+B",
            "two C.{2}L",
            "sheen_then C'sheen'.*",
            "not_group C.*<L[^'" + group + "']>",
            "many C(DS|SD)*.?[LOB]",
            "in_media C.*V.*",
            "twice_in_media CVV.*",
            "specular_except_coat C<RS[^'coat']>.*",
            "sss_skin C<TD'skin'>.*",
            "emission_fire C<O.'fire'>",
            "hair C'hair'.*",
            "no_smoke C[^'smoke']*"};
}

struct Case {
    const char* scene;
    const char* group;
};

class PathLogOracle : public ::testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Scenes, PathLogOracle,
                         ::testing::Values(Case{"laws_lobes.ass", "key"},
                                           Case{"laws_room.ass", "ceiling"},
                                           Case{"laws_media.ass", "key"}));

TEST_P(PathLogOracle, EqualsTheAovs) {
    std::vector<std::string> aovs = all_builtins();
    for (const char* grouped :
         {"RGBA_*", "diffuse_*", "specular_indirect_*", "background_*", "coat_default"})
        aovs.emplace_back(grouped);
    aovs.emplace_back("transmission FLOAT");
    aovs.erase(std::find(aovs.begin(), aovs.end(), "transmission"));
    RenderOptions options = in_memory(aovs, custom(GetParam().group));
    options.width = options.height = 16;
    options.spp = 2;
    const TestScene scene(scene_file(GetParam().scene), options, {"caustics"});
    const Picture picture = render(scene);
    const std::vector<LoggedPath> paths = log_paths(scene.scene());
    EXPECT_GT(paths.size(), 2000U);
    EXPECT_TRUE(check_oracle(scene.scene(), picture, paths));
    for (const char* lit :
         {"mirrored", "no_coat", "grouped", "through", "second", "either", "two"})
        EXPECT_TRUE(check_lit(picture, lit));
}

TEST(PathLog, CountsOnlyTheRegionThatIsRendered) {
    RenderOptions options = in_memory({"diffuse"});
    options.width = options.height = 16;
    options.region = Region{3, 5, 6, 9};
    const TestScene scene(scene_file("laws_lobes.ass"), options, {"caustics"});
    const std::vector<LoggedPath> paths = log_paths(scene.scene());
    for (const LoggedPath& path : paths)
        ASSERT_TRUE(path.x >= 3 && path.x <= 6 && path.y >= 5 && path.y <= 9);
    EXPECT_TRUE(check_oracle(scene.scene(), render(scene), paths));
}

TEST(PathLog, TextNamesEvents) {
    const std::string text =
        frame_text(2, 1, 1, ortho_camera({0, 2, 0}, {0, 0, 0}, 1, {0, 0, 1})) +
        node("lambert", "white", " Kd 0.5") + floor("plane", 0, 2, "white") +
        node("distant_light", "sun", " direction 0 -1 0\n aov \"sun\"");
    const TestScene scene(text, in_memory());
    const std::string log = path_log_text(scene.scene(), log_paths(scene.scene()));
    EXPECT_NE(log.find("0 0  C RD L'sun'  0.159"), std::string::npos) << log;
    EXPECT_NE(log.find("1 0  C RD L'sun'  0.159"), std::string::npos) << log;
}

}  // namespace
}  // namespace lightsieve::testing
