// Names: the table of built-ins, custom expressions, and what an output string asks for.
#include <gtest/gtest.h>

#include <set>

#include "lpe/builtins.h"
#include "lpe/light_groups.h"
#include "lpe/parse.h"
#include "lpe/print.h"

namespace lightsieve::lpe {
namespace {

// ---- built-ins ----

TEST(Builtins, ThirtyFiveNamesEachOnce) {
    std::set<std::string_view> names;
    for (const Builtin& row : builtins()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_FALSE(row.meaning.empty()) << row.name;
    }
    EXPECT_EQ(names.size(), 35U);
    for (const char* lobe :
         {"diffuse", "specular", "coat", "sheen", "transmission", "sss", "volume"})
        for (const char* suffix : {"", "_direct", "_indirect", "_albedo"})
            EXPECT_TRUE(names.contains(std::string(lobe) + suffix)) << lobe << suffix;
}

TEST(Builtins, TablesDifferInSpecularOnly) {
    std::set<std::string_view> differ;
    for (const Builtin& row : builtins())
        if (row.expression_in(BuiltinTable::Arnold7) != row.expression_in(BuiltinTable::Reference))
            differ.insert(row.name);
    EXPECT_EQ(differ, (std::set<std::string_view>{"specular", "specular_albedo", "specular_direct",
                                                  "specular_indirect"}));
    EXPECT_EQ(ExpressionTable(BuiltinTable::Arnold7).find("specular")->text,
              "C<RS[^'coat''sheen']>.*");
    EXPECT_EQ(ExpressionTable().find("specular")->text, "C<RS[^'coat']>.*");
}

TEST(Builtins, RgbIsAnotherNameOfTheBeauty) {
    EXPECT_EQ(find_builtin("RGB"), find_builtin("RGBA"));
    EXPECT_EQ(find_builtin("rgba"), nullptr);
    EXPECT_EQ(canonical_name("RGB_key"), "RGBA_key");
    EXPECT_EQ(canonical_name("RGBA_key"), "RGBA_key");
    EXPECT_EQ(canonical_name("RGBx"), "RGBx");
}

// ---- custom expressions ----

TEST(Custom, DefinitionsReplaceBuiltins) {
    ExpressionTable table;
    Diagnostics diagnostics;
    table.define("caustics CDS.*", {}, diagnostics);
    table.define("diffuse_albedo\tCDA", {}, diagnostics);
    table.define("  spaced   C <RD> L ", {}, diagnostics);
    EXPECT_TRUE(diagnostics.items().empty()) << diagnostics.render();
    EXPECT_EQ(print(table.find("caustics")->expr), "CDS.*");
    EXPECT_EQ(print(table.find("diffuse_albedo")->expr), "CDA");
    EXPECT_EQ(table.find("spaced")->text, "C <RD> L ");
    EXPECT_EQ(print(table.find("diffuse")->expr), "C<RD>.*");
    EXPECT_EQ(table.find("nothing"), nullptr);
    EXPECT_EQ(table.custom().size(), 3U);
    EXPECT_EQ(table.names().size(), 37U);
}

std::string define(const std::vector<std::string>& definitions) {
    ExpressionTable table;
    Diagnostics diagnostics;
    for (const std::string& definition : definitions)
        table.define(definition, stand_alone(definition, "a.ass"), diagnostics);
    return diagnostics.render();
}

TEST(Custom, Mistakes) {
    EXPECT_EQ(define({"caustics CDX"}),
              "a.ass:1:12: error[lpe-event]: AOV \"caustics\": no event \"X\"\n"
              "    1 | caustics CDX\n"
              "      |            ^\n"
              "  hint: events are C D S R T V L O B A and . (any); a label is quoted: 'X'\n");
    EXPECT_EQ(define({"a CL", "a CO"}),
              "a.ass:1:1: error[lpe-twice]: AOV \"a\" is defined twice\n"
              "    1 | a CO\n"
              "      | ^\n"
              "  hint: keep one of the two, or rename one\n");
    EXPECT_EQ(define({"RGB CL", "RGBA CO"}).substr(0, 27), "a.ass:1:1: error[lpe-twice]");
    EXPECT_EQ(define({"caustics"}),
              "a.ass:1:9: error[lpe-empty]: AOV \"caustics\": the expression is empty\n"
              "    1 | caustics\n"
              "      |         ^\n"
              "  hint: all light is C.*\n");
    EXPECT_EQ(define({" "}).substr(0, 27), "a.ass:1:1: error[lpe-empty]");
    EXPECT_EQ(define({"never DL"}),
              "a.ass:1:7: lint[lpe-never]: AOV \"never\": this can never take any path\n"
              "    1 | never DL\n"
              "      |       ^~\n"
              "  hint: start it with the camera C\n");
}

TEST(Custom, AWrongExpressionIsBlackNotUnknown) {
    ExpressionTable table;
    Diagnostics diagnostics;
    table.define("diffuse C<", {}, diagnostics);
    EXPECT_TRUE(diagnostics.has_errors());
    ASSERT_NE(table.find("diffuse"), nullptr);
    EXPECT_EQ(table.find("diffuse")->expr, nullptr);
}

// ---- output names ----

class Outputs : public ::testing::Test {
  protected:
    Outputs() {
        Diagnostics none;
        table_.define("caustics CDS.*", {}, none);
        table_.define("my_beauty C.*", {}, none);
        table_.define("my C.*L", {}, none);
        table_.define("mixed C[DSV][LA]", {}, none);
    }

