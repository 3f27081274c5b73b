// Text to tree. Recovers from errors, so that one run reports every mistake at its exact column.
//
// The language is docs/lpe-language.md. What needs only the text is reported here: errors, and the
// lints about spelling (`c` for `C`, `<L'key'>`, half-separated groups). Lints that need to know
// which paths an expression takes are in lint.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/diagnostics.h"
#include "lpe/ast.h"

namespace lightsieve::lpe {

/// Longest expression [bytes].
inline constexpr std::size_t kMaxTextLength = std::size_t{64} * 1024;
/// Deepest nesting of parentheses and brackets.
inline constexpr std::size_t kMaxNesting = 256;
/// Largest number in `{n,m}`.
inline constexpr std::uint32_t kMaxRepeat = 256;
/// The reader gives up after so many errors in one expression; Diagnostics keeps no more.
inline constexpr std::size_t kMaxErrorsPerExpression = Diagnostics::kMaxErrors;

/// How far the operands of `|` reach.
enum class AlternationBinding : std::uint8_t {
    Loose,  ///< the whole sequence on each side, as in any regular expression: our language
    Tight,  ///< one item on each side, as OSL and RenderMan read it: `CD|SL` is `C(D|S)L`
};

class ExpressionTable;  // builtins.h

struct ParseOptions {
    std::string_view aov_name{};  ///< put before every message, if there is one
    AlternationBinding binding = AlternationBinding::Loose;
    /// Arnold's language only: `&`, `-`, `!( )` and `$name` are errors (code lpe-standard).
    bool standard = false;
    /// What `$name` means; null: the built-ins of the reference table.
    const ExpressionTable* names = nullptr;
    /// Leave `$name` unresolved: the caller does that with `resolve_references`.
    bool keep_references = false;
};

/// Reads an expression.
///
/// text         the expression
/// base         where the text stands (in a scene file); if its length is that of `text` errors
///              point at the exact column, otherwise (a string with escapes) at the whole of it.
///              Unknown: the text itself is quoted
/// diagnostics  gets every error, and lints about spelling
/// returns      the tree, or null if there was an error
[[nodiscard]] Expr parse(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics,
                         const ParseOptions& options = {});

/// The same for an expression that stands alone; errors quote it as "<expression>".
[[nodiscard]] Expr parse(std::string_view text, Diagnostics& diagnostics);

/// A place that covers the whole of a text of its own, for expressions that come from no file.
[[nodiscard]] SourceSpan stand_alone(std::string_view text,
                                     std::string_view name = "<expression>");

}  // namespace lightsieve::lpe
