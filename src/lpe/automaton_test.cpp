// Classes of events, the automaton as it is made, and its minimisation.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "lpe/alphabet.h"
#include "lpe/dump.h"
#include "lpe/interner.h"
#include "lpe/minimise.h"
#include "lpe/predicate.h"
#include "lpe/print.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_events;
using testing::must_parse;

TEST(Interner, EqualRunsGetTheSameNumber) {
    Interner interner;
    std::set<std::vector<std::uint32_t>> runs;
    std::mt19937 random(3);
    for (int i = 0; i < 5000; ++i) {
        std::vector<std::uint32_t> run(random() % 5);
        for (std::uint32_t& word : run)
            word = static_cast<std::uint32_t>(random() % 6);
        const bool is_new = runs.insert(run).second;
        const std::uint32_t id = interner.intern(run);
        ASSERT_EQ(is_new, id + 1 == runs.size() && interner.size() == runs.size() && is_new);
        ASSERT_TRUE(std::ranges::equal(interner[id], run));
    }
    EXPECT_EQ(interner.size(), runs.size());
}

TEST(Alphabet, OneClassForEventsThatNoTestTellsApart) {
    const std::vector<Expr> exprs{must_parse("C<RS'coat'>L"), must_parse("CD.*")};
    const std::vector<Event> events =
        must_events("RD TD'skin' RS RS'sheen' TS V RS'coat' L L'key' O B A");
    const Alphabet alphabet(exprs, events);
    // D; other scattering; the coat. L; O and B; A.
    EXPECT_EQ(alphabet.n_scatter(), 3U);
    EXPECT_EQ(alphabet.n_terminals(), 3U);
    const auto same = [&](std::size_t a, std::size_t b) {
        return alphabet.class_of(a) == alphabet.class_of(b);
    };
    EXPECT_TRUE(same(0, 1));    // RD TD'skin'
    EXPECT_TRUE(same(2, 5));    // RS V
    EXPECT_FALSE(same(2, 6));   // RS RS'coat'
    EXPECT_TRUE(same(7, 8));    // L L'key'
    EXPECT_TRUE(same(9, 10));   // O B
    EXPECT_FALSE(same(9, 11));  // O A
    EXPECT_EQ(alphabet.example(Alphabet::kCamera).kind, EventKind::Camera);
    EXPECT_TRUE(alphabet.is_light(alphabet.class_of(9)));
    EXPECT_FALSE(alphabet.is_light(alphabet.class_of(11)));
}

TEST(Alphabet, ClassesAnswerEveryTestAlike) {
    std::mt19937 random(5);
    const std::vector<Event> events =
        must_events("RD RD'a' RS RS'coat' TD TS'b' TS'a''b' V V'key' L L'key' O O'a' B B'key' A");
    for (int i = 0; i < 300; ++i) {
        const std::vector<Expr> exprs{testing::random_expression(random, 6)};
        const Alphabet alphabet(exprs, events);
        for_each_event_test(*exprs[0], [&](const Node& test) {
            for (std::size_t e = 0; e < events.size(); ++e) {
                const EventClass c = alphabet.class_of(e);
                const bool in_set = (alphabet.taken_by(test)[c / 32] >> (c % 32) & 1U) != 0;
                ASSERT_EQ(in_set, takes(test, events[e])) << print(test) << print_event(events[e]);
            }
        });
    }
}

Dfa minimal(const char* text, const std::vector<Event>& events) {
    const std::vector<Expr> exprs{must_parse(text)};
    return minimise(determinise(exprs, Alphabet(exprs, events), {}).dfa);
}

TEST(Minimise, DumpsOfSmallAutomata) {
    const std::vector<Event> events = must_events("RD RS V L O");
    // Classes in the order of the events; state 0 is dead, 1 the start.
    EXPECT_EQ(dump(minimal("C.*L", events)),
              "start 1\n"
              "0: 0 output 0\n"
              "1: 1 output 1\n");
    EXPECT_EQ(dump(minimal("CD*S?L", events)),
              "start 1\n"
              "0: 0 0 0 output 0\n"
              "1: 1 2 0 output 1\n"
              "2: 0 0 0 output 1\n");
    EXPECT_EQ(dump(minimal("C(DS){1,2}L", events)),
              "start 1\n"
              "0: 0 0 0 output 0\n"
              "1: 2 0 0 output 0\n"
              "2: 0 3 0 output 0\n"
              "3: 4 0 0 output 1\n"
              "4: 0 5 0 output 0\n"
              "5: 0 0 0 output 1\n");
    // What takes nothing is the dead state alone.
    EXPECT_EQ(dump(minimal("CD", events)),
              "start 0\n"
              "0: 0 0 output 0\n");
}

/// Myhill and Nerode by brute force: pairs that differ now, or after one step lead to pairs that
/// differ.
std::size_t n_distinguishable(const Dfa& dfa) {
    const std::size_t n = dfa.n_states();
    std::vector<std::vector<bool>> differ(n, std::vector<bool>(n, false));
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t b = 0; b < n; ++b) {
                bool now = dfa.output[a] != dfa.output[b];
                for (std::size_t c = 0; c < dfa.n_classes; ++c)
                    now = now ||
                          differ[dfa.next[a * dfa.n_classes + c]][dfa.next[b * dfa.n_classes + c]];
                changed = changed || now != differ[a][b];
                differ[a][b] = differ[a][b] || now;
            }
    }
    std::size_t count = 0;
    for (std::size_t a = 0; a < n; ++a) {
        bool first = true;
        for (std::size_t b = 0; b < a; ++b)
            first = first && differ[a][b];
        count += first ? 1 : 0;
    }
    return count;
}

TEST(Minimise, FindsTheSmallestAndChangesNothingTwice) {
    std::mt19937 random(9);
    const std::vector<Event> events =
        must_events("RD RD'a' RS'coat' TD TS'b' V L L'key' O'a' B A");
    std::size_t n_merged = 0;
    for (int i = 0; i < 200; ++i) {
        const std::vector<Expr> exprs{testing::random_light_expression(random, 12),
                                      testing::random_light_expression(random, 6)};
        const Dfa dfa = determinise(exprs, Alphabet(exprs, events), {}).dfa;
        if (dfa.n_states() > 60) continue;
        const Dfa small = minimise(dfa);
        ASSERT_EQ(small.n_states(), n_distinguishable(dfa)) << print(exprs[0]) << print(exprs[1]);
        ASSERT_EQ(dump(minimise(small)), dump(small));
        n_merged += dfa.n_states() - small.n_states();
    }
    EXPECT_GT(n_merged, 50U);
}

}  // namespace
}  // namespace lightsieve::lpe
