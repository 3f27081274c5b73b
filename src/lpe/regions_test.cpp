#include "lpe/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lpe/builtins.h"
#include "lpe/match.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_parse;

/// Expressions by their texts, with their regions over all paths.
struct Fixture {
    std::vector<Expr> exprs;
    std::vector<Region> found;

    explicit Fixture(const std::vector<std::string>& texts) {
        std::vector<AovRequest> requests;
        for (const std::string& text : texts) {
            exprs.push_back(must_parse(text));
            requests.push_back({text, exprs.back(), GroupSelect::All, ""});
        }
        found = regions(requests, abstract_events(exprs));
    }
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> sums(std::uint32_t whole) const {
        std::vector<std::vector<std::uint32_t>> out;
        for (const Sum& sum : find_sums(found, exprs.size(), whole))
            out.push_back(sum.parts);
        return out;
    }
};

using Sums = std::vector<std::vector<std::uint32_t>>;

TEST(Regions, AreDisjointAndTheirExamplesAreTakenByTheirAovsOnly) {
    const Fixture f({"C.*", "$direct", "$diffuse", "C.*<L.'key'>", "C[DSV]A"});
    std::set<std::vector<std::uint32_t>> seen;
    for (const Region& region : f.found) {
        EXPECT_TRUE(seen.insert(region.aovs).second);
        for (std::uint32_t i = 0; i < f.exprs.size(); ++i)
            EXPECT_EQ(match(f.exprs[i], region.example),
                      std::ranges::binary_search(region.aovs, i))
                << print_path(region.example);
    }
    EXPECT_EQ(f.found.size(), 9U);
}

TEST(Regions, AProbeWithoutAVertexIsNoRegion) {
    EXPECT_TRUE(Fixture({"CA"}).found.empty());
    EXPECT_EQ(Fixture({"C.*A"}).found.size(), 1U);
}

TEST(Regions, SharesOfAllLightAddUpToOne) {
    const Fixture f({"C.*", "$direct", "$emission", "C<RS'coat'>.*"});
    double sum = 0;
    for (const Region& region : f.found)
        sum += region.share;
    EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(Regions, RelationsAgreeWithTheAlgebra) {
    const std::vector<std::string> texts{"$diffuse", "$diffuse_direct", "$direct", "C<RD>.*",
                                         "CB",       "C.*<L.'key'>",    "CTD"};
    const Fixture f(texts);
    for (std::uint32_t a = 0; a < texts.size(); ++a)
        for (std::uint32_t b = 0; b < texts.size(); ++b)
            EXPECT_EQ(relation(f.found, a, b), compare(f.exprs[a], f.exprs[b]).relation)
                << texts[a] << " " << texts[b];
}

TEST(Sums, OfTheBuiltinsAreTheAdditiveSets) {
    for (const BuiltinTable which : {BuiltinTable::Reference, BuiltinTable::Arnold7}) {
        const ExpressionTable table(which);
        for (const std::vector<std::string_view>& set : additive_sets(which)) {
            std::vector<AovRequest> requests{{"", must_parse("C.*"), GroupSelect::All, ""}};
            std::vector<Expr> exprs{requests[0].expr};
            for (const std::string_view name : set) {
                exprs.push_back(table.find(name)->expr);
                requests.push_back({std::string(name), exprs.back(), GroupSelect::All, ""});
            }
            const std::vector<Region> found = regions(requests, abstract_events(exprs));
            const std::vector<Sum> sums = find_sums(found, exprs.size(), 0);
            ASSERT_EQ(sums.size(), 1U);
            EXPECT_EQ(sums[0].parts.size(), set.size());
        }
    }
}

TEST(Sums, AreFoundAmongCustomExpressionsAndProvedByTheAlgebra) {
    const Fixture f({"C.*", "C[LOB]", "CD.*", "C[^LOBD].*", "CS.*", "CV.*", "C[DS].*", "CDL"});
    const Sums sums = f.sums(0);
    EXPECT_EQ(sums, (Sums{{1, 2, 3}, {1, 5, 6}}));
    for (const std::vector<std::uint32_t>& sum : sums) {
        std::vector<Expr> parts;
        for (const std::uint32_t part : sum)
            parts.push_back(f.exprs[part]);
        EXPECT_TRUE(check_partition(f.exprs[0], parts).holds());
    }
    EXPECT_EQ(f.sums(3), (Sums{{4, 5}}));
    EXPECT_EQ(f.sums(6), (Sums{{2, 4}}));
    EXPECT_TRUE(f.sums(7).empty());
}

TEST(Sums, LeaveOutTwinsAndTheDead) {
    const Fixture f({"C.*", "C[LOB]", "C[LOB]", "C[RTV].*", "CTD"});
    EXPECT_EQ(f.sums(0), (Sums{{1, 3}}));
    EXPECT_EQ(relation(f.found, 1, 2), Relation::Equal);
}

TEST(Sums, OfManyAovsEndWithinTheirBudget) {
    std::vector<std::string> texts{"C.*"};
    for (const char* first : {"RD", "RS", "TD", "TS", "V."})
        for (const char* second : {"RD", "RS", "TD", "TS", "V.", "L.", "O.", "B."})
            texts.push_back("C<" + std::string(first) + "><" + second + ">.*");
    const Fixture f(texts);
    EXPECT_TRUE(f.sums(0).empty());
    EXPECT_EQ(nearest_parts(f.found, texts.size(), 0).size(), texts.size() - 1);
}

TEST(NearestParts, TakeAsMuchAsTheyCanWithoutOverlap) {
    // Both of the last two overlap; the larger one is kept.
    const Fixture f({"C.*", "CD.*", "CS.*", "C[DS]L"});
    EXPECT_EQ(nearest_parts(f.found, 4, 0), (std::vector<std::uint32_t>{1, 2}));
    EXPECT_TRUE(nearest_parts(f.found, 4, 3).empty());
}

TEST(Regions, AreAnErrorWhereOneAutomatonDoesNotHoldThem) {
    const std::vector<Expr> exprs{must_parse("C.*D.{9}L"), must_parse("C.*S.{9}L"),
                                  must_parse("C.*V.{9}L")};
    std::vector<AovRequest> requests;
    for (const Expr& expr : exprs)
        requests.push_back({"x", expr, GroupSelect::All, ""});
    Limits limits;
    limits.max_states = 3000;
    EXPECT_THROW((void)regions(requests, abstract_events(exprs), limits), InputError);
}

}  // namespace
}  // namespace lightsieve::lpe
