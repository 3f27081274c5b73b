// All engines agree: on every small expression over every short path, and on random large ones.
#include <gtest/gtest.h>

#include <random>

#include "lpe/print.h"
#include "lpe/testing/engines.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_events;
using testing::must_parse;

TEST(Exhaustive, AllExpressionsOfFourNodesOnAllPathsOfFourEvents) {
    std::vector<Expr> leaves;
    for (const char* leaf : {"C", "D", "<RS'a'>", "[^D]", ".", "L", "A"})
        leaves.push_back(must_parse(leaf));
    const std::vector<Event> events = must_events("RD RS'a' TS V L O A");
    const std::vector<Path> paths = testing::all_paths(events, 4);
    std::size_t n_expressions = 0, n_taken = 0;
    for (std::size_t n_nodes = 1; n_nodes <= 4; ++n_nodes) {
        for (const Expr& expr : testing::all_expressions(leaves, n_nodes)) {
            // As it is, and behind a camera, where it has more to say.
            const Expr behind =
                std::make_shared<const Node>(Node{Sequence{{leaves[0], expr}}, {}});
            for (const Expr& e : {expr, behind}) {
                ++n_expressions;
                const testing::Engines engines(e, events);
                for (const Path& path : paths)
                    n_taken += engines.agreed(path) ? 1 : 0;
            }
        }
    }
    // Fixed by the counts of trees and paths: the test must not shrink unseen.
    EXPECT_EQ(paths.size(), 62U);
    EXPECT_EQ(n_expressions, 2U * (7 + 28 + 210 + 1624));
    EXPECT_GT(n_taken, 5'000U);
}

TEST(Exhaustive, AllExtendedExpressionsOfFourNodesOnAllPathsOfFourEvents) {
    std::vector<Expr> leaves;
    for (const char* leaf : {"C", "D", ".", "A"})
        leaves.push_back(must_parse(leaf));
    const std::vector<Event> events = must_events("RD RS'a' L A");
    const std::vector<Path> paths = testing::all_paths(events, 4);
    std::size_t n_expressions = 0, n_taken = 0;
    for (std::size_t n_nodes = 1; n_nodes <= 4; ++n_nodes)
        for (const Expr& expr : testing::all_expressions(leaves, n_nodes, true)) {
            const Expr behind =
                std::make_shared<const Node>(Node{Sequence{{leaves[0], expr}}, {}});
            for (const Expr& e : {expr, behind}) {
                ++n_expressions;
                const testing::Engines engines(e, events);
                for (const Path& path : paths)
                    n_taken += engines.agreed(path) ? 1 : 0;
            }
        }
    EXPECT_EQ(n_expressions, 2U * (4 + 20 + 164 + 1460));
    EXPECT_GT(n_taken, 3'000U);
}

TEST(Exhaustive, RandomExtendedExpressionsOnRandomPaths) {
    std::mt19937 random(23);
    const std::vector<Event> events =
        must_events("RD RD'a' RS RS'coat' TD TS'b' TS'a''b' V V'key' L L'key' O O'a' B B'key' A");
    std::size_t n_taken = 0;
    for (int i = 0; i < 400; ++i) {
        const Expr expr = testing::random_extended_expression(random, 4 + random() % 16);
        const Expr rest = testing::random_light_expression(random, 3);
        const Expr both = std::make_shared<const Node>(Node{Alternation{{expr, rest}}, {}});
        for (const Expr& e : {expr, both}) {
            const testing::Engines engines(e, events);
            for (int j = 0; j < 60; ++j)
                n_taken += engines.agreed(testing::random_path(random, events, 7)) ? 1 : 0;
        }
    }
    EXPECT_GT(n_taken, 2'000U);
}

TEST(Exhaustive, RandomExpressionsOnRandomPaths) {
    std::mt19937 random(11);
    const std::vector<Event> events =
        must_events("RD RD'a' RS RS'coat' TD TS'b' TS'a''b' V V'key' L L'key' O O'a' B B'key' A");
    std::size_t n_taken = 0;
    for (int i = 0; i < 400; ++i) {
        const Expr expr = testing::random_light_expression(random, 4 + random() % 20);
        const testing::Engines engines(expr, events);
        for (int j = 0; j < 60; ++j)
            n_taken += engines.agreed(testing::random_path(random, events, 8)) ? 1 : 0;
    }
    EXPECT_GT(n_taken, 2'000U);
}

}  // namespace
}  // namespace lightsieve::lpe
