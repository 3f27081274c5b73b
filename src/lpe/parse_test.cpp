// The reader and the printer: round trips, and errors exactly as people see them. Verdicts are in
// the corpus.
#include "lpe/parse.h"

#include <gtest/gtest.h>

#include <random>

#include "lpe/dump.h"
#include "lpe/print.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_parse;

std::string rendered(std::string_view text) {
    Diagnostics diagnostics;
    const Expr expr = parse(text, diagnostics);
    EXPECT_EQ(expr == nullptr, diagnostics.has_errors());
    return diagnostics.render();
}

TEST(Parse, TreeOfEveryForm) {
    EXPECT_EQ(dump(must_parse("C<[RT]D'a'[^'b''c'].>*('x'|[^.<V>]{2,3})L?")),
              "sequence\n"
              "  letter C\n"
              "  repeat 0..\n"
              "    event <[RT]D'a'[^'b''c'].>\n"
              "  alternatives\n"
              "    label 'x'\n"
              "    repeat 2..3\n"
              "      one of [^.<V>]\n"
              "  repeat 0..1\n"
              "    letter L\n");
}

TEST(Parse, PlacesOfNodes) {
    const Expr expr = must_parse(" C (D | <R S>)* L");
    const auto& parts = std::get<Sequence>(expr->form).parts;
    EXPECT_EQ(expr->where.text(), "C (D | <R S>)* L");
    EXPECT_EQ(parts[0]->where.text(), "C");
    EXPECT_EQ(parts[1]->where.text(), "(D | <R S>)*");
    const auto& choice = std::get<Alternation>(std::get<Repeat>(parts[1]->form).body->form);
    EXPECT_EQ(choice.parts[1]->where.text(), "<R S>");
}

TEST(Print, OneSpelling) {
    const auto printed = [](const char* text) { return print(must_parse(text)); };
    EXPECT_EQ(printed(" C <L. 'key'> "), "C<L.'key'>");
    EXPECT_EQ(printed("CDL|CSL"), "((CDL)|(CSL))");
    EXPECT_EQ(printed("((C<TD>A) (CVA) (C<RD>A))"), "((C<TD>A)|(CVA)|(C<RD>A))");
    EXPECT_EQ(printed("C(D|S)*L"), "C((D)|(S))*L");
    EXPECT_EQ(printed("C((DS))+L"), "C(DS)+L");
    EXPECT_EQ(printed("C((D))L"), "CDL");
    EXPECT_EQ(printed("C(D*)*L"), "C(D*)*L");
    EXPECT_EQ(printed("CD{0,}V{1,}S{0,1}L{2}O{2,}B{02,3}"), "CD*V+S?L{2}O{2,}B{2,3}");
    EXPECT_EQ(printed("C[ ^ 'a' <R[^D]> ]L"), "C[^'a'<R[^D]>]L");
    EXPECT_EQ(print(Expr{}), "");
}

TEST(Print, RandomTreesComeBack) {
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        const Expr expr = testing::random_expression(random, 1 + random() % 25);
        const std::string text = print(expr);
        const Expr again = must_parse(text);
        ASSERT_TRUE(equal(expr, again)) << text << "\n" << dump(expr) << dump(again);
        ASSERT_EQ(print(again), text);
    }
}

TEST(Parse, ErrorsAsPeopleSeeThem) {
    EXPECT_EQ(rendered("C<RD.*L"),
              "<expression>:1:2: error[lpe-unclosed]: \"<\" is never closed\n"
              "    1 | C<RD.*L\n"
              "      |  ^\n"
              "  hint: close it: <RD>\n");
    EXPECT_EQ(rendered("CGL"),
              "<expression>:1:2: error[lpe-event]: no event \"G\"\n"
              "    1 | CGL\n"
              "      |  ^\n"
              "  hint: OSL has glossy and straight; here S covers both\n");
    EXPECT_EQ(rendered("C'key"),
              "<expression>:1:2: error[lpe-unclosed]: a quote that never ends\n"
              "    1 | C'key\n"
              "      |  ^\n"
              "  hint: close the label: 'key'\n");
    // A column counts characters, not bytes.
    EXPECT_EQ(
        rendered("C'Größe'\u0410"),
        "<expression>:1:9: error[lpe-look-alike]: \"\u0410\" (U+0410) only looks like \"A\"\n"
        "    1 | C'Größe'\u0410\n"
        "      |         ^\n"
        "  hint: type \"A\" itself\n");
    EXPECT_EQ(rendered("C\n<R*>L"),
              "<expression>:2:3: error[lpe-quantifier]: a quantifier inside <..>\n"
              "    2 | <R*>L\n"
              "      |   ^\n"
              "  hint: put it after the \">\"\n");
    EXPECT_EQ(rendered("cL"),
              "<expression>:1:1: lint[lpe-lower-case]: \"c\" is read as the camera \"C\"\n"
              "    1 | cL\n"
              "      | ^\n"
              "  hint: write \"C\"\n");
    EXPECT_EQ(rendered("C<L'key'>"),
              "<expression>:1:4: lint[lpe-lobe-slot]: a label where the lobe belongs\n"
              "    1 | C<L'key'>\n"
              "      |    ^~~~~\n"
              "  hint: put a . before it: <L.'key'>\n");
}

