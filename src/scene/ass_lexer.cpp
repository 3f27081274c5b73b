#include "scene/ass_lexer.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <utility>

#include "scene/ass_packed.h"

namespace lightsieve {
namespace {

enum : std::uint8_t { kBlank = 1, kDelimiter = 2, kNumberStart = 4 };

constexpr std::array<std::uint8_t, 256> make_classes() {
    std::array<std::uint8_t, 256> table{};
    for (const unsigned char c : {' ', '\t', '\n', '\v', '\f', '\r'})
        table[c] = kBlank | kDelimiter;
    for (const unsigned char c : {'{', '}', '"'})
        table[c] = kDelimiter;
    for (unsigned char c = '0'; c <= '9'; ++c)
        table[c] = kNumberStart;
    for (const unsigned char c : {'+', '-', '.'})
        table[c] = kNumberStart;
    return table;
}
constexpr std::array<std::uint8_t, 256> kClass = make_classes();

std::uint8_t class_of(char c) { return kClass[static_cast<unsigned char>(c)]; }

/// MSVC's run time wrote these before 2015; other writers use what from_chars reads.
std::optional<float> parse_msvc_special(std::string_view token) {
    const bool negative = !token.empty() && token.front() == '-';
    if (negative) token.remove_prefix(1);
    if (!token.starts_with("1.#")) return std::nullopt;
    const float sign = negative ? -1.0F : 1.0F;
    if (token.substr(3).starts_with("INF")) return sign * std::numeric_limits<float>::infinity();
    return std::copysign(std::numeric_limits<float>::quiet_NaN(), sign);
}

struct TypeName {
    std::string_view text;
    ParamType type;
};
constexpr std::array kTypeNames{
    TypeName{"BOOL", ParamType::Bool},      TypeName{"BYTE", ParamType::Byte},
    TypeName{"INT", ParamType::Int},        TypeName{"UINT", ParamType::UInt},
    TypeName{"FLOAT", ParamType::Float},    TypeName{"RGB", ParamType::Rgb},
    TypeName{"RGBA", ParamType::Rgba},      TypeName{"VECTOR", ParamType::Vector},
    TypeName{"POINT", ParamType::Vector},   TypeName{"VECTOR2", ParamType::Vector2},
    TypeName{"POINT2", ParamType::Vector2}, TypeName{"STRING", ParamType::String},
    TypeName{"ENUM", ParamType::Enum},      TypeName{"MATRIX", ParamType::Matrix},
    TypeName{"NODE", ParamType::Node},      TypeName{"POINTER", ParamType::Node},
};

}  // namespace

bool is_ass_blank(char c) { return (class_of(c) & kBlank) != 0; }

char AssLexer::peek() {
    while (at_ < text_.size()) {
        const char c = text_[at_];
        if (is_ass_blank(c)) {
            ++at_;
        } else if (c == '#') {
            const std::size_t newline = text_.find('\n', at_);
            at_ = newline == std::string_view::npos ? text_.size() : newline + 1;
        } else {
            return c;
        }
    }
    return '\0';
}

Token AssLexer::next() {
    const std::size_t before = at_;
    const char c = peek();
    Token token;
    token.offset = at_;
    token.first_in_line =
        before == 0 ||
        (at_ > before && text_.substr(before, at_ - before).find('\n') != std::string_view::npos);
    if (at_ == text_.size()) return token;
    std::size_t end = at_ + 1;
    if (c == '{' || c == '}') {
        token.kind = c == '{' ? TokenKind::Open : TokenKind::Close;
    } else if (c == '"') {
        token.kind = TokenKind::String;
        while (end < text_.size() && text_[end] != '"')
            end += text_[end] == '\\' && end + 1 < text_.size() ? 2 : 1;
        token.closed = end < text_.size();
        if (token.closed) ++end;
    } else {
        token.kind = TokenKind::Word;
        while (end < text_.size() && (class_of(text_[end]) & kDelimiter) == 0)
            ++end;
    }
    token.length = end - at_;
    at_ = end;
    return token;
}

std::optional<float> parse_float(std::string_view token) {
    const char* first = token.data();
    const char* last = first + token.size();
    if (first != last && *first == '+') {
        ++first;
        if (first != last && (*first == '+' || *first == '-')) return std::nullopt;
    }
    float value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error == std::errc() && end == last) return value;
    if (error == std::errc::result_out_of_range && end == last)
        return std::strtof(std::string(first, last).c_str(), nullptr);
    return parse_msvc_special(token);
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
    const char* first = token.data();
    const char* last = first + token.size();
    if (first != last && *first == '+') ++first;
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error == std::errc() && end == last && first != last) return value;
    // Whole numbers in a float's clothes. Doubles hold every 32-bit integer exactly.
    double number = 0;
    const auto [float_end, float_error] = std::from_chars(first, last, number);
    if (float_error != std::errc() || float_end != last || std::abs(number) > 1e15 ||
        number != std::floor(number))
        return std::nullopt;
    return static_cast<std::int64_t>(number);
}

