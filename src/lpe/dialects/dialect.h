// What the translator knows about one renderer's dialect: how it sees common events, how its text
// is read, and with which tests it can be written.
//
// A dialect is one row of the table in dialects.cpp and one file of its own; nothing else names
// it. To add one: write the file (NAME.cpp with `const Dialect& NAME_dialect()`), add the row, add
// tests/lpe/dialects/NAME.toml.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "lpe/dialects/common.h"
#include "lpe/dialects/pattern.h"

namespace lightsieve::lpe::dialects {

/// Something about a dialect that the translator relies on.
struct Fact {
    std::string_view text;    ///< one sentence, for people
    bool verified = false;    ///< documented, read in the source or measured; else inferred
    std::string_view mark{};  ///< matters only where the dialect's text contains it
    std::uint32_t kinds = 0;  ///< matters only where one of these events occurs; 0: always
    /// The bit of a kind in `kinds`.
    [[nodiscard]] static constexpr std::uint32_t bit(CommonKind kind) {
        return std::uint32_t{1} << static_cast<unsigned>(kind);
    }
};

/// How a dialect sees a common event.
struct View {
    enum class Form : std::uint8_t {
        Hit,        ///< as an event of its own
        Invisible,  ///< it happens, but leaves no event
        Absent,     ///< no expression of the dialect takes a path with it
    };
    Form form = Form::Absent;
    Hit hit{};
};

/// A text that was read.
struct Reading {
    PatternPtr pattern;                                  ///< null after an error
    std::vector<std::string> labels{};                   ///< every label that it names
    std::vector<std::vector<std::string>> label_sets{};  ///< labels that stand in one [..]
    std::vector<std::string> foreign{};                  ///< events that only this dialect has
    std::vector<std::string> foreign_ends{};             ///< the same, at the end of a path
    std::vector<std::string> prefixes{};                 ///< by their common name
    std::vector<std::string> notes{};  ///< what happened while reading that one should know
};

/// A test of an event's letters: on its own (`D`), or inside <..> where labels may follow (`.D`).
struct LetterText {
    std::string alone;   ///< empty: only inside <..>
    std::string inside;  ///< with every place filled up to the labels; empty: takes no labels
    HitTest test;
};
/// A test of labels, as it stands inside <..> after the letters.
struct LabelText {
    std::string text;
    HitTest test;
};

/// A prefix (`unoccluded;`) by its common name and as the dialect spells it.
struct Prefix {
    std::string_view name, spelled;
};

/// How a dialect writes repeats.
enum class Repeats : std::uint8_t {
    StarAndPlus,  ///< * +
    Counts,       ///< * + {n} {n,} {n,m} but no ?
    All,          ///< * + ? {n} {n,} {n,m}
};

struct Dialect {
    std::string_view name;   ///< `arnold`
    std::string_view title;  ///< "Arnold and Lightsieve"
    std::span<const Fact> facts;
    std::span<const Prefix> prefixes;
    Repeats repeats = Repeats::StarAndPlus;
    /// Labels that stand for what the dialect has by other means: numbered lobes.
    std::span<const std::string_view> lobe_labels{};

    View (*view)(const CommonEvent& event);
    /// Reads a text as the renderer does. Errors go to `diagnostics`, also lints about what the
    /// renderer reads otherwise than it looks.
    Reading (*read)(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics);
    /// Reads a text as somebody who knows regular expressions means it; null where that cannot
    /// differ.
    Reading (*read_as_meant)(std::string_view text, const SourceSpan& base,
                             Diagnostics& diagnostics) = nullptr;
    /// The same dialect in a renderer that does more for its expressions; null: there is none. A
    /// translation that is not exact says whether it would be there.
    const Dialect& (*variant)() = nullptr;
    /// The tests of letters that a writer may use, plainest first.
    std::vector<LetterText> (*letters)(const std::vector<std::vector<std::string>>& label_sets);
    /// The tests of labels that a writer may use, plainest first; the first takes all.
    std::vector<LabelText> (*labels)(const std::vector<std::vector<std::string>>& label_sets);
};

/// Every dialect, Arnold's first.
[[nodiscard]] std::span<const Dialect* const> dialects();
/// The dialect of that name, or null.
[[nodiscard]] const Dialect* find_dialect(std::string_view name);

// One function a file.
[[nodiscard]] const Dialect& arnold_dialect();
[[nodiscard]] const Dialect& karma_dialect();
[[nodiscard]] const Dialect& moonray_dialect();
[[nodiscard]] const Dialect& osl_dialect();
[[nodiscard]] const Dialect& osl_placeholder_dialect();
[[nodiscard]] const Dialect& renderman_dialect();

}  // namespace lightsieve::lpe::dialects
