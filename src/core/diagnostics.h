// Gathers errors, warnings and lints, so that one run tells a person everything at once.
//
// Parsers recover and go on; the caller decides when to stop. Thread safe: shaders are prepared in parallel.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "core/error.h"

namespace lightsieve {

class Diagnostics {
  public:
    /// Errors kept with their text; more are only counted.
    static constexpr std::size_t kMaxErrors = 20;
    /// Warnings and lints kept with their text; more are only counted.
    static constexpr std::size_t kMaxWarnings = 200;

    Diagnostics() = default;
    Diagnostics(const Diagnostics&) = delete;
    Diagnostics& operator=(const Diagnostics&) = delete;

    /// Adds by the error's own severity. Identical reports (code, message, place) are counted once.
    void add(Error error);
    /// All that was thrown; errors without a place are at `otherwise`.
    void add(const InputError& thrown, const SourceSpan& otherwise = {});
    void error(Code code, std::string message, SourceSpan where = {}, std::string hint = {});
    void warning(Code code, std::string message, SourceSpan where = {}, std::string hint = {});
    void lint(Code code, std::string message, SourceSpan where = {}, std::string hint = {});

    [[nodiscard]] bool has_errors() const { return n_errors_ > 0; }
    [[nodiscard]] std::size_t n_errors() const { return n_errors_; }
    [[nodiscard]] std::size_t n_warnings() const { return n_warnings_; }
    [[nodiscard]] std::size_t n_lints() const { return n_lints_; }
    /// Everything kept, in the order of report.
    [[nodiscard]] const std::vector<Error>& items() const { return items_; }
    /// All rendered one after the other, with a closing line if some were only counted.
    [[nodiscard]] std::string render() const;
    /// Throws `InputError` with all errors kept if there is one.
    void throw_if_errors() const;

  private:
    std::mutex mutex_;
    std::vector<Error> items_;
    std::size_t n_errors_ = 0, n_warnings_ = 0, n_lints_ = 0;
};

/// The candidates nearest to `word` by edit distance, best first, at most `n`; none if all are far.
[[nodiscard]] std::vector<std::string> nearest_names(std::string_view word,
                                                     const std::vector<std::string>& candidates,
                                                     std::size_t n = 3);
/// `did you mean "x"?` with the nearest candidates, or an empty string.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& candidates);

}  // namespace lightsieve
