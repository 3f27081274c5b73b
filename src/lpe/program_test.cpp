// The compiled program: atoms, light groups, live states, budgets, sets that have to be split.
#include "lpe/program.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "lpe/builtins.h"
#include "lpe/dump.h"
#include "lpe/light_groups.h"
#include "lpe/lint.h"
#include "lpe/parse.h"
#include "lpe/path.h"
#include "lpe/print.h"
#include "lpe/testing/generate.h"
#include "lpe/testing/naive_matcher.h"

namespace lightsieve::lpe {
namespace {

using testing::must_events;
using testing::must_parse;
using testing::must_path;

/// AOVs "EXPR", "EXPR @group" or "EXPR @default".
std::vector<AovRequest> requests(const std::vector<std::string>& texts) {
    std::vector<AovRequest> out;
    for (const std::string& text : texts) {
        const std::size_t at = text.find(" @");
        AovRequest request{text, must_parse(text.substr(0, at))};
        if (at != std::string::npos) {
            request.group = text.substr(at + 2);
            request.select =
                request.group == "default" ? GroupSelect::Default : GroupSelect::Named;
        }
        out.push_back(std::move(request));
    }
    return out;
}

Program compile(const std::vector<AovRequest>& aovs, const std::vector<Event>& events,
                const Limits& limits = {}) {
    Diagnostics diagnostics;
    Program program = Program::compile(aovs, events, limits, diagnostics);
    EXPECT_TRUE(diagnostics.items().empty()) << diagnostics.render();
    return program;
}

/// The AOVs that take the path, by running the program.
std::set<std::uint32_t> aovs_of(const Program& program, const Path& path) {
    std::set<std::uint32_t> out;
    for (std::size_t i = 0; i < program.n_automata(); ++i) {
        const Automaton& automaton = program.automaton(i);
        State state = automaton.start();
        for (std::size_t e = 1; e + 1 < path.size(); ++e)
            state = automaton.step(state, program.scatter_class(path[e]));
        const AtomId atom = automaton.atom(state, program.terminal(path.back()));
        if (atom == kNoAtom) continue;
        for (const std::uint32_t aov : program.aovs_of(atom))
            EXPECT_TRUE(out.insert(aov).second);
    }
    return out;
}

/// The same from the definitions: the naive matcher, and what a request's group means.
std::set<std::uint32_t> expected_aovs(const std::vector<AovRequest>& aovs, const Path& path) {
    std::set<std::uint32_t> out;
    const Event& end = path.back();
    const bool has_group = end.kind == EventKind::Light || end.kind == EventKind::Background;
    const std::string group = has_group && !end.labels.empty() ? end.labels[0] : "default";
    for (std::uint32_t i = 0; i < aovs.size(); ++i) {
        const AovRequest& aov = aovs[i];
        if (!testing::naive_match(aov.expr, path)) continue;
        const bool probe = end.kind == EventKind::Albedo;
        const std::string wanted = aov.select == GroupSelect::Default ? "default" : aov.group;
        if (aov.select == GroupSelect::All || (!probe && group == wanted)) out.insert(i);
    }
    return out;
}

TEST(Program, DumpOfASmallOne) {
    const std::vector<AovRequest> aovs = requests({"C.*", "CDL", "CDL @key", "C.*A"});
    const Program program = compile(aovs, must_events("RD RS V L L'key' O A"));
    EXPECT_EQ(dump(program),
              "4 AOVs, 4 atoms, 2 classes, 4 terminals\n"
              "automaton 0\n"
              "  state 0\n"
              "    RD->0 RS->0\n"
              "  state 1 start light probe\n"
              "    RD->2 RS->3\n"
              "    L: atom 0 AOVs {0}\n"
              "    L'key': atom 0 AOVs {0}\n"
              "    O: atom 0 AOVs {0}\n"
              "    A: atom 1 AOVs {3}\n"
              "  state 2 light probe\n"
              "    RD->3 RS->3\n"
              "    L: atom 2 AOVs {0 1}\n"
              "    L'key': atom 3 AOVs {0 1 2}\n"
              "    O: atom 0 AOVs {0}\n"
              "    A: atom 1 AOVs {3}\n"
              "  state 3 light probe\n"
              "    RD->3 RS->3\n"
              "    L: atom 0 AOVs {0}\n"
              "    L'key': atom 0 AOVs {0}\n"
              "    O: atom 0 AOVs {0}\n"
              "    A: atom 1 AOVs {3}\n");
}

TEST(Program, WithoutAovsThereIsNothingToStep) {
    const Program program = compile({}, must_events("RD L"));
    EXPECT_EQ(program.n_automata(), 0U);
    EXPECT_EQ(program.n_atoms(), 0U);
}

TEST(Program, NullExpressionsAreBlack) {
    std::vector<AovRequest> aovs = requests({"C.*", "CL"});
    aovs[0].expr = nullptr;
    const Program program = compile(aovs, must_events("RD L O"));
    EXPECT_EQ(aovs_of(program, must_path("C L")), (std::set<std::uint32_t>{1}));
    EXPECT_EQ(aovs_of(program, must_path("C O")), (std::set<std::uint32_t>{}));
}

TEST(Program, GroupsAreThoseOfTheTerminal) {
    const std::vector<AovRequest> aovs =
        requests({"C.*", "C.* @key", "C.* @default", "C.*A", "C.*A @default", "C.*A @key"});
    const Program program =
        compile(aovs, must_events("RD RD'key' L L'key' L'fill' O O'key' B B'key' B'default' A"));
    const auto taken = [&](const char* path) { return aovs_of(program, must_path(path)); };
    using Set = std::set<std::uint32_t>;
    EXPECT_EQ(taken("C RD L"), (Set{0, 2}));
    EXPECT_EQ(taken("C RD L'key'"), (Set{0, 1}));
    EXPECT_EQ(taken("C RD L'fill'"), (Set{0}));  // a group that no AOV asks for
    EXPECT_EQ(taken("C RD'key' L"), (Set{0, 2}));
    EXPECT_EQ(taken("C O"), (Set{0, 2}));
    EXPECT_EQ(taken("C O'key'"), (Set{0, 2}));  // a label of emission is no group
    EXPECT_EQ(taken("C B"), (Set{0, 2}));
    EXPECT_EQ(taken("C B'key'"), (Set{0, 1}));
    EXPECT_EQ(taken("C B'default'"), (Set{0, 2}));
    EXPECT_EQ(taken("C RD A"), (Set{3}));  // probes are in no group
}

TEST(Program, LightAndProbesLiveApart) {
    const Program program = compile(requests({"CDL", "CDDA", "CSA"}), must_events("RD RS V L A"));
    const Automaton& a = program.automaton(0);
    const auto after = [&](std::initializer_list<const char*> events) {
        State state = a.start();
        for (const char* event : events)
            state = a.step(state, program.scatter_class(must_events(event)[0]));
        return std::pair{a.live_light(state), a.live_probe(state)};
    };
    EXPECT_EQ(after({}), std::pair(true, true));
    EXPECT_EQ(after({"RD"}), std::pair(true, true));
    EXPECT_EQ(after({"RD", "RD"}), std::pair(false, true));
    EXPECT_EQ(after({"RS"}), std::pair(false, true));
    EXPECT_EQ(after({"V"}), std::pair(false, false));
    EXPECT_EQ(a.step(a.start(), program.scatter_class(must_events("V")[0])), kDead);
    EXPECT_EQ(a.step(kDead, program.scatter_class(must_events("RD")[0])), kDead);
}

TEST(Program, LiveAovsAreThoseThatSomePathStillReaches) {
    std::mt19937 random(21);
    const std::vector<Event> events = must_events("RD RD'a' RS'coat' TD V L L'key' O'a' B A");
    for (int i = 0; i < 40; ++i) {
        std::vector<AovRequest> aovs;
        for (int j = 0; j < 70; ++j)  // more than one word of the bit set
            aovs.push_back({"x", testing::random_light_expression(random, 1 + random() % 4),
                            j % 3 == 0 ? GroupSelect::Named : GroupSelect::All, "key"});
        const Program program = compile(aovs, events);
        const Automaton& a = program.automaton(0);
        // By definition: walk everything that can be reached from the state.
        for (std::size_t s = 0; s < a.n_states(); ++s) {
            std::set<State> seen{a.state(s)};
            std::vector<State> open{a.state(s)};
            std::set<std::uint32_t> reached;
            bool light = false, probe = false;
            while (!open.empty()) {
                const State state = open.back();
                open.pop_back();
                for (std::uint32_t t = 0; t < program.n_terminals(); ++t) {
                    const TerminalId terminal = program.first_terminal() + t;
                    const AtomId atom = a.atom(state, terminal);
                    if (atom == kNoAtom) continue;
                    const bool is_probe = program.example(terminal).kind == EventKind::Albedo;
                    (is_probe ? probe : light) = true;
                    for (const std::uint32_t aov : program.aovs_of(atom))
                        reached.insert(aov);
                }
                for (ClassId c = Program::kFirstClass; c < program.first_terminal(); ++c)
                    if (seen.insert(a.step(state, c)).second) open.push_back(a.step(state, c));
            }
            ASSERT_EQ(a.live_light(a.state(s)), light);
            ASSERT_EQ(a.live_probe(a.state(s)), probe);
            for (std::uint32_t aov = 0; aov < aovs.size(); ++aov)
                ASSERT_EQ(a.live_aov(a.state(s), aov), reached.contains(aov));
        }
    }
}

/// Random sets with groups: every path must go to exactly the AOVs that the definitions say.
void check_random_sets(const Limits& limits, std::size_t n_sets,
                       const std::vector<std::string>& more, std::size_t& n_automata) {
    std::mt19937 random(31);
    const std::vector<Event> events =
        must_events("RD RD'a' RS RS'coat' TD TS'b' V L L'key' L'fill' O O'a' B B'key' A");
    const std::vector<std::string> groups{"key", "fill", "none", "default"};
    for (std::size_t i = 0; i < n_sets; ++i) {
        std::vector<AovRequest> aovs = requests(more);
        for (int j = 0; j < 6; ++j) {
            const Expr expr = testing::random_light_expression(random, 1 + random() % 6);
            for (int k = 0; k < 2; ++k) {
                const auto select = static_cast<GroupSelect>(random() % 3);
                const std::string group =
                    select == GroupSelect::Named ? groups[random() % groups.size()] : "";
                aovs.push_back({print(expr), expr, select, group});
            }
        }
        const Program program = compile(aovs, events, limits);
        n_automata += program.n_automata();
        for (int j = 0; j < 100; ++j) {
            const Path path = testing::random_path(random, events, 6);
            ASSERT_EQ(aovs_of(program, path), expected_aovs(aovs, path)) << print_path(path);
        }
    }
}

TEST(Program, RandomSetsGoWhereTheDefinitionsSay) {
    std::size_t n_automata = 0;
    check_random_sets({}, 150, {}, n_automata);
    EXPECT_EQ(n_automata, 150U);
}

TEST(Program, SetsThatAreSplitGoToTheSameAovs) {
    Limits limits;
    limits.max_states = 40;
    std::size_t n_automata = 0;
    check_random_sets(limits, 60, {"C.*D.{2}L @key", "C.*S.{3}.", "C.*V.{3}O @default"},
                      n_automata);
    EXPECT_GE(n_automata, 120U);
}

TEST(Program, EqualAovsAreOneAtomAndAtomsAreDisjoint) {
    const Program program =
        compile(requests({"CDL", "C(D)L", "C<.D>L", "C[DS]L"}), must_events("RD TD RS L O"));
    // D paths go to all four, S paths to the last one.
    EXPECT_EQ(program.n_atoms(), 2U);
    EXPECT_TRUE(program.film_stores_atoms());
    // Two AOVs that overlap make three atoms.
    EXPECT_FALSE(
        compile(requests({"C[DS]L", "C[SV]L"}), must_events("RD RS V L")).film_stores_atoms());
}

/// Every AOV that the built-ins and `n_groups` groups make, and the events of a scene that has all
/// lobes.
struct BuiltinSet {
    std::vector<AovRequest> aovs;
    std::vector<Event> events = must_events("RD RS RS'coat' RS'sheen' RS'hair' TD TS V L O B A");

