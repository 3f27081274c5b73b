#include "lpe/cursor.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "lpe/parse.h"

namespace lightsieve::lpe {
namespace {

bool is_small(char c) { return c >= 'a' && c <= 'z'; }
bool is_word(char c) { return is_name_character(c); }

/// Characters of other alphabets that look like one of the language.
struct LookAlike {
    std::uint32_t code_point;
    char meant;
};
constexpr std::array kLookAlikes{
    // Greek
    LookAlike{0x0391, 'A'},
    LookAlike{0x0392, 'B'},
    LookAlike{0x039F, 'O'},
    LookAlike{0x03A4, 'T'},
    LookAlike{0x03F9, 'C'},
    // Cyrillic
    LookAlike{0x0405, 'S'},
    LookAlike{0x0410, 'A'},
    LookAlike{0x0412, 'B'},
    LookAlike{0x041E, 'O'},
    LookAlike{0x0421, 'C'},
    LookAlike{0x0422, 'T'},
    LookAlike{0x0441, 'c'},
    LookAlike{0x0474, 'V'},
    // Armenian
    LookAlike{0x054D, 'S'},
    LookAlike{0x0555, 'O'},
    LookAlike{0x053C, 'L'},
    // Cherokee
    LookAlike{0x13A1, 'R'},
    LookAlike{0x13A2, 'T'},
    LookAlike{0x13DA, 'S'},
    LookAlike{0x13D9, 'V'},
    LookAlike{0x13DF, 'C'},
    LookAlike{0x13A0, 'D'},
    LookAlike{0x13DE, 'L'},
    LookAlike{0x13AA, 'A'},
    // punctuation that word processors and web pages put in
    LookAlike{0x00A0, ' '},
    LookAlike{0x2018, '\''},
    LookAlike{0x2019, '\''},
    LookAlike{0x2032, '\''},
    LookAlike{0x02BC, '\''},
    LookAlike{0x2217, '*'},
    LookAlike{0x2039, '<'},
    LookAlike{0x203A, '>'},
    LookAlike{0x2024, '.'},
    LookAlike{0x2223, '|'},
    LookAlike{0x2010, '-'},
    LookAlike{0x2013, '-'},
    LookAlike{0x2014, '-'},
    LookAlike{0x2212, '-'},
};

/// The character that `code_point` looks like, or '\0'.
char look_alike(std::uint32_t code_point) {
    // Full-width forms are the ASCII characters, moved.
    if (code_point > 0xFF00 && code_point < 0xFF5F)
        return static_cast<char>(code_point - 0xFF00 + 0x20);
    for (const LookAlike& row : kLookAlikes)
        if (row.code_point == code_point) return row.meant;
    return '\0';
}

/// The code point of one well-formed UTF-8 character of at least two bytes.
std::uint32_t decode(std::string_view bytes) {
    std::uint32_t value = static_cast<unsigned char>(bytes[0]) & (0x7FU >> bytes.size());
    for (const char c : bytes.substr(1))
        value = value << 6U | (static_cast<unsigned char>(c) & 0x3FU);
    return value;
}

std::string hexadecimal(std::uint32_t value, const char* format) {
    std::array<char, 16> out{};
    const int n = std::snprintf(out.data(), out.size(), format, value);
    return {out.data(), static_cast<std::size_t>(n)};
}

/// What to do about an ASCII character that is no letter.
std::string punctuation_hint(char c) {
    switch (c) {
        case '"': return "a label stands in single quotes: 'coat'";
        case '^': return "\"not\" is [^..]; an expression always takes the whole path";
        case '$': return "an expression always takes the whole path: nothing marks its end";
        case '\\': return "there are no escapes";
        default: return "operators are * + ? {n,m} | ( ) [ ] [^ ] and <..>";
    }
}

}  // namespace

bool is_name_character(char c) {
    return is_small(c) || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

std::string letter_hint(std::string_view letters) {
    if (letters == "G" || letters == "s") return "OSL has glossy and straight; here S covers both";
    if (letters == "E") return "the camera is C";
    if (letters.size() > 1)
        return "a label is quoted: '" + std::string(letters) + "'; events are capital letters";
    const char capital = static_cast<char>(letters[0] - 'a' + 'A');
    if (is_small(letters[0]) && kEventLetters.find(capital) != std::string_view::npos)
        return "events are capital letters: " + in_quotes({&capital, 1});
    return "events are C D S R T V L O B A and . (any); a label is quoted: '" +
           std::string(letters) + "'";
}

SourceSpan stand_alone(std::string_view text, std::string_view name) {
    SourceText source{std::string(name), std::string(text)};
    return {std::make_shared<const SourceText>(std::move(source)), 0, text.size()};
}

Cursor::Cursor(std::string_view text, SourceSpan base, std::string_view aov_name,
               Diagnostics& diagnostics)
    : text_(text), base_(std::move(base)), diagnostics_(diagnostics) {
    if (!base_.known()) base_ = stand_alone(text);
    if (!aov_name.empty()) prefix_ = "AOV " + in_quotes(aov_name) + ": ";
}

bool Cursor::take_if(char c) {
    if (at_end() || text_[position_] != c) return false;
    ++position_;
    return true;
}

bool Cursor::starts_reference() const {
    if (at_end() || text_[position_] != '$' || position_ + 1 >= text_.size()) return false;
    return text_[position_ + 1] == '{' || is_name_character(text_[position_ + 1]);
}

bool Cursor::skip_blanks() {
    const std::size_t before = position_;
    while (peek_is_one_of(kBlanks))
        ++position_;
    return position_ > before;
}

std::size_t Cursor::character_length() const {
    const auto first = static_cast<unsigned char>(text_[position_]);
    const std::size_t length = first >= 0xF0 && first < 0xF8   ? 4
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xC2 && first < 0xE0 ? 2
                                                               : 1;
    const std::string_view bytes = text_.substr(position_, length);
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    const bool whole =
        bytes.size() == length && std::all_of(bytes.begin() + 1, bytes.end(), continues);
    return whole ? length : 1;
}

SourceSpan Cursor::span(std::size_t begin, std::size_t end) const {
    // The source holds the text byte for byte only if it has no escapes.
    if (base_.length != text_.size()) return base_;
    return {base_.source, base_.offset + begin, end - begin};
}

void Cursor::error(Code code, std::string message, std::size_t begin, std::size_t end,
                   std::string hint) {
    ++n_errors_;
    diagnostics_.error(code, prefix_ + message, span(begin, end), std::move(hint));
}

void Cursor::lint(Code code, std::string message, std::size_t begin, std::size_t end,
                  std::string hint) {
    diagnostics_.lint(code, prefix_ + message, span(begin, end), std::move(hint));
}

std::string Cursor::read_label() {
    const std::size_t begin = position_;
    const std::size_t end = text_.find('\'', begin + 1);
    if (end == std::string_view::npos) {
        std::size_t word_end = begin + 1;
        while (word_end < text_.size() && is_word(text_[word_end]))
            ++word_end;
        const std::string word(text_.substr(begin + 1, word_end - begin - 1));
        error(Code::LpeUnclosed, "a quote that never ends", begin, begin + 1,
              "close the label: '" + (word.empty() ? "coat" : word) + "'");
        abandon();
        return "";
    }
    position_ = end + 1;
    if (end == begin + 1)
        error(Code::LpeLabel, "an empty label", begin, position_,
              "a label has at least one character between its quotes");
    return std::string(text_.substr(begin + 1, end - begin - 1));
}

void Cursor::reject_character() {
    const std::size_t begin = position_;
    const std::size_t length = character_length();
    const char c = peek();
    position_ += length;
    if (length > 1) {
        const std::string_view character = text_.substr(begin, length);
        const std::uint32_t code_point = decode(character);
        const std::string name =
            in_quotes(character) + " (" + hexadecimal(code_point, "U+%04X") + ")";
        const char meant = look_alike(code_point);
        if (meant != '\0')
            return error(Code::LpeLookAlike, name + " only looks like " + in_quotes({&meant, 1}),
                         begin, position_, "type " + in_quotes({&meant, 1}) + " itself");
        return error(Code::LpeCharacter, "unexpected character " + name, begin, position_,
                     "only labels, in single quotes, can hold such characters");
    }
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7F)
        return error(Code::LpeCharacter,
                     "unexpected byte " + hexadecimal(static_cast<unsigned char>(c), "0x%02x"),
                     begin, position_, "expressions are UTF-8 text");
    if (c == ')' || c == ']' || c == '}' || c == '>')
        return error(Code::LpeUnclosed, in_quotes({&c, 1}) + " closes nothing", begin, position_,
                     "remove it, or open it before");
    if (!is_word(c) || c == '_' || (c >= '0' && c <= '9'))
        return error(Code::LpeCharacter, "unexpected character " + in_quotes({&c, 1}), begin,
                     position_, punctuation_hint(c));
    // A run of small letters is one mistake, not one for each letter.
    if (is_small(c))
        while (!at_end() && is_word(peek()) && !(peek() >= 'A' && peek() <= 'Z'))
            ++position_;
    const std::string_view letters = text_.substr(begin, position_ - begin);
    error(Code::LpeEvent, "no event " + in_quotes(letters), begin, position_,
          letter_hint(letters));
}

}  // namespace lightsieve::lpe