std::string unquote(std::string_view token) {
    if (!token.empty() && token.front() == '"') token.remove_prefix(1);
    std::string out;
    out.reserve(token.size());
    for (std::size_t i = 0; i < token.size(); ++i) {
        if (token[i] == '"') break;
        if (token[i] == '\\' && i + 1 < token.size() &&
            (token[i + 1] == '"' || token[i + 1] == '\\'))
            ++i;
        out += token[i];
    }
    return out;
}

std::optional<ParamType> parse_type(std::string_view text) {
    for (const TypeName& row : kTypeNames)
        if (row.text == text) return row.type;
    return std::nullopt;
}

std::int8_t parse_component(std::string_view text) {
    if (text.size() != 1) return -1;
    switch (text[0]) {
        case 'r':
        case 'x': return 0;
        case 'g':
        case 'y': return 1;
        case 'b':
        case 'z': return 2;
        case 'a': return 3;
        default: return -1;
    }
}

std::optional<ParamName> parse_param_name(std::string_view text) {
    ParamName name;
    if (text.size() > 2 && text[text.size() - 2] == '.') {
        name.component = parse_component(text.substr(text.size() - 1));
        if (name.component >= 0) text.remove_suffix(2);
    }
    if (text.size() > 2 && text.back() == ']') {
        const std::size_t open = text.find('[');
        if (open == std::string_view::npos) return std::nullopt;
        const char* last = text.data() + text.size() - 1;
        const auto [end, error] = std::from_chars(text.data() + open + 1, last, name.element);
        if (error != std::errc() || end != last || name.element < 0) return std::nullopt;
        text = text.substr(0, open);
    }
    const char first = text.empty() ? '\0' : text[0];
    const bool starts_well =
        (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') || first == '_';
    if (!starts_well || text.find('[') != std::string_view::npos) return std::nullopt;
    for (const char c : text)
        if (static_cast<unsigned char>(c) < 0x20) return std::nullopt;
    name.base = text;
    return name;
}

namespace {

/// Reads one value; holds what every step needs.
class ValueLexer {
  public:
    ValueLexer(AssLexer& lexer, const std::shared_ptr<const SourceText>& source,
               std::uint32_t source_index, std::string_view what, Diagnostics& diagnostics)
        : lexer_(lexer),
          source_(source),
          source_index_(source_index),
          what_(what),
          diagnostics_(diagnostics) {}

    std::optional<ValueText> read() {
        AssLexer ahead = lexer_;
        const Token token = ahead.next();
        ValueText value;
        value.range = {source_index_, token.offset, token.length};
        switch (token.kind) {
            case TokenKind::End:
            case TokenKind::Open:
            case TokenKind::Close:
                diagnostics_.error(Code::AssSyntax,
                                   "parameter \"" + std::string(what_) + "\" has no value",
                                   name_or(token));
                return std::nullopt;
            case TokenKind::String: return strings(value) ? std::optional(value) : std::nullopt;
            case TokenKind::Word: break;
        }
        const std::string_view word = lexer_.text(token);
        if (!starts_number(word)) {
            lexer_ = ahead;
            value.form = ValueForm::Word;
            return value;
        }
        bool is_head = false;
        if (array_head(value, is_head)) return array(value) ? std::optional(value) : std::nullopt;
        if (is_head) return std::nullopt;
        numbers(value);
        return value;
    }

  private:
    [[nodiscard]] SourceSpan at(std::size_t offset, std::size_t length) const {
        return {source_, offset, length};
    }
    /// The parameter's name if it lies in this text; a value that is being edited stands alone.
    [[nodiscard]] SourceSpan name_or(const Token& token) const {
        const std::string_view text = lexer_.text();
        const std::less_equal<const char*> before;
        const bool inside = before(text.data(), what_.data()) &&
                            before(what_.data() + what_.size(), text.data() + text.size());
        return inside ? at(static_cast<std::size_t>(what_.data() - text.data()), what_.size())
                      : at(token.offset, token.length);
    }
    void finish(ValueText& value, std::size_t end) const {
        value.range.length = end - value.range.offset;
    }

    /// A whole number: names may begin with digits ("0test"), and parameters may be called "info".
    static bool starts_number(std::string_view word) {
        if ((class_of(word[0]) & kNumberStart) == 0 && word[0] != 'i' && word[0] != 'I' &&
            word[0] != 'n' && word[0] != 'N')
            return false;
        return parse_float(word).has_value();
    }

    bool strings(ValueText& value) {
        value.form = ValueForm::Strings;
        while (lexer_.peek() == '"') {
            const Token token = lexer_.next();
            if (!token.closed) {
                unclosed(token);
                return false;
            }
            finish(value, token.offset + token.length);
        }
        return true;
    }

    /// Goes on at the line after the quote: what follows is more likely to be parameters than text.
    void unclosed(const Token& token) {
        diagnostics_.error(
            Code::AssUnclosed, "the string of \"" + std::string(what_) + "\" does not end",
            at(token.offset, 1), "add the closing quote; if the file was cut off, write it again");
        const std::size_t newline = lexer_.text().find('\n', token.offset);
        lexer_.seek(newline == std::string_view::npos ? lexer_.text().size() : newline);
    }

    void numbers(ValueText& value) {
        value.form = ValueForm::Numbers;
        for (;;) {
            AssLexer ahead = lexer_;
            const Token token = ahead.next();
            if (token.kind != TokenKind::Word || !starts_number(lexer_.text(token))) return;
            lexer_ = ahead;
            finish(value, token.offset + token.length);
        }
    }

    static bool whole(std::string_view word, std::uint64_t& value) {
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error == std::errc::result_out_of_range)
            value = std::numeric_limits<std::uint64_t>::max();
        return error != std::errc::invalid_argument && end == word.data() + word.size();
    }
    static bool looks_like_type(std::string_view word) {
        // A whole number is a third value: `position 0 1 3000`.
        if (word.size() < 3 || (word[0] >= '0' && word[0] <= '9')) return false;
        for (const char c : word)
            if (!((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_')) return false;
        return true;
    }

    /// `COUNT KEYS TYPE`. `is_head` is set if it is one, even a bad one; the lexer then stands after it.
    bool array_head(ValueText& value, bool& is_head) {
        AssLexer ahead = lexer_;
        const Token n_token = ahead.next(), keys_token = ahead.next(), type_token = ahead.next();
        std::uint64_t n = 0, n_keys = 0;
        if (keys_token.kind != TokenKind::Word || type_token.kind != TokenKind::Word) return false;
        if (!whole(lexer_.text(n_token), n) || !whole(lexer_.text(keys_token), n_keys))
            return false;
        std::string_view type_name = lexer_.text(type_token);
        value.array.encoding = ArrayEncoding::Text;
        if (type_name.starts_with("b85") || type_name.starts_with("b64")) {
            value.array.encoding = type_name[1] == '8' ? ArrayEncoding::B85 : ArrayEncoding::B64;
            type_name.remove_prefix(3);
        }
        const std::optional<ParamType> type = parse_type(type_name);
        const SourceSpan head =
            at(n_token.offset, type_token.offset + type_token.length - n_token.offset);
        const bool same_line = !keys_token.first_in_line && !type_token.first_in_line;
        if (!type && !(same_line && (looks_like_type(type_name) ||
                                     value.array.encoding != ArrayEncoding::Text)))
            return false;
        is_head = true;
        lexer_ = ahead;
        const bool packed_text =
            type && value.array.encoding != ArrayEncoding::Text &&
            (*type == ParamType::String || *type == ParamType::Node || *type == ParamType::Enum);
        if (!type || packed_text) {
            diagnostics_.error(Code::AssSyntax,
                               "\"" + std::string(lexer_.text(type_token)) + "\" is no array type",
                               at(type_token.offset, type_token.length),
                               "types are BOOL BYTE INT UINT FLOAT RGB RGBA VECTOR VECTOR2 "
                               "MATRIX, also with b85 or b64 before, and STRING NODE ENUM");
            skip_data();
            return false;
        }
        constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
        if (n_keys == 0 && n > 0) {
            diagnostics_.error(Code::ArrayCount,
                               "array \"" + std::string(what_) + "\" has " + std::to_string(n) +
                                   " elements but 0 motion keys",
                               head, "write 1 for an array without motion");
            return false;
        }
        if (n == 0) n_keys = 1;
        // More than a file can hold: let the count fail, not the arithmetic.
        value.array.n = static_cast<std::uint32_t>(std::min(n, kMax));
        value.array.n_keys = static_cast<std::uint32_t>(std::min(n_keys, kMax));
        n_elements_ = n > kMax || n_keys > kMax ? std::numeric_limits<std::uint64_t>::max() / 64
                                                : n * n_keys;
        n_elements_ = std::min(n_elements_, std::numeric_limits<std::uint64_t>::max() / 64);
        value.array.type = *type;
        value.array.data_offset = type_token.offset + type_token.length;
        value.form = ValueForm::Array;
        head_ = head;
        return true;
    }

    bool array(ValueText& value) {
        if (value.array.encoding != ArrayEncoding::Text) return packed_array(value);
        const std::uint64_t n_tokens = n_elements_ * component_count(value.array.type);
        std::size_t end = value.array.data_offset;
        std::uint64_t found = 0;
        switch (value.array.type) {
            case ParamType::String:
            case ParamType::Node: found = count_texts(n_tokens, end); break;
            case ParamType::Bool:
            case ParamType::Enum: found = count_words(n_tokens, end); break;
            default: found = count_numbers(n_tokens, end); break;
        }
        finish(value, end);
        if (found < n_tokens) too_short(found / component_count(value.array.type));
        return found == n_tokens;
    }

    void too_short(std::uint64_t n_found) {
        const bool at_end = lexer_.peek() == '\0' && lexer_.position() == lexer_.text().size();
        diagnostics_.error(Code::ArrayCount,
                           "array \"" + std::string(what_) + "\" has " + std::to_string(n_found) +
                               " elements, but its head says " +
                               (n_elements_ < std::numeric_limits<std::uint64_t>::max() / 64
                                    ? std::to_string(n_elements_)
                                    : "more than 4294967295"),
                           head_, at_end ? "the file ends here: it may be cut off" : "");
    }

    /// Numbers only: the bulk of large files.
    std::uint64_t count_numbers(std::uint64_t limit, std::size_t& end) {
        const std::string_view text = lexer_.text();
        const char* p = text.data() + lexer_.position();
        const char* const last = text.data() + text.size();
        std::uint64_t n = 0;
        while (n < limit) {
            while (p != last && is_ass_blank(*p))
                ++p;
            if (p == last) break;
            if (*p == '#') {
                while (p != last && *p != '\n')
                    ++p;
                continue;
            }
            const char* token = p;
            while (p != last && (class_of(*p) & kDelimiter) == 0)
                ++p;
            const bool number =
                p != token && ((class_of(*token) & kNumberStart) != 0 ||
                               parse_float({token, static_cast<std::size_t>(p - token)}));
            if (!number) {
                p = token;
                break;
            }
            ++n;
            end = static_cast<std::size_t>(p - text.data());
        }
        lexer_.seek(n == limit ? std::max(end, lexer_.position())
                               : static_cast<std::size_t>(p - text.data()));
        return n;
    }

    /// Strings or names; where one is quoted, all are (but NULL), so that a missing one does not swallow a parameter's name.
    std::uint64_t count_texts(std::uint64_t limit, std::size_t& end) {
        std::uint64_t n = 0;
        bool quoted = false, bare = false;
        while (n < limit) {
            AssLexer ahead = lexer_;
            const Token token = ahead.next();
            const bool null = token.kind == TokenKind::Word && lexer_.text(token) == "NULL";
            if (!null) (token.kind == TokenKind::String ? quoted : bare) = true;
            if ((token.kind != TokenKind::String && token.kind != TokenKind::Word) ||
                (quoted && bare))
                break;
            lexer_ = ahead;
            if (!token.closed) {
                unclosed(token);
                break;
            }
            ++n;
            end = token.offset + token.length;
        }
        return n;
    }

    std::uint64_t count_words(std::uint64_t limit, std::size_t& end) {
        std::uint64_t n = 0;
        while (n < limit) {
            AssLexer ahead = lexer_;
            const Token token = ahead.next();
            if (token.kind != TokenKind::Word && token.kind != TokenKind::String) break;
            lexer_ = ahead;
            ++n;
            end = token.offset + token.length;
        }
        return n;
    }

    bool packed_array(ValueText& value) {
        const std::size_t per_element = component_count(value.array.type);
        const bool b85 = value.array.encoding == ArrayEncoding::B85;
        const auto scan = (b85 ? scan_b85 : scan_b64)(lexer_.text(), value.array.data_offset,
                                                      value.array.type, n_elements_ * per_element);
        lexer_.seek(scan.end);
        finish(value, scan.end);
        const std::string name = "\"" + std::string(what_) + "\"";
        switch (scan.error) {
            case PackedError::None: return true;
            case PackedError::TooShort: too_short(scan.n_found / per_element); return false;
            case PackedError::BadLetter:
                diagnostics_.error(
                    Code::ArrayData,
                    "the data of array " + name + " begins with \"" + lexer_.text()[scan.end] +
                        "\", which is no packing that is known",
                    at(scan.end, 1), "b85INT and b85UINT data begin with B, C, E or F");
                break;
            case PackedError::BadCharacter:
                diagnostics_.error(Code::ArrayData,
                                   "the b85 data of array " + name +
                                       " has five characters that stand for no word",
                                   at(scan.end - std::min<std::size_t>(scan.end, 5), 5));
                break;
            case PackedError::RunTooLong:
                diagnostics_.error(
                    Code::ArrayData,
                    "a run in the b85 data of array " + name + " goes on after its last element",
                    at(scan.end - std::min<std::size_t>(scan.end, 5), 5));
                break;
        }
        // Where damaged data ends is unknown; what comes next in line with a name is the best guess.
        skip_data();
        return false;
    }

    /// Moves past characters that could still be packed data: up to a line that begins with a name and has more than one word.
    void skip_data() {
        for (;;) {
            AssLexer ahead = lexer_;
            const Token token = ahead.next();
            if (token.kind != TokenKind::Word) return;  // also at the end
            const bool name =
                token.first_in_line && parse_param_name(lexer_.text(token)) && token.length < 40;
            AssLexer second = ahead;
            if (name && !second.next().first_in_line) return;
            lexer_ = ahead;
        }
    }

    AssLexer& lexer_;
    const std::shared_ptr<const SourceText>& source_;
    std::uint32_t source_index_;
    std::string_view what_;
    Diagnostics& diagnostics_;
    std::uint64_t n_elements_ = 0;
    SourceSpan head_;
};

}  // namespace

std::optional<ValueText> lex_value(AssLexer& lexer,
                                   const std::shared_ptr<const SourceText>& source,
                                   std::uint32_t source_index, std::string_view what,
                                   Diagnostics& diagnostics) {
    return ValueLexer(lexer, source, source_index, what, diagnostics).read();
}

}  // namespace lightsieve
