// Proofs: what the reference page promises about the built-ins, over all paths; and that faults
// are found.
#include "lpe/algebra.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "lpe/builtins.h"
#include "lpe/print.h"
#include "lpe/program.h"
#include "lpe/testing/generate.h"
#include "lpe/testing/naive_matcher.h"

namespace lightsieve::lpe {
namespace {

using testing::must_parse;
using Fault = PartitionReport::Fault;

std::vector<Expr> parse_all(const std::vector<std::string>& texts) {
    std::vector<Expr> out;
    for (const std::string& text : texts)
        out.push_back(must_parse(text));
    return out;
}

PartitionReport partition(BuiltinTable table, const std::vector<std::string_view>& names) {
    const ExpressionTable expressions(table);
    std::vector<Expr> parts;
    for (const std::string_view name : names)
        parts.push_back(expressions.find(name)->expr);
    return check_partition(expressions.find("RGBA")->expr, parts);
}

/// "" if it holds, else the fault and its witness.
std::string verdict(const PartitionReport& report) {
    switch (report.fault) {
        case Fault::None: return "";
        case Fault::Lost: return "lost " + print_path(report.witness);
        case Fault::Twice:
            return "twice " + std::to_string(report.first) + " " + std::to_string(report.second) +
                   " " + print_path(report.witness);
        case Fault::Outside: return "outside " + print_path(report.witness);
    }
    return "";
}

// ---- what the reference page says about the built-ins ----

TEST(Proof, AdditiveSetsTakeEveryPathOnce) {
    for (const BuiltinTable table : {BuiltinTable::Reference, BuiltinTable::Arnold7})
        for (const auto& set : additive_sets(table))
            EXPECT_EQ(verdict(partition(table, set)), "");
    EXPECT_EQ(additive_sets(BuiltinTable::Reference).size(), 3U);
}

TEST(Proof, Arnold7NeedsSheenInTheSecondAndThirdSetOnly) {
    const auto reference_sets = additive_sets(BuiltinTable::Reference);
    EXPECT_EQ(verdict(partition(BuiltinTable::Arnold7, reference_sets[0])), "");
    EXPECT_EQ(verdict(partition(BuiltinTable::Arnold7, reference_sets[1])), "lost C RS'sheen' L");
    EXPECT_EQ(verdict(partition(BuiltinTable::Arnold7, reference_sets[2])), "lost C RS'sheen' L");
}

TEST(Proof, ReferenceSetsHaveSheenAlready) {
    const auto arnold7_sets = additive_sets(BuiltinTable::Arnold7);
    // sheen is number 8 and 10 of its set, specular 1, specular_direct 2.
    EXPECT_EQ(verdict(partition(BuiltinTable::Reference, arnold7_sets[1])),
              "twice 1 8 C RS'sheen' L");
    EXPECT_EQ(verdict(partition(BuiltinTable::Reference, arnold7_sets[2])),
              "twice 2 10 C RS'sheen' L");
}

TEST(Proof, EveryLobeIsItsDirectAndItsIndirectLight) {
    for (const BuiltinTable table : {BuiltinTable::Reference, BuiltinTable::Arnold7}) {
        const ExpressionTable expressions(table);
        for (const char* name :
             {"diffuse", "specular", "coat", "sheen", "transmission", "sss", "volume"}) {
            const auto find = [&](const char* suffix) {
                return expressions.find(std::string(name) + suffix)->expr;
            };
            const std::vector<Expr> parts{find("_direct"), find("_indirect")};
            EXPECT_EQ(verdict(check_partition(find(""), parts)), "") << name;
        }
    }
}

TEST(Proof, AlbedosAreProbesAndAllElseIsLight) {
    const ExpressionTable expressions;
    for (const Builtin& row : builtins()) {
        const Expr expr = expressions.find(row.name)->expr;
        const bool albedo = row.name.find("albedo") != std::string_view::npos;
        EXPECT_EQ(takes_probe(expr), albedo) << row.name;
        EXPECT_EQ(takes_light(expr), !albedo) << row.name;
    }
}

/// Every state that a path can reach, every terminal: a path of the whole is in one group, a probe
/// in none.
void prove_groups_partition(const Expr& expr, const std::vector<Event>& events) {
    // The scene's groups are those of its lights.
    std::set<std::string> groups;
    for (const Event& event : events)
        if (event.kind == EventKind::Light || event.kind == EventKind::Background)
            groups.insert(event.labels.begin(), event.labels.end());
    groups.erase("default");
    EXPECT_GE(groups.size(), 2U);
    std::vector<AovRequest> aovs{{"all", expr, GroupSelect::All},
                                 {"rest", expr, GroupSelect::Default}};
    for (const std::string& group : groups)
        aovs.push_back({group, expr, GroupSelect::Named, group});
    Diagnostics diagnostics;
    const Program program = Program::compile(aovs, events, {}, diagnostics);
    ASSERT_TRUE(diagnostics.items().empty());
    const Automaton& a = program.automaton(0);
    for (std::size_t s = 0; s < a.n_states(); ++s)
        for (std::uint32_t t = 0; t < program.n_terminals(); ++t) {
            const TerminalId terminal = program.first_terminal() + t;
            const AtomId atom = a.atom(a.state(s), terminal);
            if (atom == kNoAtom) continue;
            const std::span<const std::uint32_t> taken = program.aovs_of(atom);
            const bool probe = program.example(terminal).kind == EventKind::Albedo;
            EXPECT_EQ(taken[0], 0U);
            EXPECT_EQ(taken.size(), probe ? 1U : 2U) << print(expr);
        }
}

TEST(Proof, LightGroupsPartitionEveryExpression) {
    std::vector<Expr> exprs = parse_all(
        {"C.*<L.'key'>", "C.*<L.[^'key']>", "CDS.*", "C'key'.*", "C.*[LO]", "C[DSV][LA]"});
    const ExpressionTable expressions;
    for (const Builtin& row : builtins())
        exprs.push_back(expressions.find(row.name)->expr);
    // The groups must be among the abstract events, also where no expression names them.
    exprs.push_back(must_parse("C.*<[LB].['key''fill']>"));
    exprs.push_back(must_parse("C.*<[LB].'key'>"));
    const std::vector<Event> events = abstract_events(exprs);
    for (const Expr& expr : exprs)
        prove_groups_partition(expr, events);
}

// ---- faults are found, with a shortest witness ----

TEST(Partition, FaultsHaveShortestWitnesses) {
    const auto check = [](const char* whole, const std::vector<std::string>& parts) {
        return verdict(check_partition(must_parse(whole), parse_all(parts)));
    };
    EXPECT_EQ(check("C.*", {"C.*L", "C.*O"}), "lost C B");
    EXPECT_EQ(check("C.*", {"C.*L", "C.*O", "C.*[BO]"}), "twice 1 2 C O");
    EXPECT_EQ(check("C.*L", {"C.*"}), "outside C O");
    EXPECT_EQ(check("C.*L", {"CL", "C..*L"}), "");
    EXPECT_EQ(check("C.*", {"C[^D]*[LOB]", "C.*D.*"}), "");
    EXPECT_EQ(check("C.*", {"C[^D]*[LOB]", "C.*D.*D.*"}), "lost C RD L");
    EXPECT_EQ(check("C.*", {"C<[LB].'key'>", "C<[LB].[^'key']>", "CO"}), "lost C RD L");
    EXPECT_EQ(check("C.*", {"C.*<[LB].'key'>", "C.*<[LB].[^'key']>", "C.*O"}), "");
    EXPECT_EQ(check("CDL", {}), "lost C RD L");
    EXPECT_EQ(check("C.*", {"C.*", "C[DSV]A"}), "outside C RD A");
}

TEST(Algebra, ShortestPaths) {
    const auto shortest = [](const char* text) {
        const std::optional<Path> path = shortest_path(must_parse(text));
        return path ? print_path(*path) : "none";
    };
    EXPECT_EQ(shortest("C.*"), "C L");
    EXPECT_EQ(shortest("C.{3,}B"), "C RD RD RD B");
    EXPECT_EQ(shortest("C<RS'coat'[^'hero']>+V*O"), "C RS'coat' O");
    EXPECT_EQ(shortest("C<RS'coat''hero'>L"), "C RS'coat''hero' L");
    EXPECT_EQ(shortest("C<RS'coat''sheen'>L"), "none");  // neither can be an object's label
    EXPECT_EQ(shortest("C<L.'a''b'>"), "none");          // a light is in one group
    EXPECT_EQ(shortest("C<L.'default'>"), "C L");
    EXPECT_EQ(shortest("C<L.[^'default']>"), "C L'group1'");
    EXPECT_EQ(shortest("C.*A"), "C RD A");
    EXPECT_EQ(shortest("CA"), "none");
    EXPECT_EQ(shortest("CDLL"), "none");
    EXPECT_EQ(shortest(".*"), "none");
    const std::vector<Event> events = testing::must_events("RS O");
    EXPECT_EQ(print_path(*shortest_path(must_parse("C.+O"), events)), "C RS O");
    EXPECT_EQ(shortest_path(must_parse("C.*L"), events), std::nullopt);
    EXPECT_EQ(shortest_path(Expr{}), std::nullopt);
}

TEST(Algebra, Comparisons) {
    const auto same = [](const char* a, const char* b) {
        return equivalent(must_parse(a), must_parse(b));
    };
    EXPECT_TRUE(same("((C<TD>A) (CVA) (C<RD>A))", "((C<TD>A)|(CVA)|(C<RD>A))"));
    EXPECT_TRUE(same("C[^LOB]*[LOB]", "C.*"));
    EXPECT_TRUE(same("C(D|S)*L", "C[DS]*L"));
    EXPECT_TRUE(same("C<R>L", "C<R.>L"));
    EXPECT_TRUE(same("C<.D>L", "CDL"));
    EXPECT_FALSE(same("C[^D]L", "C[SV]L") && !same("C[^D]L", "C[SV]L"));
    EXPECT_TRUE(same("C[^D]L", "C[SV]L"));
    EXPECT_FALSE(same("C<RS>L", "CSL"));
    const auto outside = [](const char* a, const char* b) {
        const std::optional<Path> path = shortest_path_outside(must_parse(a), must_parse(b));
        return path ? print_path(*path) : "";
    };
    EXPECT_EQ(outside("CDL", "C.*"), "");
    EXPECT_EQ(outside("C.*", "CDL"), "C L");
    EXPECT_EQ(outside("C'x'L", "C<.D>L"), "C RS'x' L");
    EXPECT_EQ(print_path(*shortest_common_path(must_parse("C.*D.*"), must_parse("CS.*"))),
              "C RS RD L");
    EXPECT_EQ(shortest_common_path(must_parse("C<RS'coat'>.*"), must_parse("C<RS[^'coat']>.*")),
              std::nullopt);
}

TEST(Algebra, AgreesWithTheNaiveMatcherOnEveryShortPath) {
    std::mt19937 random(17);
    for (int i = 0; i < 150; ++i) {
        const std::vector<Expr> pair{testing::random_light_expression(random, 1 + random() % 5),
                                     testing::random_light_expression(random, 1 + random() % 5)};
        const std::vector<Event> events = abstract_events(pair);
        std::optional<Path> first_common, first_outside;
        for (const Path& path : testing::all_paths(events, 3)) {
            const bool a = testing::naive_match(pair[0], path),
                       b = testing::naive_match(pair[1], path);
            if (a && b && !first_common) first_common = path;
            if (a && !b && !first_outside) first_outside = path;
        }
        // A witness is taken as claimed; up to this length it is a shortest one, and none is
        // missed.
        const auto check = [&](const std::optional<Path>& found, const std::optional<Path>& brute,
                               bool in_b) {
            EXPECT_TRUE(found || !brute) << print(pair[0]) << " " << print(pair[1]);
            if (!found) return;
            EXPECT_TRUE(testing::naive_match(pair[0], *found));
            EXPECT_EQ(testing::naive_match(pair[1], *found), in_b);
            EXPECT_TRUE(found->size() > 3 || (brute && brute->size() == found->size()));
        };
        check(shortest_common_path(pair[0], pair[1]), first_common, true);
        check(shortest_path_outside(pair[0], pair[1]), first_outside, false);
    }
}

TEST(Algebra, LabelsThatAreAlikeAreOne) {
    std::string text = "C<RS[^";
    for (int i = 0; i < 1000; ++i)
        text += "'l" + std::to_string(i) + "'";
    // A thousand labels in one test: one class.
    EXPECT_EQ(print_path(*shortest_path(must_parse(text + "]>L"))), "C RS L");
    EXPECT_LT(abstract_events(parse_all({text + "]>L"})).size(), 40U);
}

TEST(Algebra, ManyLightGroupsAreFew) {
    std::vector<Expr> parts{must_parse("C.*O"), must_parse("C.*<[LB].'g0'>")};
    std::string others = "'g0'";
    for (int i = 1; i < 200; ++i) {
        parts.push_back(must_parse("C.*<[LB].'g" + std::to_string(i) + "'>"));
        others += "'g" + std::to_string(i) + "'";
    }
    EXPECT_EQ(verdict(check_partition(must_parse("C.*"), parts)), "lost C L");
    parts.push_back(must_parse("C.*<[LB].[^" + others + "]>"));
    EXPECT_EQ(verdict(check_partition(must_parse("C.*"), parts)), "");
}

TEST(Algebra, TooManyLabelsIsALimit) {
    std::string text = "C";
    for (int i = 0; i < 300; ++i)
        text += "'l" + std::to_string(i) + "'";
    try {
        (void)shortest_path(must_parse(text + "L"));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.errors()[0].code, Code::LimitLpeLabels);
    }
}

TEST(Algebra, AProofThatExplodesIsALimit) {
    try {
        (void)equivalent(must_parse("C.*D.{20}L"), must_parse("C.*D.{20}LL?"));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.errors()[0].code, Code::LimitLpeSteps);
        EXPECT_EQ(error.errors()[0].message, "the proof needs more than 5000000 derivative steps");
        EXPECT_EQ(error.errors()[0].hint, "the limit is max_steps");
    }
}

}  // namespace
}  // namespace lightsieve::lpe