    /// "layer=aov", with ":group" or ":(default)"; "other" for a non-LPE AOV; what was reported.
    std::string resolve(const std::string& name, const std::string& layer = "") {
        Diagnostics diagnostics;
        const auto source = std::make_shared<const SourceText>(SourceText{"a.ass", name});
        const ResolvedOutput resolved =
            resolve_output({name, layer, "exr", {source, 0, name.size()}}, names_, diagnostics);
        std::string out;
        for (const LpeLayer& found : resolved.layers) {
            out += (out.empty() ? "" : " ") + found.layer + "=" + found.aov;
            if (found.select == GroupSelect::Named) out += ":" + found.group;
            if (found.select == GroupSelect::Default) out += ":(default)";
            EXPECT_EQ(found.expr, table_.find(found.aov)->expr);
        }
        if (resolved.kind == ResolvedOutput::Kind::Other) out = "other";
        EXPECT_EQ(resolved.kind == ResolvedOutput::Kind::Unknown, diagnostics.has_errors());
        for (const Error& error : diagnostics.items())
            out += (out.empty() ? "" : " ") + std::string(code_text(error.code)) + ": " +
                   error.message + "; " + error.hint;
        return out;
    }

    ExpressionTable table_;
    AovNames names_{table_,
                    {"key", "fill", "direct", "beauty_key", "", "default", "key"},
                    {"Z", "my_data", "diffuse_id"}};
};

TEST_F(Outputs, ExpressionsComeFirst) {
    EXPECT_EQ(resolve("diffuse"), "diffuse=diffuse");
    EXPECT_EQ(resolve("caustics"), "caustics=caustics");
    EXPECT_EQ(resolve("diffuse", "d"), "d=diffuse");
    EXPECT_EQ(resolve("RGBA"), "RGBA=RGBA");
    EXPECT_EQ(resolve("RGB"), "RGBA=RGBA");
    // Never light group `direct` of `diffuse`.
    EXPECT_EQ(resolve("diffuse_direct"), "diffuse_direct=diffuse_direct");
    EXPECT_EQ(resolve("my_beauty"), "my_beauty=my_beauty");
    EXPECT_EQ(resolve("diffuse_albedo"), "diffuse_albedo=diffuse_albedo");
}

TEST_F(Outputs, ThenNonLpeAovs) {
    EXPECT_EQ(resolve("Z"), "other");
    EXPECT_EQ(resolve("my_data"), "other");
    EXPECT_EQ(resolve("diffuse_id"), "other");
}

TEST_F(Outputs, WildcardsMakeALayerForEachGroup) {
    EXPECT_EQ(resolve("diffuse_*"),
              "diffuse_beauty_key=diffuse:beauty_key diffuse_direct=diffuse:direct "
              "diffuse_fill=diffuse:fill "
              "diffuse_key=diffuse:key diffuse_default=diffuse:(default)");
    names_.groups = {"key"};
    EXPECT_EQ(resolve("RGB_*"), "RGBA_key=RGBA:key RGBA_default=RGBA:(default)");
    EXPECT_EQ(resolve("caustics_*", "c"), "c_key=caustics:key c_default=caustics:(default)");
    names_.groups = {};
    EXPECT_EQ(resolve("RGBA_*"), "RGBA_default=RGBA:(default)");
    EXPECT_EQ(resolve("mixed_*"), "mixed_default=mixed:(default)");
}

TEST_F(Outputs, OneGroup) {
    EXPECT_EQ(resolve("diffuse_key"), "diffuse_key=diffuse:key");
    EXPECT_EQ(resolve("RGB_key"), "RGBA_key=RGBA:key");
    EXPECT_EQ(resolve("diffuse_key", "k"), "k=diffuse:key");
    EXPECT_EQ(resolve("diffuse_default"), "diffuse_default=diffuse:(default)");
    EXPECT_EQ(resolve("diffuse_direct_key"), "diffuse_direct_key=diffuse_direct:key");
    EXPECT_EQ(resolve("diffuse_direct_direct"), "diffuse_direct_direct=diffuse_direct:direct");
    // The longest expression among the splits at a group that exists.
    EXPECT_EQ(resolve("my_beauty_key"), "my_beauty_key=my_beauty:key");
    names_.groups = {"beauty_key"};
    EXPECT_EQ(resolve("my_beauty_key"), "my_beauty_key=my:beauty_key");
}

TEST_F(Outputs, AGroupThatNoLightHasIsBlack) {
    names_.groups = {"key", "fill"};
    EXPECT_EQ(resolve("diffuse_kye"),
              "diffuse_kye=diffuse:kye lpe-group-unknown: \"diffuse_kye\" is black: no light is "
              "in group \"kye\"; "
              "did you mean \"key\"? the scene's groups are \"fill\", \"key\", \"default\"");
    EXPECT_EQ(resolve("my_beauty_sun"),
              "my_beauty_sun=my_beauty:sun lpe-group-unknown: \"my_beauty_sun\" is black: no "
              "light is in group \"sun\"; "
              "the scene's groups are \"fill\", \"key\", \"default\"");
}

TEST_F(Outputs, UnknownNamesSuggest) {
    EXPECT_EQ(resolve("difuse"), "lpe-unknown-aov: no AOV \"difuse\"; did you mean \"diffuse\"?");
    EXPECT_EQ(resolve("ZZ"), "lpe-unknown-aov: no AOV \"ZZ\"; did you mean \"Z\"?");
    EXPECT_EQ(
        resolve("nonsense"),
        "lpe-unknown-aov: no AOV \"nonsense\"; `lightsieve lpe list` lists the built-in ones");
    EXPECT_EQ(
        resolve("nonsense_*"),
        "lpe-unknown-aov: no AOV \"nonsense_*\"; `lightsieve lpe list` lists the built-in ones");
    EXPECT_EQ(resolve("diffuse_"),
              "lpe-unknown-aov: no AOV \"diffuse_\"; did you mean \"diffuse\" or \"diffuse_id\"?");
    EXPECT_EQ(resolve("_key"),
              "lpe-unknown-aov: no AOV \"_key\"; `lightsieve lpe list` lists the built-in ones");
    EXPECT_EQ(resolve("").substr(0, 15), "lpe-unknown-aov");
}

TEST_F(Outputs, AlbedoHasNoGroups) {
    const std::string error =
        "lpe-group-suffix: \"diffuse_albedo_key\": albedo has no light groups; "
        "a probe ends at no light; ask for \"diffuse_albedo\"";
    EXPECT_EQ(resolve("diffuse_albedo_key"), error);
    EXPECT_EQ(resolve("albedo_*").substr(0, 16), "lpe-group-suffix");
    EXPECT_EQ(resolve("coat_albedo_default").substr(0, 16), "lpe-group-suffix");
    // An expression of light and probes has groups for its light.
    EXPECT_EQ(resolve("mixed_key"), "mixed_key=mixed:key");
}

TEST_F(Outputs, LayersOfOneNameInOneFile) {
    const auto check = [&](const std::vector<OutputName>& outputs) {
        Diagnostics diagnostics;
        std::vector<ResolvedOutput> resolved;
        for (const OutputName& output : outputs)
            resolved.push_back(resolve_output(output, names_, diagnostics));
        check_layer_names(outputs, resolved, diagnostics);
        return diagnostics.render();
    };
    // Group `direct` of diffuse_* beside the output diffuse_direct, in either order.
    const std::string clash =
        "error[lpe-layer-name]: \"diffuse_*\" makes a second layer \"diffuse_direct\"\n"
        "  hint: give it a layer name after the driver\n"
        "  note: the other is output \"diffuse_direct\"\n";
    EXPECT_EQ(check({{"diffuse_*", "", "exr", {}}, {"diffuse_direct", "", "exr", {}}}), clash);
    EXPECT_EQ(check({{"diffuse_direct", "", "exr", {}}, {"diffuse_*", "", "exr", {}}}), clash);
    EXPECT_EQ(check({{"diffuse_*", "d", "exr", {}}, {"diffuse_direct", "", "exr", {}}}), "");
    EXPECT_EQ(check({{"diffuse_*", "", "exr", {}}, {"diffuse_direct", "", "other", {}}}), "");
    EXPECT_NE(check({{"diffuse_*", "", "exr", {}}, {"Z", "diffuse_key", "exr", {}}}), "");
    // Two plain outputs of one name are the driver's business.
    EXPECT_EQ(check({{"diffuse", "", "exr", {}}, {"diffuse", "", "exr", {}}}), "");
}

}  // namespace
}  // namespace lightsieve::lpe
