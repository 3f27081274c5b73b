// A position in an expression's text, and reports about places in it. Shared by the readers of
// expressions and paths.
//
// Internal to the parsers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/diagnostics.h"

namespace lightsieve::lpe {

/// White space: free everywhere outside of labels.
inline constexpr std::string_view kBlanks = " \t\r\n\v\f";
/// The letters that stand for an event.
inline constexpr std::string_view kEventLetters = "CDSRTVLOBA";

class Cursor {
  public:
    /// base      where `text` stands; unknown: the text becomes a source of its own
    /// aov_name  put before every message, if not empty
    Cursor(std::string_view text, SourceSpan base, std::string_view aov_name,
           Diagnostics& diagnostics);

    [[nodiscard]] bool at_end() const { return position_ >= text_.size(); }
    /// The next byte; '\0' at the end (a NUL in the text is told apart by `at_end`).
    [[nodiscard]] char peek() const { return at_end() ? '\0' : text_[position_]; }
    [[nodiscard]] bool peek_is_one_of(std::string_view set) const {
        return !at_end() && set.find(peek()) != std::string_view::npos;
    }
    char take() { return text_[position_++]; }
    /// Takes `c` if it is next.
    bool take_if(char c);
    /// Is a `$name` or `${name}` next? A `$` alone is not.
    [[nodiscard]] bool starts_reference() const;
    /// Skips white space; returns whether there was any.
    bool skip_blanks();

    [[nodiscard]] std::size_t position() const { return position_; }
    void move_to(std::size_t position) { position_ = position; }
    /// Gives up on the rest of the text: what is missing there follows from an error already
    /// reported.
    void abandon() {
        position_ = text_.size();
        abandoned_ = true;
    }
    [[nodiscard]] bool abandoned() const { return abandoned_; }
    [[nodiscard]] std::string_view text() const { return text_; }
    [[nodiscard]] std::string_view text(std::size_t begin, std::size_t end) const {
        return text_.substr(begin, end - begin);
    }
    /// Bytes of the character (UTF-8) at the position; 1 for a byte that starts none.
    [[nodiscard]] std::size_t character_length() const;

    /// The place of the bytes [begin, end) in the source.
    [[nodiscard]] SourceSpan span(std::size_t begin, std::size_t end) const;
    void error(Code code, std::string message, std::size_t begin, std::size_t end,
               std::string hint = {});
    void lint(Code code, std::string message, std::size_t begin, std::size_t end,
              std::string hint = {});
    [[nodiscard]] std::size_t n_errors() const { return n_errors_; }

    /// Reads a label, the quote being next. Returns the text between the quotes, or "" after an
    /// error.
    std::string read_label();
    /// Skips one character (UTF-8).
    void skip_character() { position_ += character_length(); }
    /// Reports and skips the character (or run of small letters) that is next and means nothing
    /// here.
    void reject_character();

  private:
    std::string_view text_;
    SourceSpan base_;
    std::string prefix_;
    Diagnostics& diagnostics_;
    std::size_t position_ = 0;
    std::size_t n_errors_ = 0;
    bool abandoned_ = false;
};

/// Can it stand in a `$name` without braces?
[[nodiscard]] bool is_name_character(char c);

/// `"x"`, for messages.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// What to do about a letter that is no event: G and s of OSL, E, small letters, labels without
/// quotes.
[[nodiscard]] std::string letter_hint(std::string_view letters);

}  // namespace lightsieve::lpe
