// Lints that need to know which paths an expression takes, or what is in the scene. Most rows are
// in the corpus.
#include "lpe/lint.h"

#include <gtest/gtest.h>

#include "lpe/builtins.h"
#include "lpe/parse.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_events;
using testing::must_parse;

std::string lints(std::string_view text) {
    Diagnostics diagnostics;
    const Expr expr = parse(text, diagnostics);
    lint_expression(text, {}, "", expr, diagnostics);
    return diagnostics.render();
}

TEST(Lint, HintsSayWhyNothingIsTaken) {
    const auto hint = [](const char* text) {
        const std::string rendered = lints(text);
        const std::size_t at = rendered.find("hint: ");
        return at == std::string::npos ? rendered
                                       : rendered.substr(at + 6, rendered.find('\n', at) - at - 6);
    };
    EXPECT_EQ(hint("D.*"), "start it with the camera C");
    EXPECT_EQ(hint(".*"), "start it with the camera C");
    EXPECT_EQ(hint("CD"), "end it with one of L O B A, or .*");
    EXPECT_EQ(hint("C<TD>"), "end it with one of L O B A, or .*");
    EXPECT_EQ(hint("CDLS"), "C can stand only first, L O B A only last");
    EXPECT_EQ(hint("CDL'key'"), "light of a group is written <L.'key'>");
    EXPECT_EQ(hint("(CDL) (CVL)"), "alternatives are written ((..)|(..))");
    EXPECT_EQ(hint("C.*"), "");
}

TEST(Lint, NamesOfCustomExpressionsDoNotChangeHowFarABarReaches) {
    ExpressionTable table;
    Diagnostics diagnostics;
    const auto define = [&](const std::string& text) {
        table.define(text, stand_alone(text), diagnostics);
    };
    define("mine C[DS]L");
    define("other $mine - CSL");
    define("either (($mine)|($other))");
    define("reaches C$mine|$other");
    table.resolve(diagnostics);
    std::size_t n_binding = 0;
    for (const Error& item : diagnostics.items())
        n_binding += item.code == Code::LpeBinding ? 1 : 0;
    EXPECT_EQ(n_binding, 1U) << diagnostics.render();
}

TEST(Lint, RenderedText) {
    EXPECT_EQ(lints("((C.*)|(DL))"),
              "<expression>:1:9: lint[lpe-never]: this alternative can never take any path\n"
              "    1 | ((C.*)|(DL))\n"
              "      |         ^~\n"
              "  hint: start it with the camera C\n");
    EXPECT_EQ(lints("CDL|CSL"),
              "<expression>:1:4: lint[lpe-binding]: OSL and RenderMan would choose between the "
              "two events beside \"|\"\n"
              "    1 | CDL|CSL\n"
              "      |    ^\n"
              "  hint: write ((..)|(..)), which all of them read alike\n");
    EXPECT_EQ(lints("C[DSV][LA]"),
              "<expression>:1:1: lint[lpe-mixed]: this takes light and albedo probes together\n"
              "    1 | C[DSV][LA]\n"
              "      | ^~~~~~~~~~\n"
              "  hint: the sum means nothing: make it two AOVs\n");
}

TEST(Lint, OneThatWouldCostTooMuchIsLeftOut) { EXPECT_EQ(lints("C.*D.{20}L"), ""); }

TEST(Lint, NullIsLeftAlone) {
    Diagnostics diagnostics;
    lint_expression("C<", {}, "", nullptr, diagnostics);
    lint_in_scene(nullptr, "", must_events("RD L"), diagnostics);
    EXPECT_TRUE(diagnostics.items().empty());
}

class SceneLints : public ::testing::Test {
  protected:
    /// "code: message; hint" of each lint.
    std::vector<std::string> lint(const char* text) {
        Diagnostics diagnostics;
        lint_in_scene(must_parse(text), "x", events_, diagnostics);
        std::vector<std::string> out;
        for (const Error& error : diagnostics.items())
            out.push_back(std::string(code_text(error.code)) + ": " + error.message + "; " +
                          error.hint);
        return out;
    }
    std::vector<Event> events_ = must_events("RD RS RS'coat' RD'skin' L L'key' L'fill' O'fire' B");
    using Lints = std::vector<std::string>;
};

