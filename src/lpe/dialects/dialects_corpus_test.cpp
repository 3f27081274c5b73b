// The corpus of dialects in tests/lpe/dialects; its README says how to add a row.
#include <algorithm>
#include <filesystem>

#include "lpe/dialects/dialects_test_support.h"
#include "lpe/dialects/translate.h"
#include "lpe/testing/toml.h"

namespace lightsieve::lpe::dialects {
namespace {

namespace fs = std::filesystem;
using testing::TomlEntry;
using testing::TomlTable;

const Dialect& dialect_of(const TomlEntry& entry, const std::string& key) {
    const Dialect* dialect = find_dialect(entry.text(key));
    if (dialect == nullptr) throw std::invalid_argument("no dialect " + entry.text(key));
    return *dialect;
}

std::vector<std::string> expected(const TomlEntry& entry, const std::string& key) {
    std::vector<std::string> out;
    for (const TomlTable& table : entry.tables(key))
        out.push_back(std::get<std::string>(table.at("code").value) + "@" +
                      std::to_string(std::get<std::int64_t>(table.at("column").value)));
    return out;
}

std::vector<std::string> found(const Diagnostics& diagnostics, Severity severity) {
    std::vector<std::string> out;
    for (const Error& error : diagnostics.items()) {
        if (error.severity != severity) continue;
        out.push_back(std::string(code_text(error.code)) + "@" +
                      std::to_string(error.where.line_column().column));
        EXPECT_NE(error.hint, "") << error.render();
    }
    return out;
}

/// [[case]]: one text of one dialect and what it takes, or what is wrong with it.
void check_case(const TomlEntry& entry) {
    const Dialect& dialect = dialect_of(entry, "dialect");
    const std::string text = entry.text("expression");
    Diagnostics diagnostics;
    const bool good = read_as(text, {}, dialect, diagnostics).has_value();
    EXPECT_EQ(good, !diagnostics.has_errors());
    EXPECT_EQ(found(diagnostics, Severity::Error), expected(entry, "errors"))
        << diagnostics.render();
    EXPECT_EQ(found(diagnostics, Severity::Lint), expected(entry, "lints"))
        << diagnostics.render();
    if (!good) return;
    ASSERT_FALSE(entry.texts("takes").empty() && entry.texts("leaves").empty())
        << "a case without paths proves nothing";
    for (const std::string& path : entry.texts("takes"))
        EXPECT_TRUE(naive_takes(dialect, text, must_common_path(path))) << path;
    for (const std::string& path : entry.texts("leaves"))
        EXPECT_FALSE(naive_takes(dialect, text, must_common_path(path))) << path;
}

std::string shown(const std::optional<CommonPath>& path) { return path ? print_path(*path) : ""; }

/// [[translation]]: text, witnesses, and for which scenes it is exact.
void check_translation(const TomlEntry& entry) {
    Diagnostics diagnostics;
    const auto out = translate(entry.text("expression"), {}, dialect_of(entry, "from"),
                               dialect_of(entry, "to"), diagnostics);
    ASSERT_TRUE(out.has_value()) << diagnostics.render();
    EXPECT_EQ(out->text, entry.text("text"));
    EXPECT_EQ(shown(out->lost), entry.text("lost"));
    EXPECT_EQ(shown(out->added), entry.text("added"));
    EXPECT_EQ(out->lost_prefixes, entry.texts("lost_prefixes"));
    std::vector<std::string> without;
    for (const Without one : out->exact_without)
        without.emplace_back(without_name(one));
    EXPECT_EQ(without, entry.texts("exact_without"));
    const bool lossy = out->text.empty() || out->lost || out->added || !out->lost_prefixes.empty();
    EXPECT_EQ(out->exact, !lossy);
}

/// [[reading]]: what a renderer does with a text, and what was meant.
void check_reading(const TomlEntry& entry) {
    Diagnostics diagnostics;
    const auto out =
        read_as(entry.text("expression"), {}, dialect_of(entry, "dialect"), diagnostics);
    ASSERT_TRUE(out.has_value()) << diagnostics.render();
    EXPECT_EQ(out->text, entry.text("text"));
    EXPECT_EQ(out->meant, entry.text("meant"));
    EXPECT_EQ(shown(out->missed), entry.text("missed"));
    EXPECT_EQ(shown(out->extra), entry.text("extra"));
    EXPECT_EQ(out->differs, out->missed || out->extra);
}

TEST(DialectCorpus, EveryRowHolds) {
    std::size_t n_rows = 0;
    std::vector<fs::path> files;
    for (const auto& file : fs::directory_iterator(LIGHTSIEVE_SOURCE_DIR "/tests/lpe/dialects"))
        if (file.path().extension() == ".toml") files.push_back(file.path());
    std::ranges::sort(files);
    for (const fs::path& file : files)
        for (const TomlEntry& entry : testing::read_toml(file)) {
            SCOPED_TRACE(file.filename().string() + ":" + std::to_string(entry.line) + " " +
                         entry.text("expression"));
            if (entry.name == "case") check_case(entry);
            if (entry.name == "translation") check_translation(entry);
            if (entry.name == "reading") check_reading(entry);
            ++n_rows;
        }
    // A corpus that was not found must not pass.
    EXPECT_GE(n_rows, 150U);
}

}  // namespace
}  // namespace lightsieve::lpe::dialects
