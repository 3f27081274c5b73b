// What is left over: right, and short enough to read.
#include "lpe/rest.h"

#include <gtest/gtest.h>

#include <random>

#include "lpe/algebra.h"
#include "lpe/builtins.h"
#include "lpe/print.h"
#include "lpe/synthesis.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_events;
using testing::must_parse;

std::string rest_of(const char* whole, const std::vector<std::string>& parts) {
    std::vector<Expr> exprs;
    for (const std::string& part : parts)
        exprs.push_back(must_parse(part));
    const Expr left = rest(must_parse(whole), exprs);
    return left ? print(left) : "nothing";
}

TEST(Rest, ReadsAsAPersonWouldWriteIt) {
    EXPECT_EQ(rest_of("C.*", {"$diffuse", "$specular"}), "C[<RS'coat'>TVLOB].*");
    EXPECT_EQ(rest_of("C.*", {"$direct", "$emission", "$background"}), "C.[^L].*");
    EXPECT_EQ(rest_of("C.*", {"C.*D.*"}), "C[^D]*");
    EXPECT_EQ(rest_of("C.*", {"C[^D]*"}), "C.*D.*");
    EXPECT_EQ(rest_of("C.*", {"C.*L"}), "C.*[OB]");
    EXPECT_EQ(rest_of("C.*", {"C.*"}), "nothing");
    EXPECT_EQ(rest_of("C.*", {}), "C.*");
    EXPECT_EQ(rest_of("C.*", {"C.*<L.'key'>"}), "C.*[^<L.'key'>]");
    EXPECT_EQ(rest_of("C.*", {"C<RD'hero'>.*"}), "C[^<RD'hero'>].*");
    EXPECT_EQ(rest_of("$indirect", {"CDS.*"}), "C((D[^SL].*)|([SV][^L].*))");
    EXPECT_EQ(rest_of("C[DSV]+A", {"$albedo"}), "C...*A");
    EXPECT_EQ(rest_of("C(DSV)+[LO]", {"C(DSV){2}O"}), "CDSV((DSV((D(SVD)*SV[LO])|(L)))|([LO]))");
    EXPECT_EQ(rest_of("C.*", {"C.*[<L.'g1'><L.'g2'><L.'g3'>]"}), "C.*[^<L.['g1''g2''g3']>]");
    EXPECT_EQ(rest_of("C.*", {"C.*D.*D.*", "CV.*"}), "C(([^V][^D]*)|(S[SV]*.[^D]*))");
}

TEST(Rest, IsADifferenceWhereThatIsShorter) {
    EXPECT_EQ(rest_of("C.*", {"C.*D.{9}L"}), "C.* - C.*D.{9}L");
    EXPECT_EQ(rest_of("C.*", {"C.*D.{20}L"}), "C.* - C.*D.{20}L");
    EXPECT_EQ(rest_of("C.*", {"C.*['a''b']L", "C.*<RS'c'>+.*"}),
              "C.* - ((C.*['a''b']L)|(C.*<RS'c'>+.*))");
}

TEST(Rest, OfAScene) {
    const std::vector<Event> events = must_events("RD RS RS'coat' L L'key' B");
    const Expr left = rest(must_parse("C.*"), std::vector{must_parse("$diffuse")}, events);
    EXPECT_EQ(print(left), "C[^D].*");
    EXPECT_FALSE(rest(must_parse("C.*"), std::vector{must_parse("C[DSLB].*")}, events));
}

TEST(Simplify, WritesTheSameShorter) {
    const auto simple = [](const char* text) { return print(simplify(must_parse(text))); };
    EXPECT_EQ(simple("C.*|CD.*"), "C.*");
    EXPECT_EQ(simple("C(DS)*L"), "C(DS)*L");
    EXPECT_EQ(simple("C(D|S|V)*[LOB]"), "C.*");
    EXPECT_EQ(simple("$diffuse_direct|$diffuse_indirect"), "C<RD>.*");
    EXPECT_EQ(simple("CDL|CSL"), "C[DS]L");
    EXPECT_EQ(simple("CDLL"), "");
}

TEST(Rest, OfRandomExpressionsIsRight) {
    std::mt19937 random(17);
    std::size_t n_written = 0, total = 0;
    for (int i = 0; i < 300; ++i) {
        const Expr a = testing::random_light_expression(random, 2 + random() % 8);
        const Expr b = testing::random_light_expression(random, 2 + random() % 8);
        const Expr set = std::make_shared<const Node>(Node{Difference{{a, b}}, {}});
        const std::vector<Expr> both{a, b};
        const std::vector<Event> events = abstract_events(both);
        Expr written;
        try {
            written = synthesise(set, events, label_classes(both), 400, {});
        } catch (const OverBudget&) {
        }
        if (!written) continue;
        ++n_written;
        total += print(written).size();
        EXPECT_TRUE(equivalent(set, written)) << print(set) << " is not " << print(written);
    }
    EXPECT_GT(n_written, 120U);
    EXPECT_LT(total / n_written, 60U);
}

TEST(Rest, OfEverySubsetOfTheAdditiveSets) {
    std::size_t longest = 0;
    std::string longest_text;
    for (const BuiltinTable table_name : {BuiltinTable::Reference, BuiltinTable::Arnold7}) {
        const ExpressionTable table(table_name);
        const Expr beauty = table.find("RGBA")->expr;
        for (const auto& set : additive_sets(table_name))
            for (std::size_t chosen = 0; chosen < (std::size_t{1} << set.size()); ++chosen) {
                std::vector<Expr> parts;
                for (std::size_t i = 0; i < set.size(); ++i)
                    if ((chosen >> i & 1U) != 0) parts.push_back(table.find(set[i])->expr);
                const Expr left = rest(beauty, parts);
                if (chosen + 1 == (std::size_t{1} << set.size())) {
                    EXPECT_FALSE(left);
                    continue;
                }
                ASSERT_TRUE(left);
                if (print(left).size() > longest)
                    longest = print(left).size(), longest_text = print(left);
                parts.push_back(left);
                EXPECT_TRUE(check_partition(beauty, parts).holds()) << print(left);
            }
    }
    EXPECT_LE(longest, 80U) << longest_text;
}

}  // namespace
}  // namespace lightsieve::lpe
