// Tokens, numbers and values of .ass text: everything that can be read without knowing node types.
//
// A value's extent follows from its form alone: `INT INT TYPE` begins an array, a quote a string, a number a run of
// numbers, anything else is one word. Arrays are counted here (so a document knows where each value ends) and decoded
// only when a graph wants them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/diagnostics.h"
#include "core/source.h"
#include "scene/document.h"

namespace lightsieve {

enum class TokenKind : std::uint8_t { End, Open, Close, String, Word };

struct Token {
    TokenKind kind = TokenKind::End;
    std::size_t offset = 0;      ///< first byte
    std::size_t length = 0;      ///< bytes; of a string: with its quotes
    bool first_in_line = false;  ///< only blanks stand before it
    bool closed = true;          ///< of a string: it has its closing quote
};

/// Splits text into tokens; blanks and comments are skipped. Copying one is a look-ahead.
class AssLexer {
  public:
    explicit AssLexer(std::string_view text, std::size_t at = 0) : text_(text), at_(at) {}
    [[nodiscard]] Token next();
    /// The next character that is neither blank nor in a comment, or 0 at the end. Moves to it.
    char peek();
    [[nodiscard]] std::size_t position() const { return at_; }
    void seek(std::size_t at) { at_ = at; }
    [[nodiscard]] std::string_view text() const { return text_; }
    [[nodiscard]] std::string_view text(const Token& token) const {
        return text_.substr(token.offset, token.length);
    }

  private:
    std::string_view text_;
    std::size_t at_;
};

/// Blank: space, tab, line ends, vertical tab, form feed.
[[nodiscard]] bool is_ass_blank(char c);

/// A float as C writes it, inf and nan in all their spellings included; nothing if `token` is none. Too large is infinite,
/// too small 0 or denormal.
[[nodiscard]] std::optional<float> parse_float(std::string_view token);
/// A whole number; also "4.0" and "1e3". Nothing if `token` is none or does not fit.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view token);

/// The text of a quoted token: without quotes, \" and \\ replaced.
[[nodiscard]] std::string unquote(std::string_view token);

/// The type of that name ("VECTOR", "POINT", "NODE", ...), or nothing.
[[nodiscard]] std::optional<ParamType> parse_type(std::string_view text);

/// A parameter's name with suffixes, taken apart.
struct ParamName {
    std::string_view base;
    std::int64_t element = -1;   ///< -1: none
    std::int8_t component = -1;  ///< -1: none
};
/// Nothing if `text` cannot be a parameter's name.
[[nodiscard]] std::optional<ParamName> parse_param_name(std::string_view text);
/// 0..3 for r g b a x y z, else -1 (x is r).
[[nodiscard]] std::int8_t parse_component(std::string_view text);

/// Reads the value at the lexer's position.
///
/// source        the lexer's text, for places
/// source_index  its index in the document
/// what          the parameter's name, for messages
/// returns       nothing with an error reported if there is no value or an array is damaged; the lexer then stands after
///               what could be read
[[nodiscard]] std::optional<ValueText> lex_value(AssLexer& lexer,
                                                 const std::shared_ptr<const SourceText>& source,
                                                 std::uint32_t source_index, std::string_view what,
                                                 Diagnostics& diagnostics);

}  // namespace lightsieve
