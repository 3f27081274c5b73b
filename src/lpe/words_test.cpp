#include "lpe/words.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "lpe/algebra.h"
#include "lpe/builtins.h"
#include "lpe/describe.h"
#include "lpe/predicate.h"
#include "lpe/print.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_parse;

Path path(std::string_view text) {
    Diagnostics diagnostics;
    const std::optional<Path> read = parse_path(text, diagnostics);
    EXPECT_TRUE(read) << diagnostics.render();
    return read.value_or(Path{});
}

std::string in_words(const std::string& text) {
    const Expr expr = must_parse(text);
    return expression_in_words(expr, EventNames(std::span(&expr, 1)));
}

TEST(Words, PathsAreToldEventByEvent) {
    EXPECT_EQ(
        path_in_words(path("C RS'coat' L'key'")),
        "a path that leaves the camera, is reflected by the coat, and ends at a light of group "
        "key");
    EXPECT_EQ(path_in_words(path("C L")), "a path that leaves the camera and ends at a light");
    EXPECT_EQ(path_in_words(path("C L"), true),
              "a path that leaves the camera and ends at a light of no group");
    EXPECT_EQ(
        path_in_words(path("C RD RD TS TS TS V O'fire'")),
        "a path that leaves the camera, is reflected diffusely twice, is refracted 3 times, is "
        "scattered in a volume, and ends at an emission labelled \"fire\"");
    EXPECT_EQ(
        path_in_words(path("C TD'hero' RS'coat''hero' B'sky'")),
        "a path that leaves the camera, is transmitted diffusely by something labelled "
        "\"hero\", is reflected by the coat and something labelled \"hero\", and ends in the "
        "background, a skydome of group sky");
    EXPECT_EQ(path_in_words(path("C RD A")),
              "a path that leaves the camera, is reflected diffusely, and ends as a probe of the "
              "albedo");
}

TEST(Words, ExpressionsAreToldClauseByClause) {
    const std::vector<std::pair<const char*, const char*>> cases{
        {"C.*", "paths that leave the camera and go on in any way"},
        {"CB", "paths that leave the camera and end in the background"},
        {"C[LO]", "paths that leave the camera and end at a light or at an emissive object"},
        {"C<RD>L", "paths that leave the camera, are reflected diffusely, and end at a light"},
        {"C<RS[^'coat''sheen']>.*",
         "paths that leave the camera, are reflected specularly but not by the coat or the sheen, "
         "and go on in any way"},
        {"C[DSV][DSVOB].*",
         "paths that leave the camera, are scattered, are scattered or end at an emissive object "
         "or "
         "in the background, and go on in any way (if they have not ended)"},
        {"((C<TD>A) (CVA) (C<RD>A))",
         "paths that leave the camera, are scattered diffusely or scattered in a volume, and end "
         "as "
         "a probe of the albedo"},
        {"C.*<L.'key'>",
         "paths that leave the camera, are scattered zero or more times, and end at a light of "
         "group key"},
        {"C<L.[^'key']>", "paths that leave the camera and end at a light but not of group key"},
        {"C<L.[^'default']>", "paths that leave the camera and end at a light of some group"},
        {"C<L.['key''rim']>",
         "paths that leave the camera and end at a light of group key or group rim"},
        {"CDDS?L",
         "paths that leave the camera, are scattered diffusely twice, are scattered specularly at "
         "most once, and end at a light"},
        {"C(DS){2,3}L",
         "paths that leave the camera, repeat 2 to 3 times: (are scattered diffusely and then are "
         "scattered specularly), and end at a light"},
        {"C[DSLO]*",
         "paths that leave the camera, are scattered by a surface zero or more times, and end at "
         "a "
         "light or at an emissive object"},
        {"C((DL)|(SO))",
         "paths that leave the camera and either are scattered diffusely and then end at a light "
         "or "
         "are scattered specularly and then end at an emissive object"},
        {"((CDL)|(CLC))",
         "paths that leave the camera, are scattered diffusely, and end at a light"},
        {"((CDL)|(CSVO))",
         "paths that leave the camera, are scattered diffusely, and end at a light; and paths "
         "that "
         "leave the camera, are scattered specularly, are scattered in a volume, and end at an "
         "emissive object"},
        {"CL.*", "paths that leave the camera and end at a light"},
        {"CTD", "no path"},
        {"LC", "no path"},
    };
    for (const auto& [text, words] : cases)
        EXPECT_EQ(in_words(text), words) << text;
}

TEST(Words, OurExtensionsHaveWordsToo) {
    EXPECT_EQ(in_words("!(CL)"), "all light but paths that leave the camera and end at a light");
    EXPECT_EQ(
        in_words("$emission - CL"),
        "what emission takes, but not paths that leave the camera and end at a light; emission "
        "takes paths that leave the camera and end at a light or at an emissive object");
    EXPECT_EQ(
        in_words("C.*L & CD.*"),
        "paths that leave the camera, are scattered zero or more times, and end at a light, if "
        "they are also paths that leave the camera, are scattered diffusely, and go on in any "
        "way");
    EXPECT_EQ(
        in_words("C(D+ - (DD))L"),
        "paths that leave the camera, are scattered diffusely one or more times (but not if they "
        "are scattered diffusely twice), and end at a light");
}

