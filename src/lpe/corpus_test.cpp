// The corpus of verdicts in tests/lpe/corpus, asked of every engine. tests/lpe/corpus/README.md
// says how to add a row.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "lpe/lint.h"
#include "lpe/parse.h"
#include "lpe/print.h"
#include "lpe/testing/engines.h"
#include "lpe/testing/toml.h"

namespace lightsieve::lpe {
namespace {

namespace fs = std::filesystem;
using testing::TomlEntry;
using testing::TomlTable;

/// Expected or found: code, column, and for errors the hint.
struct Report {
    std::string code;
    std::size_t column;
    std::string hint;
    auto operator<=>(const Report&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Report& report) {
    return out << report.code << "@" << report.column << ": " << report.hint;
}

std::vector<Report> expected_reports(const TomlEntry& entry, const std::string& key) {
    std::vector<Report> out;
    for (const TomlTable& table : entry.tables(key)) {
        const auto hint = table.find("hint");
        out.push_back({std::get<std::string>(table.at("code").value),
                       static_cast<std::size_t>(std::get<std::int64_t>(table.at("column").value)),
                       hint == table.end() ? "" : std::get<std::string>(hint->second.value)});
    }
    return out;
}

std::vector<Report> found_reports(const Diagnostics& diagnostics, Severity severity) {
    std::vector<Report> out;
    for (const Error& error : diagnostics.items()) {
        if (error.severity != severity) continue;
        const std::string hint = severity == Severity::Error ? error.hint : "";
        // All corpus expressions but a few are one line: count characters over the whole text.
        const std::size_t column = error.where.line_column().column;
        out.push_back({std::string(code_text(error.code)), column, hint});
    }
    return out;
}

std::vector<Path> read_paths(const TomlEntry& entry, const std::string& key) {
    std::vector<Path> paths;
    for (const std::string& text : entry.texts(key)) {
        Diagnostics diagnostics;
        std::optional<Path> path = parse_path(text, diagnostics);
        if (path)
            paths.push_back(*std::move(path));
        else
            ADD_FAILURE() << diagnostics.render();
    }
    return paths;
}

void check_verdicts(const Expr& expr, const TomlEntry& entry) {
    const std::vector<Path> accepts = read_paths(entry, "accepts");
    const std::vector<Path> rejects = read_paths(entry, "rejects");
    std::vector<Path> all = accepts;
    all.insert(all.end(), rejects.begin(), rejects.end());
    ASSERT_FALSE(all.empty()) << "a case without paths proves nothing";
    const testing::Engines engines(expr, testing::events_of(all));
    for (const Path& path : accepts)
        EXPECT_EQ(engines.dissent(path, true), "") << "should take " << print_path(path);
    for (const Path& path : rejects)
        EXPECT_EQ(engines.dissent(path, false), "") << "should not take " << print_path(path);
}

/// A generated row names the first error only, without its hint.
void check_errors(const Diagnostics& diagnostics, const TomlEntry& entry) {
    std::vector<Report> found = found_reports(diagnostics, Severity::Error);
    if (entry.has("generated") && !found.empty()) {
        found.resize(1);
        found[0].hint.clear();
    }
    EXPECT_EQ(found, expected_reports(entry, "errors")) << diagnostics.render();
}

void check_case(const TomlEntry& entry) {
    const std::string text = entry.text("expression");
    Diagnostics diagnostics;
    const Expr expr = parse(text, SourceSpan{}, diagnostics, {.standard = entry.has("standard")});
    check_errors(diagnostics, entry);
    EXPECT_EQ(expr == nullptr, diagnostics.has_errors());
    if (!expr) return;
    check_verdicts(expr, entry);
    if (entry.has("generated")) return;
    lint_expression(text, {}, "", expr, diagnostics);
    std::vector<Report> lints = found_reports(diagnostics, Severity::Lint);
    std::vector<Report> wanted = expected_reports(entry, "lints");
    std::ranges::sort(lints);
    std::ranges::sort(wanted);
    EXPECT_EQ(lints, wanted) << diagnostics.render();
}

std::vector<fs::path> corpus_files() {
    std::vector<fs::path> files;
    for (const auto& file : fs::directory_iterator(LIGHTSIEVE_SOURCE_DIR "/tests/lpe/corpus"))
        if (file.path().extension() == ".toml") files.push_back(file.path());
    std::ranges::sort(files);
    return files;
}

TEST(Corpus, EveryRowHoldsForEveryEngine) {
    std::size_t n_cases = 0, n_reasons = 0;
    for (const fs::path& file : corpus_files()) {
        for (const TomlEntry& entry : testing::read_toml(file)) {
            SCOPED_TRACE(file.filename().string() + ":" + std::to_string(entry.line) + " " +
                         entry.text("expression"));
            check_case(entry);
            ++n_cases;
            n_reasons += entry.has("why") ? 1 : 0;
        }
    }
    // A corpus that was not found, or that has lost rows, must not pass.
    EXPECT_GE(n_cases, 2000U);
    EXPECT_GE(n_reasons, 300U);
}

TEST(Corpus, WhatIsPrintedReadsTheSame) {
    for (const fs::path& file : corpus_files()) {
        for (const TomlEntry& entry : testing::read_toml(file)) {
            Diagnostics diagnostics;
            const Expr expr = parse(entry.text("expression"), diagnostics);
            if (!expr) continue;
            const std::string printed = print(expr);
            EXPECT_TRUE(equal(expr, parse(printed, diagnostics))) << printed;
        }
    }
}

}  // namespace
}  // namespace lightsieve::lpe
