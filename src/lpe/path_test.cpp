// Paths as people write them, and the question whether an expression takes one.
#include "lpe/path.h"

#include <gtest/gtest.h>

#include "lpe/match.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_parse;
using testing::must_path;

TEST(PathText, ReadsWhatTheCommandLineDocuments) {
    const Path path = must_path("C <RS'coat'> TS L'key'");
    ASSERT_EQ(path.size(), 4U);
    EXPECT_EQ(path[0], Event{});
    EXPECT_EQ(path[1], (Event{EventKind::Reflection, EventLobe::Specular, {"coat"}}));
    EXPECT_EQ(path[2], (Event{EventKind::Transmission, EventLobe::Specular, {}}));
    EXPECT_EQ(path[3], (Event{EventKind::Light, EventLobe::None, {"key"}}));
    EXPECT_EQ(must_path("C V O'fire'")[2], (Event{EventKind::Object, EventLobe::None, {"fire"}}));
    EXPECT_EQ(must_path("C RD L")[2].labels, (std::vector<std::string>{"default"}));
    EXPECT_EQ(must_path("C RD B")[2].labels, (std::vector<std::string>{}));
    EXPECT_EQ(must_path("C RS'hero''coat' L")[1].labels,
              (std::vector<std::string>{"coat", "hero"}));
}

TEST(PathText, ManySpellingsOnePath) {
    for (const char* text : {"C RD L'key'", " C\tRD  L'key' ", "<C> <RD> <L.'key'>",
                             "C <R D> < L . 'key' >", "C RD L.'key'"})
        EXPECT_EQ(print_path(must_path(text)), "C RD L'key'") << text;
    EXPECT_EQ(print_path(must_path("C RS'b''a''b' B'sky'")), "C RS'a''b' B'sky'");
    EXPECT_EQ(print_path(must_path("C RD L'default'")), "C RD L");
}

TEST(PathText, MistakesAreBlamedAtTheirColumn) {
    const auto mistake = [](const char* text) {
        Diagnostics diagnostics;
        EXPECT_EQ(parse_path(text, diagnostics), std::nullopt) << text;
        EXPECT_EQ(diagnostics.n_errors(), 1U);
        const Error& error = diagnostics.items()[0];
        EXPECT_TRUE(error.code == Code::LpePath || error.code == Code::LpeUnclosed ||
                    error.code == Code::LpeEvent);
        return std::to_string(error.where.line_column().column) + ": " + error.message + "; " +
               error.hint;
    };
    EXPECT_EQ(mistake(""),
              "1: the path is empty; a path is C, scattering events, then one of L O B A: C RD L");
    EXPECT_EQ(
        mistake("C RD"),
        "5: the path does not end; a path is C, scattering events, then one of L O B A: C RD L");
    EXPECT_EQ(mistake("RD L"),
              "1: the path does not start with C; a path is read from the camera: C RD L");
    EXPECT_EQ(mistake("C RD C L"),
              "6: C stands only first; a path is read from the camera: C RD L");
    EXPECT_EQ(mistake("C L RD"),
              "5: the path goes on after it has ended; L O B A stand only last");
    EXPECT_EQ(mistake("C A"), "3: a probe without a vertex; the albedo of a first hit is C RD A");
    EXPECT_EQ(mistake("C D L"), "3: \"D\" is no single event; say what happened: RD or TD");
    EXPECT_EQ(mistake("C R L"), "3: \"R\" is no single event; say which lobe: RD or RS");
    EXPECT_EQ(mistake("C T'x' L"), "3: \"T\" is no single event; say which lobe: TD or TS");
    EXPECT_EQ(mistake("C . L"), "3: a path holds single events; one of RD RS TD TS V L O B A");
    EXPECT_EQ(mistake("C RDL"), "5: no blank between two events; write C RD L");
    EXPECT_EQ(mistake("C <RD L"), "3: \"<\" is never closed; close it with \">\"");
    EXPECT_EQ(mistake("C RD'x L"), "5: a quote that never ends; close the label: 'x'");
    EXPECT_EQ(mistake("C L'a''b'"),
              "4: too many labels; a lobe carries two at most, a light its one group");
    EXPECT_EQ(mistake("C RD A'x'"),
              "7: this event carries no label; a lobe carries two at most, a light its one group");
    EXPECT_EQ(mistake("C RG L"), "3: \"R\" is no single event; say which lobe: RD or RS");
    EXPECT_EQ(mistake("C G L"),
              "3: no event \"G\"; OSL has glossy and straight; here S covers both");
}

TEST(PathText, WhatIsAPath) {
    const Event camera{}, diffuse{EventKind::Reflection, EventLobe::Diffuse, {}};
    const Event light{EventKind::Light, EventLobe::None, {"default"}},
        probe{EventKind::Albedo, EventLobe::None, {}};
    const auto is = [](const Path& path) { return is_path(path); };
    EXPECT_TRUE(is({camera, light}));
    EXPECT_TRUE(is({camera, diffuse, probe}));
    EXPECT_FALSE(is({}));
    EXPECT_FALSE(is({camera}));
    EXPECT_FALSE(is({camera, probe}));
    EXPECT_FALSE(is({camera, diffuse}));
    EXPECT_FALSE(is({diffuse, light}));
    EXPECT_FALSE(is({camera, camera, light}));
    EXPECT_FALSE(is({camera, light, light}));
}

TEST(Match, AsksExpressionsWhoseAutomatonIsTooLarge) {
    const Expr expr = must_parse("C.*D.{20}L");
    std::string path = "C RS RD";
    for (int i = 0; i < 20; ++i)
        path += " RS";
    EXPECT_TRUE(match(expr, must_path(path + " L")));
    EXPECT_FALSE(match(expr, must_path(path + " RS L")));
}

TEST(Match, NothingIsTakenByNullAndNothingThatIsNoPath) {
    EXPECT_FALSE(match(Expr{}, must_path("C L")));
    EXPECT_FALSE(match(must_parse("C.*"), Path{}));
    EXPECT_FALSE(match(must_parse("C"), Path{Event{}}));
    EXPECT_FALSE(match(must_parse("CA"), Path{Event{}, {EventKind::Albedo, EventLobe::None, {}}}));
}

TEST(Match, HasABudgetToo) {
    Limits limits;
    limits.max_steps = 20;
    std::string path = "C";
    for (int i = 0; i < 40; ++i)
        path += " RD V";
    EXPECT_THROW((void)match(must_parse("C(D?V?){200}L"), must_path(path + " L"), limits),
                 InputError);
}

}  // namespace
}  // namespace lightsieve::lpe
