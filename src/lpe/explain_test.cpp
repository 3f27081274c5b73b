#include "lpe/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lpe/builtins.h"
#include "lpe/match.h"
#include "lpe/print.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_parse;

std::vector<NamedExpr> all_builtins() {
    const ExpressionTable table;
    std::vector<NamedExpr> out;
    for (const Builtin& row : builtins())
        out.push_back(*table.find(row.name));
    return out;
}

/// Can one path be made of the other by changing, removing or adding one event?
bool one_event_apart(const Path& a, const Path& b) {
    const Path& longer = a.size() < b.size() ? b : a;
    const Path& shorter = a.size() < b.size() ? a : b;
    if (longer.size() - shorter.size() > 1) return false;
    std::size_t same = 0;
    while (same < shorter.size() && shorter[same] == longer[same])
        ++same;
    const std::size_t skip = longer.size() - shorter.size();
    const std::size_t from = skip == 0 ? same + 1 : same;
    for (std::size_t i = from; i < shorter.size(); ++i)
        if (!(shorter[i] == longer[i + skip])) return false;
    return true;
}

TEST(Explain, TakenPathsAreTakenAndNearMissesAreNot) {
    for (const NamedExpr& aov : all_builtins()) {
        const Explanation told = explain(aov.expr);
        ASSERT_FALSE(told.taken.empty()) << aov.name;
        for (const TakenPath& taken : told.taken)
            EXPECT_TRUE(match(aov.expr, taken.path)) << aov.name << print_path(taken.path);
        for (const NearMiss& miss : told.near_misses) {
            EXPECT_FALSE(match(aov.expr, miss.path)) << aov.name << print_path(miss.path);
            const bool near = std::ranges::any_of(told.taken, [&](const TakenPath& taken) {
                return one_event_apart(taken.path, miss.path);
            });
            EXPECT_TRUE(near) << aov.name << print_path(miss.path);
            EXPECT_TRUE(miss.reason.starts_with("after C")) << miss.reason;
        }
        EXPECT_EQ(told.near_misses.empty(), aov.name == "RGBA") << aov.name;
    }
}

TEST(Explain, ReasonsSayWhatWouldHaveToStandThere) {
    const Explanation told = explain(must_parse("C<RS[^'coat']>L"));
    ASSERT_EQ(told.near_misses.size(), 3U);
    EXPECT_EQ(print_path(told.near_misses[0].path), "C RS'coat' L");
    EXPECT_EQ(told.near_misses[0].reason,
              "after C it must be reflected specularly but not by the coat");
    EXPECT_EQ(print_path(told.near_misses[1].path), "C RS O");
    EXPECT_EQ(told.near_misses[1].reason, "after C RS it must end at a light");
}

TEST(Explain, NamesTheAovsItOverlaps) {
    const std::vector<NamedExpr> others = all_builtins();
    const Explanation told = explain(must_parse("CRL"), {.others = others});
    const auto relation_to = [&](std::string_view name) {
        const auto row = std::ranges::find(told.related, name, &RelatedAov::name);
        return row == told.related.end() ? Relation::Disjoint : row->relation;
    };
    EXPECT_EQ(relation_to("RGBA"), Relation::Subset);
    EXPECT_EQ(relation_to("direct"), Relation::Subset);
    EXPECT_EQ(relation_to("diffuse_direct"), Relation::Superset);
    EXPECT_EQ(relation_to("diffuse"), Relation::Overlapping);
    EXPECT_EQ(relation_to("transmission"), Relation::Disjoint);
    EXPECT_EQ(relation_to("albedo"), Relation::Disjoint);
}

TEST(Explain, TheDefaultGroupIsLiteral) {
    const std::string told = explain(must_parse("C<L.'default'>")).paragraph("It");
    EXPECT_NE(told.find("end at a light of no group"), std::string::npos) << told;
    EXPECT_NE(told.find("literal"), std::string::npos) << told;
    EXPECT_EQ(explain(must_parse("CL")).paragraph("It").find("literal"), std::string::npos);
}

TEST(Explain, OfASceneKnowsItsEventsOnly) {
    const std::vector<Event> events{{EventKind::Reflection, EventLobe::Diffuse, {}},
                                    {EventKind::Light, EventLobe::None, {"sun"}}};
    const Explanation told = explain(must_parse("C[DS]+L"), {.events = events});
    ASSERT_FALSE(told.taken.empty());
    EXPECT_EQ(print_path(told.taken[0].path), "C RD L'sun'");
    EXPECT_EQ(
        told.taken[0].words,
        "a path that leaves the camera, is reflected diffusely, and ends at a light of group "
        "sun");
    ASSERT_EQ(told.near_misses.size(), 1U);
    EXPECT_EQ(print_path(told.near_misses[0].path), "C L'sun'");
}

TEST(Explain, WhatTakesNothingIsSaidToTakeNothing) {
    const Explanation told = explain(must_parse("CTD"));
    EXPECT_EQ(told.paragraph("It"), "It takes no path.");
    EXPECT_TRUE(told.taken.empty());
    EXPECT_TRUE(told.near_misses.empty());
    EXPECT_EQ(explain(nullptr).words, "no path");
}

TEST(Explain, WhatIsOverBudgetIsALimitError) {
    EXPECT_THROW((void)explain(must_parse("C.*D.{20}L")), InputError);
}

TEST(Explain, WhatIsSaidOfRandomExpressionsHolds) {
    std::mt19937 random(13);
    const std::vector<NamedExpr> others = all_builtins();
    std::size_t n_misses = 0;
    for (int i = 0; i < 200; ++i) {
        const Expr expr = testing::random_light_expression(random, 8);
        const Explanation told = explain(expr, {.others = others});
        EXPECT_EQ(told.taken.empty(), !shortest_path(expr).has_value()) << print(expr);
        for (const TakenPath& taken : told.taken)
            EXPECT_TRUE(match(expr, taken.path)) << print(expr) << print_path(taken.path);
        for (const NearMiss& miss : told.near_misses)
            EXPECT_FALSE(match(expr, miss.path)) << print(expr) << print_path(miss.path);
        n_misses += told.near_misses.size();
        for (const RelatedAov& aov : told.related) {
            const auto other = std::ranges::find(others, aov.name, &NamedExpr::name);
            EXPECT_EQ(aov.relation, compare(expr, other->expr).relation)
                << print(expr) << " " << aov.name;
        }
    }
    EXPECT_GT(n_misses, std::size_t{150});
}

}  // namespace
}  // namespace lightsieve::lpe