TEST(Words, LongExpressionsEndInTheNotation) {
    std::string text = "C";
    for (int i = 0; i < 300; ++i)
        text += i % 2 == 0 ? "D" : "S";
    const std::string words = in_words(text + "L");
    EXPECT_NE(words.find("go on as `"), std::string::npos);
    EXPECT_LT(words.size(), std::size_t{20'000});
}

TEST(Words, NestedRepeatsAreReadOnce) {
    std::string text = "D";
    for (int i = 0; i < 100; ++i)
        text = "((" + text + ")*S)";
    EXPECT_FALSE(in_words("C" + text + "L").empty());
}

TEST(EventNames, SetsAreNamedByWhatIsInThem) {
    const std::vector<std::pair<const char*, const char*>> cases{
        {"D", "D"},
        {"[DS]", "D S"},
        {"<[RT].>", "D S"},
        {"[^LOB]", "any scattering"},
        {"[LOB]", "any light"},
        {".", "any scattering, any light"},
        {"<RS[^'coat']>", "RS except coat"},
        {"<RS'coat'>", "RS'coat'"},
        {"<L.'key'>", "L'key'"},
        {"<[LO].>", "L O"},
        {"<RS'coat''hero'>", "RS'coat''hero'"},
    };
    for (const auto& [text, label] : cases) {
        const Expr test = must_parse(text);
        const EventNames names(std::span(&test, 1));
        EventSet set;
        for (const Event& event : names.events())
            set.push_back(takes(*test, event));
        EXPECT_EQ(names.label(set), label) << text;
    }
}

TEST(EventNames, OfAFewEventsOnlyNeedNoMoreWordsThanTheyTellApart) {
    const EventNames names(std::vector<Event>{{EventKind::Reflection, EventLobe::Diffuse, {}},
                                              {EventKind::Reflection, EventLobe::Specular, {}},
                                              {EventKind::Light, EventLobe::None, {"key"}},
                                              {EventKind::Light, EventLobe::None, {"rim"}}});
    EXPECT_EQ(names.label({true, true, false, false}), "R");
    EXPECT_EQ(names.label({true, false, true, true}), "RD, L");
    EXPECT_EQ(names.ends({false, false, false, true}), "at a light of group rim");
    EXPECT_EQ(names.label({false, false, false, false}), "");
}

TEST(Words, EveryBuiltinHasWords) {
    const ExpressionTable table;
    for (const Builtin& row : builtins()) {
        const Expr expr = table.find(row.name)->expr;
        const std::string words = expression_in_words(expr, EventNames(std::span(&expr, 1)));
        EXPECT_TRUE(words.starts_with("paths that leave the camera")) << row.name << ": " << words;
        EXPECT_EQ(words.find('`'), std::string::npos) << row.name;
    }
}

TEST(EventNames, DifferentSetsHaveDifferentNames) {
    const std::vector<Expr> exprs{must_parse("<RS'coat'>"), must_parse("'hero'"),
                                  must_parse("<L.'key'>"), must_parse("<L.'default'>")};
    const EventNames names{std::span<const Expr>(exprs)};
    std::map<std::string, EventSet> by_label, by_doings;
    const auto check = [](std::map<std::string, EventSet>& seen, const std::string& text,
                          const EventSet& set) {
        const auto [entry, is_new] = seen.try_emplace(text, set);
        EXPECT_TRUE(is_new || entry->second == set) << text;
    };
    // Sets of whole kinds and of labels within a kind, as tests of events make them, and any.
    std::mt19937 random(7);
    for (int i = 0; i < 20'000; ++i) {
        EventSet set(names.events().size());
        const auto kinds = random(), labels = random();
        for (std::size_t e = 0; e < set.size(); ++e) {
            const Event& event = names.events()[e];
            const auto kind =
                static_cast<unsigned>(event.kind) * 3 + static_cast<unsigned>(event.lobe);
            set[e] = (kinds >> (kind % 32) & 1U) != 0;
            if (i % 3 == 1 && !event.labels.empty())
                set[e] = set[e] && (labels >> (event.labels[0].size() % 32) & 1U) != 0;
            if (i % 3 == 2) set[e] = set[e] && (random() & 1U) != 0;
        }
        check(by_label, names.label(set), set);
        check(by_doings, names.doings(set), set);
    }
    EXPECT_GT(by_label.size(), std::size_t{5'000});
}

TEST(Words, RandomExpressionsAreToldWithoutEnd) {
    std::mt19937 random(11);
    for (int i = 0; i < 2'000; ++i) {
        const Expr expr = i % 2 == 0 ? testing::random_light_expression(random, 12)
                                     : testing::random_extended_expression(random, 12);
        const std::string words = expression_in_words(expr, EventNames(std::span(&expr, 1)));
        EXPECT_FALSE(words.empty());
        EXPECT_LT(words.size(), std::size_t{30'000});
        EXPECT_TRUE(words != "no path" || !shortest_path(expr)) << print(expr);
    }
}

}  // namespace
}  // namespace lightsieve::lpe