    explicit BuiltinSet(std::size_t n_groups) {
        const ExpressionTable table;
        std::vector<std::string> groups;
        for (std::size_t g = 0; g < n_groups; ++g)
            groups.push_back("group" + std::to_string(g));
        Diagnostics diagnostics;
        for (const Builtin& row : builtins()) {
            const std::string name(row.name);
            for (const char* suffix : {"", "_*"}) {
                const bool albedo = row.expression.find('A') != std::string_view::npos;
                if (*suffix != '\0' && (n_groups == 0 || albedo)) continue;
                const OutputName output{name + suffix, "", "d", {}};
                for (const LpeLayer& layer :
                     resolve_output(output, {table, groups, {}}, diagnostics).layers)
                    aovs.push_back(layer.request());
            }
        }
        EXPECT_TRUE(diagnostics.items().empty()) << diagnostics.render();
        for (const std::string& group : groups) {
            events.push_back({EventKind::Light, EventLobe::None, {group}});
            events.push_back({EventKind::Background, EventLobe::None, {group}});
        }
    }
};

TEST(Program, GroupsDoNotMultiplyStates) {
    const auto sizes = [](std::size_t n_groups) {
        const BuiltinSet set(n_groups);
        const Program program = compile(set.aovs, set.events);
        EXPECT_EQ(program.n_automata(), 1U);
        return std::pair{program.automaton(0).n_inner_states(), program.n_atoms()};
    };
    // The start, and for each of RD, RS, coat, sheen, TD, TS, V: just after it, and later.
    EXPECT_EQ(sizes(0), std::pair(std::size_t{15}, std::size_t{23}));
    EXPECT_EQ(sizes(8), std::pair(std::size_t{15}, std::size_t{151}));
    EXPECT_EQ(sizes(64), std::pair(std::size_t{15}, std::size_t{1047}));
}

// ---- budgets ----

std::string compile_errors(const std::vector<AovRequest>& aovs, const std::vector<Event>& events,
                           const Limits& limits = {}) {
    Diagnostics diagnostics;
    (void)Program::compile(aovs, events, limits, diagnostics);
    return diagnostics.render();
}

TEST(Budget, ExplosionsAreClearErrors) {
    const std::vector<Event> events = must_events("RD RS V L O A");
    EXPECT_EQ(compile_errors(requests({"C.*D.{20}L"}), events),
              "<expression>:1:5: error[limit-lpe-states]: AOV \"C.*D.{20}L\": its automaton needs "
              "more than 100000 states\n"
              "    1 | C.*D.{20}L\n"
              "      |     ^~~~~\n"
              "  hint: \".{20}\" is what explodes; the limit is max_states\n");
    const std::string nested = compile_errors(requests({"C(((D?){16}){16}){16}L"}), events);
    EXPECT_TRUE(nested.find("limit-lpe-") != std::string::npos) << nested;
    EXPECT_TRUE(nested.find("\"(((D?){16}){16}){16}\" is what explodes") != std::string::npos)
        << nested;
}

TEST(Budget, HostileExtensionsEndSoon) {
    const std::vector<Event> events = must_events("RD RS V L O A");
    std::string met = "C.*D.{3}.*", nested = "CD.*", growing = "C.*D.{4}L";
    for (int i = 4; i < 40; ++i)
        met += " & C.*D.{" + std::to_string(i) + "}S.*";
    for (int i = 0; i < 200; ++i)
        nested = "!(" + nested + ")";
    for (int i = 0; i < 60; ++i)
        growing = "(" + growing + (i % 2 == 0 ? " & " : " - ") + "C(.*S.{" + std::to_string(i) +
                  "})*.*)";
    for (const std::string& text : {met, std::string("!(C.*D.{20}L) - C.*S.{19}L"), growing}) {
        Diagnostics diagnostics;
        const Expr expr = parse(text, diagnostics);
        ASSERT_TRUE(expr) << diagnostics.render();
        (void)Program::compile(std::vector<AovRequest>{{"x", expr}}, events, {}, diagnostics);
        ASSERT_LE(diagnostics.items().size(), 1U);
        for (const Error& error : diagnostics.items())
            EXPECT_TRUE(code_text(error.code).starts_with("limit-lpe-")) << error.message;
    }
    // Deep alone is no reason to refuse.
    EXPECT_EQ(compile_errors(requests({nested}), events), "");
}

TEST(Budget, AThousandExpressionsAreSplitWithinTheLimits) {
    std::mt19937 random(7);
    const std::vector<Event> events = must_events("RD RS RS'coat' TD TS V L L'key' O B A");
    std::vector<AovRequest> aovs;
    for (int i = 0; i < 1000; ++i)
        aovs.push_back({"aov" + std::to_string(i),
                        testing::random_light_expression(random, 4 + random() % 12)});
    Limits limits;
    limits.max_states = 4'000;
    limits.max_steps = 500'000;
    Diagnostics diagnostics;
    const Program program = Program::compile(aovs, events, limits, diagnostics);
    EXPECT_GT(program.n_automata(), 1U);
    EXPECT_LE(program.n_automata(), limits.max_automata);
    for (std::size_t i = 0; i < program.n_automata(); ++i)
        EXPECT_LE(program.automaton(i).n_states(), limits.max_states);
    // Those that are refused are named; few are.
    EXPECT_LT(diagnostics.n_errors(), 100U);
    for (const Error& error : diagnostics.items())
        EXPECT_TRUE(code_text(error.code).starts_with("limit-lpe-")) << error.message;
}

TEST(Budget, HostileTextsEndSoon) {
    const auto repeated = [](const std::string& text, int n) {
        std::string out;
        for (int i = 0; i < n; ++i)
            out += text;
        return out;
    };
    const std::vector<Event> events = must_events("RD RS V L O A");
    for (const std::string& text : {"C" + repeated("D?", 30'000) + "L",
                                    "C" + repeated("(", 250) + "D" + repeated("){256}", 250) + "L",
                                    "C" + repeated(".*D", 20'000) + "L"}) {
        Diagnostics diagnostics;
        const Expr expr = parse(text, diagnostics);
        lint_expression(text, {}, "x", expr, diagnostics);
        lint_in_scene(expr, "x", events, diagnostics);
        EXPECT_TRUE(diagnostics.items().empty()) << diagnostics.render();
        const std::vector<AovRequest> aovs{{"x", expr}};
        (void)Program::compile(aovs, events, {}, diagnostics);
        ASSERT_EQ(diagnostics.items().size(), 1U);
        EXPECT_TRUE(code_text(diagnostics.items()[0].code).starts_with("limit-lpe-"));
    }
    // Long alone is no reason to refuse.
    EXPECT_EQ(compile_errors(requests({"C" + repeated(".", 60'000) + "L"}), events), "");
    EXPECT_EQ(compile_errors(requests({"C(" + repeated("DS|", 20'000) + "S)L"}), events), "");
}

TEST(Budget, EachIsNamed) {
    const std::vector<Event> events = must_events("RD RS V L O A");
    const auto code = [&](const Limits& limits) {
        Diagnostics diagnostics;
        (void)Program::compile(requests({"C.*D.{8}L"}), events, limits, diagnostics);
        return diagnostics.items().size() == 1 ? code_text(diagnostics.items()[0].code) : "";
    };
    EXPECT_EQ(code({}), "");
    EXPECT_EQ(code({.max_states = 100}), "limit-lpe-states");
    EXPECT_EQ(code({.max_steps = 100}), "limit-lpe-steps");
    EXPECT_EQ(code({.max_nodes = 100}), "limit-lpe-nodes");
    EXPECT_EQ(code({.max_table_bytes = 1000}), "limit-lpe-table");
}

TEST(Budget, TooManyAutomata) {
    const std::vector<Event> events = must_events("RD RS V L");
    // Each fits alone, no two fit together.
    const std::vector<AovRequest> aovs = requests({"C.*D.{4}L", "C.*S.{4}L", "C.*V.{4}L"});
    Limits limits;
    limits.max_states = 70;
    EXPECT_EQ(compile(aovs, events, limits).n_automata(), 3U);
    limits.max_automata = 2;
    Diagnostics diagnostics;
    const Program program = Program::compile(aovs, events, limits, diagnostics);
    EXPECT_EQ(program.n_automata(), 2U);
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::LimitLpeAutomata);
}

TEST(Budget, OneBadExpressionLeavesTheOthersAlone) {
    const std::vector<Event> events = must_events("RD RS V L O A");
    const std::vector<AovRequest> aovs = requests({"C.*", "C.*D.{20}L", "CDL", "C.*D.{11}L"});
    Diagnostics diagnostics;
    const Program program = Program::compile(aovs, events, {}, diagnostics);
    EXPECT_EQ(diagnostics.n_errors(), 1U);
    EXPECT_EQ(aovs_of(program, must_path("C RD L")), (std::set<std::uint32_t>{0, 2}));
    EXPECT_EQ(aovs_of(program, must_path("C RD V V V V V V V V V V V L")),
              (std::set<std::uint32_t>{0, 3}));
}

}  // namespace
}  // namespace lightsieve::lpe
