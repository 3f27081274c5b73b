// What is wrong with an input, where, and what to do about it.
//
// Three kinds of failure are never mixed: input errors and limits are `Error`s, thrown as `InputError`
// at API edges or gathered in `Diagnostics`; bugs of ours stop at LIGHTSIEVE_ASSERT.
// A message says what is wrong with this input, the hint what to do next: lower case, no full stop.
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "core/source.h"

namespace lightsieve {

/// What went wrong; the rows are in error_codes.def.
enum class Code : std::uint16_t {
#define X(enumerator, text, meaning) enumerator,
#include "core/error_codes.def"
#undef X
};

/// The code as people see it, e.g. "unknown-param".
[[nodiscard]] std::string_view code_text(Code code);
/// One line that says what the code means, for the reference.
[[nodiscard]] std::string_view code_meaning(Code code);
/// Every code, in the order of error_codes.def.
[[nodiscard]] std::vector<Code> all_codes();

enum class Severity : std::uint8_t {
    Lint,     ///< legal, but probably not what was meant
    Warning,  ///< something was skipped or replaced; the result may differ from what was asked for
    Error,    ///< the input cannot be used as it is
};

/// A second place that helps to understand an error.
struct Note {
    std::string message;
    SourceSpan where;
};

struct Error {
    Code code{};
    std::string message;
    SourceSpan where{};
    std::string hint{};
    std::vector<Note> notes{};
    Severity severity = Severity::Error;

    /// The text that a person sees: `file:line:col: error[code]: message`, the line with carets, hint, notes.
    [[nodiscard]] std::string render() const;
};

/// Thrown where a call cannot return anything useful; carries every error found so far.
class InputError : public std::exception {
  public:
    explicit InputError(Error error);
    explicit InputError(std::vector<Error> errors);
    [[nodiscard]] const std::vector<Error>& errors() const { return errors_; }
    [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

  private:
    std::vector<Error> errors_;
    std::string text_;
};

/// Prints the failed condition and asks for a report, then aborts. Never returns.
[[noreturn]] void report_bug(const char* condition, const char* file, int line,
                             const std::string& values);

}  // namespace lightsieve

/// Stops with a report when an invariant of ours is broken; `values` is a string built only then.
#define LIGHTSIEVE_ASSERT(condition, values) \
    ((condition) ? void() : ::lightsieve::report_bug(#condition, __FILE__, __LINE__, (values)))
