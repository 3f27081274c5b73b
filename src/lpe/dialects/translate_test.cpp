#include "lpe/dialects/translate.h"

#include <gtest/gtest.h>

#include <random>

#include "lpe/algebra.h"
#include "lpe/builtins.h"
#include "lpe/dialects/dialects_test_support.h"
#include "lpe/parse.h"
#include "lpe/print.h"
#include "lpe/testing/generate.h"

namespace lightsieve::lpe::dialects {
namespace {

using lpe::testing::must_parse;

Translation must_translate(const std::string& text, const Dialect& from, const Dialect& to,
                           const TranslateOptions& options = {}) {
    Diagnostics diagnostics;
    std::optional<Translation> out = translate(text, {}, from, to, diagnostics, options);
    if (!out) throw std::logic_error(text + "\n" + diagnostics.render());
    return *std::move(out);
}

/// Checks a translation by the naive matcher: its witnesses are what they say.
void check_witnesses(const std::string& text, const Dialect& from, const Dialect& to,
                     const Translation& out) {
    SCOPED_TRACE(std::string(from.name) + " " + text + " -> " + std::string(to.name) + " " +
                 out.text);
    if (out.lost) {
        EXPECT_TRUE(naive_takes(from, text, *out.lost)) << print_path(*out.lost);
        EXPECT_FALSE(naive_takes(to, out.text, *out.lost)) << print_path(*out.lost);
    }
    if (out.added) {
        EXPECT_FALSE(naive_takes(from, text, *out.added)) << print_path(*out.added);
        EXPECT_TRUE(naive_takes(to, out.text, *out.added)) << print_path(*out.added);
    }
    EXPECT_EQ(out.exact,
              !out.text.empty() && !out.lost && !out.added && out.lost_prefixes.empty());
}

TEST(Translate, BuiltInsGoToEveryDialectAndBackOrSayWhatIsLost) {
    std::size_t n_exact = 0;
    for (const Builtin& builtin : builtins())
        for (const Dialect* to : dialects()) {
            const std::string text(builtin.expression);
            const Translation there = must_translate(text, arnold_dialect(), *to);
            check_witnesses(text, arnold_dialect(), *to, there);
            if (!there.exact) continue;
            ++n_exact;
            const Translation back = must_translate(there.text, *to, arnold_dialect());
            EXPECT_TRUE(back.exact) << there.text << " -> " << back.text;
            // The engine's own proof, which shares nothing with the translator's.
            EXPECT_TRUE(equivalent(must_parse(text), must_parse(back.text)))
                << text << " -> " << there.text << " -> " << back.text;
        }
    EXPECT_GE(n_exact, 120U);
}

TEST(Translate, BuiltInsGoBetweenAnyTwoDialects) {
    for (const Builtin& builtin : builtins())
        for (const Dialect* from : dialects()) {
            const Translation first =
                must_translate(std::string(builtin.expression), arnold_dialect(), *from);
            if (first.text.empty()) continue;
            for (const Dialect* to : dialects()) {
                const Translation out = must_translate(first.text, *from, *to);
                check_witnesses(first.text, *from, *to, out);
                // To itself, nothing may change.
                EXPECT_TRUE(out.exact || from != to) << first.text << " -> " << out.text;
            }
        }
}

/// A random common path with these labels.
CommonPath random_path(std::mt19937& random, const CommonAlphabet& alphabet) {
    while (true) {
        CommonPath path{alphabet.event(0)};
        auto state = CommonAlphabet::kAtCamera;
        while (state != CommonAlphabet::kEnd && path.size() < 6) {
            const auto s = static_cast<Symbol>(random() % alphabet.size());
            const auto next = alphabet.step(state, s);
            if (next == CommonAlphabet::kNoPath) continue;
            state = next;
            path.push_back(alphabet.event(s));
        }
        if (state == CommonAlphabet::kEnd) return path;
    }
}

TEST(Translate, RandomExpressionsKeepTheirPathsOrSayWhatIsLost) {
    std::mt19937 random(20260101);
    const CommonAlphabet alphabet({{"a", "b", "key", "coat"}, {}, {}, {}}, {});
    std::size_t n_exact = 0;
    for (int i = 0; i < 120; ++i) {
        const std::string text = print(testing::random_light_expression(random, 1 + random() % 6));
        for (const Dialect* to : dialects()) {
            const Translation out = must_translate(text, arnold_dialect(), *to);
            check_witnesses(text, arnold_dialect(), *to, out);
            n_exact += out.exact ? 1 : 0;
            if (!out.exact) continue;
            for (int k = 0; k < 20; ++k) {
                const CommonPath path = random_path(random, alphabet);
                EXPECT_EQ(naive_takes(arnold_dialect(), text, path),
                          naive_takes(*to, out.text, path))
                    << text << " -> " << out.text << ": " << print_path(path);
            }
            const Translation back = must_translate(out.text, *to, arnold_dialect());
            EXPECT_TRUE(back.exact) << out.text << " -> " << back.text;
        }
    }
    EXPECT_GE(n_exact, 200U);
}

std::string random_text(std::mt19937& random, std::string_view characters, std::size_t most) {
    std::string text;
    for (std::size_t n = random() % most; n > 0; --n)
        text += characters[random() % characters.size()];
    return text;
}

TEST(Translate, RandomTextsOfEveryDialectAreReadTranslatedOrRefused) {
    std::mt19937 random(7);
    std::size_t n_read = 0;
    for (int i = 0; i < 4000; ++i) {
        const Dialect& from = *dialects()[random() % dialects().size()];
        const Dialect& to = *dialects()[random() % dialects().size()];
        const std::string text =
            "C" + random_text(random, "CDGSsRTVLOB.<>[]^'a'()|*+L.<R>D24,{}; x", 12);
        SCOPED_TRACE(std::string(from.name) + ": " + text);
        Diagnostics diagnostics;
        const auto out = translate(text, {}, from, to, diagnostics);
        EXPECT_EQ(out.has_value(), !diagnostics.has_errors());
        if (out) {
            check_witnesses(text, from, to, *out);
            ++n_read;
        }
    }
    EXPECT_GE(n_read, 300U);
}

TEST(Translate, RandomBytesNeverCrashAReader) {
    std::mt19937 random(99);
    std::string bytes;
    for (int c = 0; c < 256; ++c)
        bytes += static_cast<char>(c);
    const std::string likely = "CDGSsRTVLOBAUMx.<>[]^'()|*+?{},;12 lpe:color \n";
    for (int i = 0; i < 20000; ++i) {
        const std::string text = random_text(random, i % 2 == 0 ? bytes : likely, 40);
        const Dialect& dialect = *dialects()[random() % dialects().size()];
        Diagnostics diagnostics, meant;
        const Reading reading = dialect.read(text, {}, diagnostics);
        if (dialect.read_as_meant != nullptr) (void)dialect.read_as_meant(text, {}, meant);
        EXPECT_TRUE(reading.pattern != nullptr || diagnostics.has_errors()) << text;
        for (const Error& error : diagnostics.items())
            EXPECT_NE(error.render(), "");
    }
}

TEST(Translate, ExtensionsOfOurLanguageBecomePlainExpressions) {
    for (const std::string text :
         {"C.* - CL", "C.* & C<RD>.*", "!(C<RD>.*)", "$diffuse - $diffuse_direct",
          "(C<RD>.* - C<RD>L) | CB", "!(C.*L) & !(C.*B)"}) {
        const Translation out = must_translate(text, arnold_dialect(), osl_dialect());
        EXPECT_TRUE(out.exact) << text << " -> " << out.text;
        const Translation back = must_translate(out.text, osl_dialect(), arnold_dialect());
        EXPECT_TRUE(equivalent(must_parse(text), must_parse(back.text))) << back.text;
    }
}

TEST(Translate, WhatASceneDoesNotHaveMakesItExact) {
    const std::vector<Without> without{Without::Straight, Without::Glossy};
    EXPECT_FALSE(must_translate("CSL", osl_dialect(), arnold_dialect()).exact);
    const Translation out =
        must_translate("CSL", osl_dialect(), arnold_dialect(), {.without = without});
    EXPECT_TRUE(out.exact);
    EXPECT_EQ(out.text, "CSL");
    for (std::size_t i = 0; i < kWithouts; ++i) {
        EXPECT_NE(without_name(static_cast<Without>(i)), "");
        EXPECT_NE(without_meaning(static_cast<Without>(i)), "");
    }
}

TEST(Translate, WhatIsInferredIsSaid) {
    const Translation karma = must_translate("C<RS[^'coat']>L", arnold_dialect(), karma_dialect());
    EXPECT_TRUE(karma.exact);
    EXPECT_NE(std::ranges::find(karma.unverified,
                                "karma: an event without the tag or label passes a [^'x']"),
              karma.unverified.end());
    const Translation same = must_translate("CDL", arnold_dialect(), arnold_dialect());
    EXPECT_EQ(same.unverified, std::vector<std::string>{});
    for (const Dialect* dialect : dialects())
        EXPECT_GE(dialect->facts.size(), 1U) << dialect->name;
}

TEST(Translate, TheVariantOfADialectIsOfferedWhereItIsExact) {
    const Translation out = must_translate("C<RS[^'coat']>L", arnold_dialect(), osl_dialect());
    EXPECT_FALSE(out.exact);
    ASSERT_EQ(out.notes.size(), 1U);
    EXPECT_EQ(out.notes[0], "exact for osl-placeholder: Cs*<R[GS][^'coat']>s*L");
}

TEST(Translate, ALintSaysWhereABarBindsTightly) {
    const auto lints = [](const std::string& text, const Dialect& from) {
        Diagnostics diagnostics;
        (void)translate(text, {}, from, arnold_dialect(), diagnostics);
        std::vector<std::string> out;
        for (const Error& error : diagnostics.items())
            out.push_back(error.message);
        return out;
    };
    EXPECT_EQ(lints("CDL|CSL", renderman_dialect()),
              std::vector<std::string>{"Pixar RenderMan reads this otherwise than it looks: it "
                                       "leaves out \"C RD L\""});
    EXPECT_EQ(lints("C(U2L)|O", renderman_dialect()),
              std::vector<std::string>{
                  "Pixar RenderMan reads this otherwise than it looks: it takes \"C L\""});
    EXPECT_EQ(lints("((CDL)|(CSL))", osl_dialect()), std::vector<std::string>{});
    EXPECT_EQ(lints("CDL|CSL", arnold_dialect()), std::vector<std::string>{});
}

Code code_of(const std::string& text, const Dialect& from) {
    Diagnostics diagnostics;
    EXPECT_FALSE(translate(text, {}, from, osl_dialect(), diagnostics).has_value());
    return diagnostics.items().at(0).code;
}

TEST(Translate, LimitsHold) {
    std::string labels = "C[";
    for (std::size_t i = 0; i <= kMaxLabels; ++i)
        labels += "'a" + std::to_string(i) + "'";
    labels += "]L";
    for (const Dialect* from : dialects()) {
        EXPECT_EQ(code_of(labels, *from), Code::LimitLpeLabels);
        EXPECT_EQ(code_of(std::string(kMaxTextLength + 1, 'D'), *from), Code::LimitLpeLength);
        EXPECT_EQ(code_of("C" + std::string(5000, '('), *from), Code::LimitLpeNesting);
        EXPECT_EQ(code_of("C" + std::string(5000, '['), *from) == Code::LimitLpeNesting,
                  from != &arnold_dialect());
    }
    EXPECT_EQ(code_of("C.*D.{20}L", osl_dialect()), Code::LimitLpeStates);
    EXPECT_EQ(code_of("CD{300}L", osl_dialect()), Code::LimitLpeRepeat);
    EXPECT_EQ(code_of("C((((D{0,16}){16}){16}){16}){16}L", osl_dialect()), Code::LimitLpeNodes);
    EXPECT_EQ(code_of("C.*D.{9}L - CL", arnold_dialect()), Code::LimitLpeStates);
    // What would be too long or too deep when written out without counts.
    for (const std::string text : {"CD{1,120}L", "CD{1,200}L", "CD{1,256}S{1,256}L"}) {
        Diagnostics deep;
        const auto out = translate(text, {}, arnold_dialect(), karma_dialect(), deep);
        EXPECT_EQ(out.has_value(), !deep.has_errors()) << text;
        EXPECT_TRUE(!out || out->exact) << text;
    }
    Diagnostics diagnostics;
    EXPECT_FALSE(
        translate("C(D{1,200}S){1,200}L", {}, arnold_dialect(), karma_dialect(), diagnostics));
    EXPECT_TRUE(diagnostics.has_errors());
}

TEST(CommonPaths, AreDescribedInWords) {
    EXPECT_EQ(describe_path(must_common_path("C L")),
              "a path that leaves the camera and ends at a light");
    EXPECT_EQ(describe_path(must_common_path("C RG'coat'@'hero' Ts TD V L'key'")),
              "a path that leaves the camera, is reflected glossily by a lobe 'coat' of an object "
              "'hero', goes straight through a surface, is transmitted diffusely, is scattered in "
              "a volume, and ends at a light of group 'key'");
    const std::string path = "C RS'a' TG@'b' Ts V'c' O'd'@'e'";
    EXPECT_EQ(print_path(must_common_path(path)), path);
}

TEST(Dialects, AreFoundByName) {
    for (const Dialect* dialect : dialects())
        EXPECT_EQ(find_dialect(dialect->name), dialect);
    EXPECT_EQ(find_dialect("nuke"), nullptr);
}

}  // namespace
}  // namespace lightsieve::lpe::dialects
