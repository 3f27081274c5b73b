// From one renderer's dialect to another's: the same set of paths, proved, or what is lost.
//
// The text is read as its renderer reads it and becomes a set of common paths (common.h). Every
// event is then spelled with the tests of the other dialect, keeping the expression's shape; what
// only the other dialect sees is inserted, what it does not see is left out. The new text is read
// back by the other dialect's own reader, and both sets are compared as automata. So a mistake in
// the writer can only show as a loss, never as a wrong promise.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "lpe/dialects/common.h"
#include "lpe/dialects/dialect.h"
#include "lpe/limits.h"

namespace lightsieve::lpe::dialects {

struct TranslateOptions {
    std::span<const Without> without{};  ///< what no path of the scene has
    Limits limits{};
};

struct Translation {
    std::string text;    ///< in the other dialect; if it is not exact, the nearest that takes all
    bool exact = false;  ///< the same set of common paths; false if there is no text
    std::optional<CommonPath> lost{};          ///< a shortest path that is no longer taken
    std::optional<CommonPath> added{};         ///< a shortest path that is taken now and was not
    std::vector<std::string> lost_prefixes{};  ///< prefixes that the other dialect does not have
    std::vector<Without> exact_without{};      ///< it is exact for scenes without all of these
    std::vector<std::string> notes{};
    std::vector<std::string> unverified{};  ///< what it relies on that is only inferred
};

/// Translates an expression.
///
/// base         where the text stands, as for lpe::parse
/// diagnostics  gets errors in the text, limits, and lints about what its renderer misreads
/// returns      nothing after an error
[[nodiscard]] std::optional<Translation> translate(std::string_view text, const SourceSpan& base,
                                                   const Dialect& from, const Dialect& to,
                                                   Diagnostics& diagnostics,
                                                   const TranslateOptions& options = {});

/// What a renderer really does with a text, beside what its writer most likely meant.
struct AsRead {
    std::string text;   ///< what it is read as, spelled so that nobody can misread it; "": nothing
    std::string meant;  ///< what was most likely meant, in the same dialect; "": cannot be read so
    bool differs = false;
    std::optional<CommonPath> missed{};  ///< a shortest path that is meant and not taken
    std::optional<CommonPath> extra{};   ///< a shortest path that is taken and not meant
    std::vector<std::string> notes{};
};
[[nodiscard]] std::optional<AsRead> read_as(std::string_view text, const SourceSpan& base,
                                            const Dialect& dialect, Diagnostics& diagnostics,
                                            const Limits& limits = {});

}  // namespace lightsieve::lpe::dialects
