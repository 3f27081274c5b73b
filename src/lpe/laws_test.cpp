// Laws that hold for every expression: on random ones, with our extensions.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "lpe/algebra.h"
#include "lpe/enumerate.h"
#include "lpe/parse.h"
#include "lpe/print.h"
#include "lpe/testing/generate.h"
#include "lpe/testing/naive_matcher.h"

namespace lightsieve::lpe {
namespace {

using testing::must_events;
using testing::must_parse;
using testing::naive_match;

Expr make(auto form) { return std::make_shared<const Node>(Node{std::move(form), {}}); }

/// Calls `check(a, b)` with pairs of random expressions, of which most take something.
template <class Check>
void for_random_pairs(int n, const Check& check) {
    std::mt19937 random(31);
    const auto some = [&]() -> Expr {
        const std::size_t size = 2 + random() % 8;
        return random() % 3 == 0 ? testing::random_extended_expression(random, size)
                                 : testing::random_light_expression(random, size);
    };
    for (int i = 0; i < n; ++i) {
        const Expr a = some(), b = some();
        SCOPED_TRACE(print(a) + "   and   " + print(b));
        check(a, b);
    }
}

TEST(Laws, WhatIsPrintedReadsAsTheSameTree) {
    std::mt19937 random(29);
    for (int i = 0; i < 3000; ++i) {
        const Expr expr = testing::random_extended_expression(random, 1 + random() % 30);
        Diagnostics diagnostics;
        const Expr again = parse(print(expr), diagnostics);
        ASSERT_TRUE(equal(again, expr)) << print(expr) << "\n" << diagnostics.render();
    }
}

TEST(Laws, OfDeMorgan) {
    for_random_pairs(150, [](const Expr& a, const Expr& b) {
        const Expr not_a = make(Complement{a}), not_b = make(Complement{b});
        EXPECT_TRUE(equivalent(make(Complement{make(Alternation{{a, b}})}),
                               make(Intersection{{not_a, not_b}})));
        EXPECT_TRUE(equivalent(make(Complement{make(Intersection{{a, b}})}),
                               make(Alternation{{not_a, not_b}})));
    });
}

TEST(Laws, OfDifferencesAndIntersections) {
    const Expr light = must_parse("C.*");
    for_random_pairs(150, [&](const Expr& a, const Expr& b) {
        const Expr both = make(Intersection{{a, b}}), minus = make(Difference{{a, b}});
        EXPECT_EQ(!shortest_path(minus), !shortest_path_outside(a, b));
        EXPECT_TRUE(equivalent(both, make(Difference{{a, minus}})));
        EXPECT_TRUE(equivalent(both, make(Intersection{{b, a}})));
        EXPECT_TRUE(
            equivalent(make(Complement{make(Complement{a})}), make(Intersection{{a, light}})));
        EXPECT_TRUE(equivalent(make(Complement{a}), make(Difference{{light, a}})));
        EXPECT_TRUE(check_partition(a, std::vector<Expr>{both, minus}).holds());
    });
}

TEST(Laws, ComparisonsAreConsistentAndTheirWitnessesRight) {
    std::set<Relation> seen;
    for_random_pairs(400, [&](const Expr& a, const Expr& b) {
        const Comparison found = compare(a, b), mirrored = compare(b, a);
        seen.insert(found.relation);
        EXPECT_EQ(found.only_a, mirrored.only_b);
        const auto check = [&](const std::optional<Path>& path, bool in_a, bool in_b) {
            if (!path) return;
            EXPECT_EQ(naive_match(a, *path), in_a) << print_path(*path);
            EXPECT_EQ(naive_match(b, *path), in_b) << print_path(*path);
        };
        check(found.only_a, true, false);
        check(found.only_b, false, true);
        check(found.both, true, true);
        EXPECT_EQ(found.relation == Relation::Equal, !found.only_a && !found.only_b);
        EXPECT_EQ(found.relation == Relation::Disjoint,
                  found.only_a && found.only_b && !found.both);
    });
    EXPECT_EQ(seen.size(), 5U);
}

TEST(Compare, AmongAScenesPathsOnly) {
    const std::vector<Event> events = must_events("RD RS L O");
    const Expr a = must_parse("C[DS]L"), b = must_parse("C[DSV]L");
    EXPECT_EQ(compare(a, b).relation, Relation::Subset);
    EXPECT_EQ(print_path(*compare(a, b).only_b), "C V L");
    EXPECT_EQ(compare(b, a).relation, Relation::Superset);
    EXPECT_EQ(compare(a, b, events).relation, Relation::Equal);
    EXPECT_EQ(compare(a, must_parse("CVL"), events).relation, Relation::Superset);
    EXPECT_EQ(compare(a, must_parse("CO")).relation, Relation::Disjoint);
    EXPECT_EQ(compare(must_parse("CDLL"), must_parse("CLL")).relation, Relation::Equal);
    EXPECT_TRUE(check_partition(b, std::vector{a}, events).holds());
    EXPECT_FALSE(check_partition(b, std::vector{a}).holds());
}

/// Paths without labels, to compare what happens on them.
std::string shape(Path path) {
    for (Event& event : path)
        event.labels.clear();
    return print_path(path);
}

TEST(Enumerate, ShortestPathsAreTakenAndDistinctInKind) {
    const auto list = [](const char* text, std::size_t n) {
        std::string out;
        for (const Path& path : shortest_paths(must_parse(text), n))
            out += (out.empty() ? "" : ", ") + print_path(path);
        return out;
    };
    EXPECT_EQ(list("C.*", 4), "C L, C O, C B, C RD L");
    EXPECT_EQ(list("$coat", 3), "C RS'coat' L, C RS'coat' O, C RS'coat' B");
    EXPECT_EQ(list("C<RD><L.['key''fill']>", 3), "C RD L'fill'");
    EXPECT_EQ(list("C(DS)+<L.'key'>", 3), "C RD RS L'key', C RD TS L'key', C TD RS L'key'");
    EXPECT_EQ(list("CD{200}L", 1).size(), 3 * 200 + 3);
    EXPECT_EQ(list("CDA", 9), "C RD A, C TD A");
    EXPECT_EQ(list("CDLL", 3), "");
    EXPECT_EQ(list("C.*A", 1), "C RD A");
}

TEST(Enumerate, AgreesWithTryingAllPaths) {
    std::mt19937 random(37);
    const std::vector<Event> events = must_events("RD RD'a' RS'coat' V L L'key' O'a' A");
    const std::vector<Path> all = testing::all_paths(events, 5);
    for (int i = 0; i < 60; ++i) {
        const Expr expr = testing::random_light_expression(random, 1 + random() % 8);
        SCOPED_TRACE(print(expr));
        std::vector<std::uint64_t> counts(6, 0);
        std::set<std::string> shapes;
        for (const Path& path : all)
            if (naive_match(expr, path)) {
                ++counts[path.size()];
                shapes.insert(shape(path));
            }
        for (std::size_t length = 0; length <= 5; ++length)
            EXPECT_EQ(count_paths(expr, events, length), counts[length]) << length;
        const std::vector<Path> found = shortest_paths(expr, events, shapes.size());
        std::set<std::string> found_shapes;
        for (const Path& path : found) {
            EXPECT_TRUE(naive_match(expr, path)) << print_path(path);
            found_shapes.insert(shape(path));
        }
        EXPECT_EQ(found_shapes, shapes);
    }
}

TEST(Enumerate, CountsSaturateAndLimitsAreErrors) {
    const std::vector<Event> events = must_events("RD RS TD TS V L O B");
    EXPECT_EQ(count_paths(must_parse("C.*"), events, 4), 75U);
    EXPECT_EQ(count_paths(must_parse("C.*"), events, 100), UINT64_MAX);
    EXPECT_EQ(count_paths(must_parse("C.*"), events, 1), 0U);
    EXPECT_EQ(count_paths(nullptr, events, 3), 0U);
    EXPECT_THROW((void)count_paths(must_parse("C.*D.{20}L"), events, 3), InputError);
    EXPECT_THROW((void)count_paths(must_parse("C.*"), events, 10'000'000), InputError);
    EXPECT_THROW((void)shortest_paths(must_parse("C.*D.{20}L"), 3), InputError);
}

}  // namespace
}  // namespace lightsieve::lpe