TEST_F(SceneLints, LabelsThatNothingCarries) {
    EXPECT_EQ(
        lint("C<RS'caot'>.*"),
        Lints{"lpe-label-unknown: AOV \"x\": no lobe labelled \"caot\"; did you mean \"coat\"?"});
    EXPECT_EQ(
        lint("C.*<L.'kye'>"),
        Lints{"lpe-label-unknown: AOV \"x\": no light in group \"kye\"; did you mean \"key\"?"});
    EXPECT_EQ(lint("C.*<L.'sun'>"),
              Lints{"lpe-label-unknown: AOV \"x\": no light in group \"sun\"; the scene has the "
                    "light groups \"default\", \"fill\", \"key\""});
    EXPECT_EQ(lint("C'hair'.*"),
              Lints{"lpe-label-unknown: AOV \"x\": no lobe or light group \"hair\"; the scene has "
                    "the labels \"coat\", \"default\", \"fill\", \"fire\", \"key\", \"skin\""});
    EXPECT_EQ(lint("C<RD'key'>.*"), Lints{"lpe-label-unknown: AOV \"x\": no lobe labelled "
                                          "\"key\"; it is a light group: <L.'key'>"});
    EXPECT_EQ(lint("C<RS'a'>V'b'L").size(), 2U);
}

TEST_F(SceneLints, ExcludingWhatIsNotThereIsFineUnlessItLooksLikeASlip) {
    EXPECT_EQ(lint("C<RS[^'sheen']>.*"), Lints{});
    EXPECT_EQ(lint("C<RS[^'velvet']>.*"), Lints{});
    EXPECT_EQ(
        lint("C<RS[^'caot']>.*"),
        Lints{"lpe-label-unknown: AOV \"x\": no lobe labelled \"caot\"; did you mean \"coat\"?"});
}

TEST_F(SceneLints, BareLabelsThatAreGroups) {
    EXPECT_EQ(lint("C.*'key'"), Lints{"lpe-label-is-group: AOV \"x\": \"key\" is also a light "
                                      "group; its light is <L.'key'>; this takes lobes too"});
    EXPECT_EQ(lint("C.*<L.'key'>"), Lints{});
}

TEST_F(SceneLints, NoPathOfThisScene) {
    EXPECT_EQ(lint("CV.*"),
              Lints{"lpe-nothing-here: AOV \"x\": this takes no path of this scene; no shader, "
                    "light or medium of the scene makes the events it needs"});
    EXPECT_EQ(lint("C<TS>.*").size(), 1U);
    EXPECT_EQ(lint("C<RD>.*"), Lints{});
    // Impossible in every scene: the other lint says so.
    EXPECT_EQ(lint("CDLL"), Lints{});
}

TEST(Overlap, OfOutputsThatPeopleAddUp) {
    const auto lint = [](BuiltinTable table_name, const std::vector<std::string_view>& names) {
        const ExpressionTable table(table_name);
        std::vector<LintOutput> outputs;
        for (const std::string_view name : names)
            outputs.push_back({name, table.find(name)->expr});
        Diagnostics diagnostics;
        lint_overlaps(outputs, diagnostics);
        std::string out;
        for (const Error& error : diagnostics.items())
            out += error.message + "; " + error.hint + "\n";
        return out;
    };
    EXPECT_EQ(
        lint(BuiltinTable::Reference, {"RGBA", "diffuse", "specular", "coat", "sheen"}),
        "\"specular\" and \"sheen\" both take \"C RS'sheen' L\": added up, that counts twice; "
        "the table of Arnold 7 takes sheen out of specular\n");
    // One for all pairs of the same two parts.
    EXPECT_EQ(
        lint(BuiltinTable::Reference,
             {"specular", "specular_direct", "sheen", "sheen_direct", "coat"}),
        "\"specular\" and \"sheen\" both take \"C RS'sheen' L\": added up, that counts twice "
        "(so do 3 more pairs like this); the table of Arnold 7 takes sheen out of specular\n");
    EXPECT_EQ(lint(BuiltinTable::Arnold7, {"RGBA", "diffuse", "specular", "coat", "sheen"}), "");
    // Parts beside their sum are no mistake.
    EXPECT_EQ(lint(BuiltinTable::Reference,
                   {"diffuse", "diffuse_direct", "diffuse_indirect", "direct", "albedo"}),
              "");
    for (const auto& set : additive_sets(BuiltinTable::Reference))
        EXPECT_EQ(lint(BuiltinTable::Reference, set), "");
}

TEST(Overlap, OfAReplacedBuiltin) {
    ExpressionTable table;
    Diagnostics diagnostics;
    table.define("diffuse CD.*", {}, diagnostics);
    const std::vector<LintOutput> outputs{{"sss", table.find("sss")->expr},
                                          {"diffuse", table.find("diffuse")->expr}};
    lint_overlaps(outputs, diagnostics);
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::LpeOverlap);
    EXPECT_EQ(diagnostics.items()[0].message,
              "\"sss\" and \"diffuse\" both take \"C TD L\": added up, that counts twice");
}

}  // namespace
}  // namespace lightsieve::lpe