TEST(Parse, ErrorsInASceneNameFileLineAndAov) {
    const auto source = std::make_shared<const SourceText>(
        SourceText{"shot.ass", "options\n{\n light_path_expressions \"caustics CDX.*\"\n}\n"});
    const std::size_t offset = source->text.find("CDX");
    Diagnostics diagnostics;
    EXPECT_EQ(parse("CDX.*", {source, offset, 5}, diagnostics, {.aov_name = "caustics"}), nullptr);
    EXPECT_EQ(diagnostics.render(),
              "shot.ass:3:37: error[lpe-event]: AOV \"caustics\": no event \"X\"\n"
              "    3 |  light_path_expressions \"caustics CDX.*\"\n"
              "      |                                     ^\n"
              "  hint: events are C D S R T V L O B A and . (any); a label is quoted: 'X'\n");
}

TEST(Parse, AStringWithEscapesIsBlamedAsAWhole) {
    const auto source = std::make_shared<const SourceText>(SourceText{"a.ass", "\"C\\tX\""});
    Diagnostics diagnostics;
    EXPECT_EQ(parse("C\tX", {source, 1, 4}, diagnostics), nullptr);
    EXPECT_EQ(diagnostics.items()[0].where.offset, 1U);
    EXPECT_EQ(diagnostics.items()[0].where.length, 4U);
}

TEST(Parse, LimitsAreNamed) {
    const std::string longest = "C" + std::string(kMaxTextLength - 1, '.');
    EXPECT_EQ(rendered(longest), "");
    Diagnostics diagnostics;
    EXPECT_EQ(parse(longest + ".", diagnostics), nullptr);
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::LimitLpeLength);
    EXPECT_EQ(diagnostics.items()[0].hint, "the limit kMaxTextLength is 65536");
    EXPECT_EQ(rendered(std::string(kMaxNesting, '(') + "C" + std::string(kMaxNesting, ')')), "");
}

TEST(Parse, StopsAfterTwentyErrors) {
    Diagnostics diagnostics;
    EXPECT_EQ(parse(std::string(60'000, '*'), diagnostics), nullptr);
    EXPECT_EQ(parse(std::string(60'000, ')'), diagnostics), nullptr);
    EXPECT_EQ(diagnostics.n_errors(), 2 * kMaxErrorsPerExpression);
}

TEST(Parse, GarbageNeverCrashes) {
    static constexpr std::string_view kBytes =
        "CDSRTVLOBAc.'<>[]()^*+?{}|,0129 \n\\\"$\xD0\xA1\xFFx";
    std::mt19937 random(7);
    std::size_t n_good = 0;
    for (int i = 0; i < 50'000; ++i) {
        std::string text;
        for (std::size_t n = random() % 24; n > 0; --n)
            text += kBytes[random() % kBytes.size()];
        Diagnostics diagnostics;
        const Expr expr = parse(text, diagnostics);
        ASSERT_EQ(expr == nullptr, diagnostics.has_errors()) << text;
        if (!expr) continue;
        ++n_good;
        ASSERT_TRUE(equal(expr, must_parse(print(expr)))) << text;
    }
    EXPECT_GT(n_good, 100U);
}

TEST(Parse, TightAlternatives) {
    const auto tight = [](const char* text) {
        Diagnostics diagnostics;
        return print(parse(text, {}, diagnostics, {.binding = AlternationBinding::Tight}));
    };
    EXPECT_EQ(tight("CD|SL"), "C((D)|(S))L");
    EXPECT_EQ(tight("CDL|CSL"), "CD((L)|(C))SL");
    EXPECT_EQ(tight("CD*|S+|(VV)L"), "C((D*)|(S+)|(VV))L");
    EXPECT_EQ(tight("C(DL|VO)"), "C(D((L)|(V))O)");
    EXPECT_EQ(tight("(CDL)|(CVL)"), "((CDL)|(CVL))");
}

}  // namespace
}  // namespace lightsieve::lpe
