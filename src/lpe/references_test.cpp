// Expressions that name one another: in any order, without circles, within limits.
#include "lpe/references.h"

#include <gtest/gtest.h>

#include "lpe/algebra.h"
#include "lpe/builtins.h"
#include "lpe/parse.h"
#include "lpe/print.h"
#include "lpe/program.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe {
namespace {

using testing::must_parse;

struct Defined {
    ExpressionTable table;
    Diagnostics diagnostics;

    explicit Defined(const std::vector<std::string>& definitions) {
        for (const std::string& definition : definitions)
            table.define(definition, stand_alone(definition, "a.ass"), diagnostics);
        table.resolve(diagnostics);
    }
    /// "code: message; hint" of each report.
    [[nodiscard]] std::vector<std::string> reports() const {
        std::vector<std::string> out;
        for (const Error& error : diagnostics.items())
            out.push_back(std::string(code_text(error.code)) + ": " + error.message + "; " +
                          error.hint);
        return out;
    }
    [[nodiscard]] bool is(const char* name, const char* expression) const {
        return equivalent(table.find(name)->expr, must_parse(expression));
    }
};
using Reports = std::vector<std::string>;

TEST(References, AreResolvedInAnyOrder) {
    const Defined defined({"no_caustics $indirect - $caustics", "caustics CDS.*L",
                           "both $no_caustics|$twice", "twice ${caustics} & $caustics"});
    EXPECT_EQ(defined.reports(), Reports{});
    EXPECT_TRUE(defined.is("no_caustics", "C[DSV][DSVOB].* - CDS.*L"));
    EXPECT_TRUE(defined.is("twice", "CDS.*L"));
    EXPECT_TRUE(defined.is("both", "$indirect"));
    EXPECT_EQ(print(defined.table.find("no_caustics")->expr), "$indirect - $caustics");
}

TEST(References, MeanTheCustomExpressionFirst) {
    const Defined defined({"diffuse CD.*", "mine $diffuse"});
    EXPECT_TRUE(defined.is("mine", "CD.*"));
    EXPECT_TRUE(equivalent(must_parse("$diffuse"), must_parse("C<RD>.*")));
    Diagnostics diagnostics;
    const Expr expr = parse("$mine", SourceSpan{}, diagnostics, {.names = &defined.table});
    EXPECT_TRUE(equivalent(expr, must_parse("CD.*")));
}

TEST(References, CirclesAreErrors) {
    EXPECT_EQ(Defined({"a $a"}).reports(),
              Reports{"lpe-cycle: AOV \"a\": \"a\" names \"a\", a circle; write one of them "
                      "without naming the other"});
    EXPECT_EQ(Defined({"diffuse $diffuse - $sss"}).reports(),
              Reports{"lpe-cycle: AOV \"diffuse\": \"diffuse\" names \"diffuse\", a circle; a "
                      "custom expression takes the place of the built-in of its name: rename it"});
    const Defined three({"a C.*L|$b", "b $c & C.*", "c C.* - $a", "d $b", "e C.*"});
    EXPECT_EQ(
        three.reports(),
        (Reports{"lpe-cycle: AOV \"c\": \"a\" names \"b\" names \"c\" names \"a\", a circle; "
                 "write one of them without naming the other",
                 "lpe-reference: AOV \"d\": \"$b\" has an error of its own; correct that "
                 "one first"}));
    for (const char* name : {"a", "b", "c", "d"})
        EXPECT_FALSE(three.table.find(name)->expr) << name;
    EXPECT_TRUE(three.table.find("e")->expr);
}

TEST(References, OfNothingAreErrorsAtTheirColumn) {
    const Defined defined({"a C.* - $caostics", "caustics CDS.*L", "b C<", "c $b"});
    EXPECT_EQ(defined.reports().size(), 3U);
    bool found = false;
    for (const Error& error : defined.diagnostics.items()) {
        if (error.hint != "did you mean \"caustics\"?") continue;
        found = true;
        EXPECT_EQ(error.code, Code::LpeReference);
        EXPECT_EQ(error.where.line_column().column, 9U);
    }
    EXPECT_TRUE(found) << defined.diagnostics.render();
}

TEST(References, LintsSeeWhatTheyStandFor) {
    const Defined defined({"nothing $direct & $indirect", "mixed $direct|$albedo"});
    std::vector<Code> codes;
    for (const Error& error : defined.diagnostics.items())
        codes.push_back(error.code);
    EXPECT_EQ(codes, (std::vector<Code>{Code::LpeMixed, Code::LpeNever}));
}

TEST(References, LongChainsAreFineAndEndlessGrowthIsALimit) {
    std::vector<std::string> chain{"a0 C.*L"}, doubling{"a0 C.*L"};
    for (int i = 1; i <= 1000; ++i)
        chain.push_back("a" + std::to_string(i) + " $a" + std::to_string(i - 1));
    for (int i = 1; i <= 60; ++i) {
        const std::string before = "$a" + std::to_string(i - 1);
        doubling.push_back("a" + std::to_string(i) + " " + before + " & " + before);
    }
    const Defined long_one(chain);
    EXPECT_EQ(long_one.reports(), Reports{});
    EXPECT_TRUE(long_one.is("a1000", "C.*L"));
    for (int i = 1001; i <= 3000; ++i)
        chain.push_back("a" + std::to_string(i) + " $a" + std::to_string(i - 1));
    const Defined longer(chain);
    ASSERT_TRUE(longer.diagnostics.has_errors());
    EXPECT_EQ(longer.diagnostics.items()[0].code, Code::LimitLpeExpansion);
    EXPECT_EQ(longer.diagnostics.items()[0].hint, "the limit kMaxExpandedDepth is 1280");
    const Defined explosion(doubling);
    ASSERT_TRUE(explosion.diagnostics.has_errors());
    EXPECT_EQ(explosion.diagnostics.items()[0].code, Code::LimitLpeExpansion);
    EXPECT_EQ(explosion.diagnostics.items()[0].hint, "the limit kMaxExpandedNodes is 262144");
    EXPECT_FALSE(explosion.table.find("a60")->expr);
}

TEST(References, StandardTablesRefuseThem) {
    ExpressionTable table;
    Diagnostics diagnostics;
    table.require_standard();
    table.define("a $direct", {}, diagnostics);
    table.define("b C.*", {}, diagnostics);
    table.resolve(diagnostics);
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::LpeStandard);
}

TEST(References, ChainsOfOperatorsHaveALimit) {
    std::string text = "C.*";
    for (std::size_t i = 0; i <= kMaxNesting; ++i)
        text += i % 2 == 0 ? " & C.*" : " - CDS";
    Diagnostics diagnostics;
    EXPECT_FALSE(parse(text, diagnostics));
    ASSERT_EQ(diagnostics.items().size(), 1U);
    EXPECT_EQ(diagnostics.items()[0].code, Code::LimitLpeNesting);
}

}  // namespace
}  // namespace lightsieve::lpe
