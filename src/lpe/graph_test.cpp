#include "lpe/graph.h"

#include <gtest/gtest.h>

#include "lpe/builtins.h"
#include "lpe/parse.h"

namespace lightsieve::lpe {
namespace {

NamedExpr named(const std::string& name, std::string_view text) {
    Diagnostics diagnostics;
    return {name, std::string(text), parse(text, diagnostics)};
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++n;
    return n;
}

TEST(Graph, ShowsStatesAtomsAndReadableEdges) {
    const std::vector<NamedExpr> exprs{named("coat", "C<RS'coat'>.*"),
                                       named("other", "C<RS[^'coat']>L")};
    const std::string dot = graph(exprs);
    EXPECT_TRUE(dot.starts_with("digraph lpe {"));
    EXPECT_EQ(count(dot, "shape=circle"), 3U);
    EXPECT_EQ(count(dot, "shape=box"), 2U);
    EXPECT_NE(dot.find("label=\"RS'coat'\""), std::string::npos) << dot;
    EXPECT_NE(dot.find("label=\"RS except coat\""), std::string::npos) << dot;
    EXPECT_NE(dot.find("label=\"any light\""), std::string::npos) << dot;
    EXPECT_NE(dot.find("label=\"coat\""), std::string::npos) << dot;
}

TEST(Graph, PathsOfSeveralExpressionsEndInOneAtomOfAll) {
    const std::vector<NamedExpr> exprs{named("a", "CDL"), named("b", "C.L")};
    const std::string dot = graph(exprs);
    EXPECT_NE(dot.find("label=\"a + b\""), std::string::npos) << dot;
    EXPECT_NE(dot.find("label=\"b\""), std::string::npos) << dot;
}

TEST(Graph, ProbesNeedAVertex) {
    const std::vector<NamedExpr> exprs{named("x", "((CA)|(CDA))")};
    EXPECT_EQ(count(graph(exprs), "label=\"A\""), 1U);
    // Here paths come back to the start.
    const std::vector<NamedExpr> loops{named("x", "C.*A")};
    EXPECT_EQ(count(graph(loops), "label=\"A\""), 1U);
}

TEST(Graph, TextsAreEscaped) {
    const std::vector<NamedExpr> exprs{named("with \"quotes\" and \\", "C<L.'a\"b'>")};
    const std::string dot = graph(exprs);
    EXPECT_NE(dot.find("\\\"quotes\\\""), std::string::npos) << dot;
    EXPECT_NE(dot.find("a\\\"b"), std::string::npos) << dot;
}

TEST(Graph, OfTooManyStatesIsALimitError) {
    const std::vector<NamedExpr> exprs{named("x", "C.*D.{9}L")};
    EXPECT_THROW((void)graph(exprs), InputError);
}

}  // namespace
}  // namespace lightsieve::lpe
