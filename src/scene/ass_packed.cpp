#include "scene/ass_packed.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace lightsieve {
namespace {

constexpr std::uint8_t kNoDigit = 0x80;
constexpr std::uint32_t kOneBits = 0x3f800000;

constexpr std::array<std::uint8_t, 256> make_b85_digits() {
    std::array<std::uint8_t, 256> table{};
    for (std::size_t c = 0; c < 256; ++c)
        table[c] = c >= 36 && c <= 120 ? static_cast<std::uint8_t>(c - 36) : kNoDigit;
    return table;
}
constexpr std::array<std::uint8_t, 256> kB85 = make_b85_digits();

constexpr std::array<std::uint8_t, 256> make_b64_digits() {
    std::array<std::uint8_t, 256> table{};
    table.fill(kNoDigit);
    for (std::uint8_t i = 0; i < 26; ++i) {
        table['A' + std::size_t{i}] = i;
        table['a' + std::size_t{i}] = static_cast<std::uint8_t>(26 + i);
    }
    for (std::uint8_t i = 0; i < 10; ++i)
        table['0' + std::size_t{i}] = static_cast<std::uint8_t>(52 + i);
    table['+'] = 62;
    table['/'] = 63;
    return table;
}
constexpr std::array<std::uint8_t, 256> kB64 = make_b64_digits();

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
std::uint8_t b85_digit(char c) { return kB85[static_cast<unsigned char>(c)]; }

/// Reads words one after the other; the same code scans and decodes, so that both agree on where data ends.
class B85Reader {
  public:
    explicit B85Reader(std::string_view text)
        : p_(text.data()), begin_(text.data()), end_(text.data() + text.size()) {}

    [[nodiscard]] std::size_t position() const { return static_cast<std::size_t>(p_ - begin_); }

    /// The next character that is not blank, or 0.
    char peek() {
        while (p_ != end_ && is_blank(*p_))
            ++p_;
        return p_ == end_ ? '\0' : *p_;
    }
    void skip() { ++p_; }

    /// One word written without a run.
    PackedError word(std::uint32_t& out) {
        if (end_ - p_ >= 5 && five_digits(out))
            return overflow_ ? PackedError::BadCharacter : PackedError::None;
        const char c = peek();
        if (c == 'z' || c == 'y') {
            out = c == 'z' ? 0 : kOneBits;
            ++p_;
            return PackedError::None;
        }
        std::uint64_t value = 0;
        return digits(5, value) ? narrow(value, out) : PackedError::TooShort;
    }

    /// `n` digits, padded to five with the highest digit. False if they are not all there.
    bool digits(int n, std::uint64_t& value) {
        value = 0;
        for (int i = 0; i < 5; ++i) {
            std::uint8_t digit = 84;
            if (i < n) {
                digit = b85_digit(peek());
                if (digit == kNoDigit) return false;
                ++p_;
            }
            value = value * 85 + digit;
        }
        return true;
    }

    /// A word, or a run of `count` of them.
    PackedError words(std::uint32_t& out, std::uint64_t& count) {
        count = 1;
        if (peek() != '!') return word(out);
        ++p_;
        std::uint32_t n = 0;
        PackedError error = word(out);
        if (error == PackedError::None) error = word(n);
        count = n;
        return error;
    }

    static PackedError narrow(std::uint64_t value, std::uint32_t& out) {
        out = static_cast<std::uint32_t>(value);
        return value > 0xffffffffU ? PackedError::BadCharacter : PackedError::None;
    }

  private:
    /// Fast path: five digits without blanks between them.
    bool five_digits(std::uint32_t& out) {
        const std::uint32_t d0 = b85_digit(p_[0]), d1 = b85_digit(p_[1]), d2 = b85_digit(p_[2]),
                            d3 = b85_digit(p_[3]), d4 = b85_digit(p_[4]);
        if (((d0 | d1 | d2 | d3 | d4) & kNoDigit) != 0) return false;
        const std::uint64_t value =
            std::uint64_t{(d0 * 85 + d1) * 85 + d2} * 7225 + (d3 * 85 + d4);
        overflow_ = value > 0xffffffffU;
        out = static_cast<std::uint32_t>(value);
        p_ += 5;
        return true;
    }

    const char* p_;
    const char* begin_;
    const char* end_;
    bool overflow_ = false;
};

/// How the numbers of an array lie in words.
struct Packing {
    std::uint32_t bits = 32;     ///< of one number
    std::uint32_t per_word = 1;  ///< numbers in one word
    bool letter = false;         ///< whether a packing letter comes first
    /// Whether the last, partial word is written as a tail of bytes.
    [[nodiscard]] bool has_tail() const { return bits == 8 || bits == 16; }
};

bool has_letter(ParamType type) { return type == ParamType::Int || type == ParamType::UInt; }

/// The packing of a type; false if `letter` is none.
bool find_packing(ParamType type, char letter, Packing& out) {
    if (type == ParamType::Byte || type == ParamType::Bool) {
        out = {8, 4, false};
    } else if (has_letter(type)) {
        switch (letter) {
            case 'B': out = {8, 4, true}; break;
            case 'C': out = {16, 2, true}; break;
            case 'E': out = {32, 1, true}; break;
            case 'F': out = {10, 3, true}; break;
            default: return false;
        }
    } else {
        out = {32, 1, false};
    }
    return true;
}

/// Full words and tail bytes that hold `n` numbers.
struct Extent {
    std::uint64_t words = 0;
    int tail_bytes = 0;
};
Extent extent_of(const Packing& packing, std::uint64_t n) {
    if (!packing.has_tail())
        return {n / packing.per_word + (n % packing.per_word != 0 ? 1 : 0), 0};
    return {n / packing.per_word, static_cast<int>(n % packing.per_word * packing.bits / 8)};
}

}  // namespace

std::size_t component_count(ParamType type) {
    switch (type) {
        case ParamType::Rgb:
        case ParamType::Vector: return 3;
        case ParamType::Rgba: return 4;
        case ParamType::Vector2: return 2;
        case ParamType::Matrix: return 16;
        default: return 1;
    }
}

bool is_float_type(ParamType type) {
    switch (type) {
        case ParamType::Float:
        case ParamType::Rgb:
        case ParamType::Rgba:
        case ParamType::Vector:
        case ParamType::Vector2:
        case ParamType::Matrix: return true;
        default: return false;
    }
}

PackedScan scan_b85(std::string_view text, std::size_t begin, ParamType type,
                    std::uint64_t n_numbers) {
    B85Reader reader(text.substr(begin));
    PackedScan scan;
    scan.end = begin;
    if (n_numbers == 0) {
        // An empty array may still have its packing letter.
        Packing unused;
        if (has_letter(type) && find_packing(type, reader.peek(), unused))
            scan.end = begin + reader.position() + 1;
        return scan;
    }
    Packing packing;
    const char letter = has_letter(type) ? reader.peek() : '\0';
    if (!find_packing(type, letter, packing)) {
        scan.error = letter == '\0' || b85_digit(letter) == kNoDigit ? PackedError::TooShort
                                                                     : PackedError::BadLetter;
        scan.end = begin + reader.position();
        return scan;
    }
    if (packing.letter) reader.skip();
    const Extent extent = extent_of(packing, n_numbers);
    std::uint64_t n_words = 0;
    while (n_words < extent.words && scan.error == PackedError::None) {
        std::uint32_t word = 0;
        std::uint64_t count = 0;
        scan.error = reader.words(word, count);
        if (scan.error != PackedError::None) break;
        if (count > extent.words - n_words) {
            scan.error = PackedError::RunTooLong;
            break;
        }
        n_words += count;
    }
    if (scan.error == PackedError::None && extent.tail_bytes > 0) {
        std::uint64_t value = 0;
        std::uint32_t word = 0;
        if (!reader.digits(extent.tail_bytes + 1, value))
            scan.error = PackedError::TooShort;
        else
            scan.error = B85Reader::narrow(value, word);
    }
    scan.n_found = scan.error == PackedError::None
                       ? n_numbers
                       : std::min(n_numbers, n_words * packing.per_word);
    scan.end = begin + reader.position();
    return scan;
}

void decode_b85(std::string_view data, ParamType type, std::span<std::uint32_t> out) {
    if (out.empty()) return;
    B85Reader reader(data);
    Packing packing;
    if (!find_packing(type, reader.peek(), packing)) return;
    if (packing.letter) reader.skip();
    const std::uint32_t mask = packing.bits == 32 ? 0xffffffffU : (1U << packing.bits) - 1;
    const Extent extent = extent_of(packing, out.size());
    std::size_t at = 0;
    for (std::uint64_t i = 0; i < extent.words;) {
        std::uint32_t word = 0;
        std::uint64_t count = 0;
        if (reader.words(word, count) != PackedError::None) return;
        i += count;
        if (packing.per_word == 1) {
            std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(at), count, word);
            at += count;
            continue;
        }
        for (; count > 0; --count)
            for (std::uint32_t k = 0; k < packing.per_word && at < out.size(); ++k)
                out[at++] = word >> (k * packing.bits) & mask;
    }
    if (extent.tail_bytes == 0) return;
    std::uint64_t tail = 0;
    if (!reader.digits(extent.tail_bytes + 1, tail)) return;
    const auto byte = [&](int i) {
        return static_cast<std::uint32_t>(tail >> (24 - 8 * i)) & 0xffU;
    };
    if (packing.bits == 16)
        out[at] = byte(0) | byte(1) << 8U;
    else
        for (int i = 0; i < extent.tail_bytes; ++i)
            out[at++] = byte(i);
}

namespace {

std::size_t b64_size(ParamType type) {
    return type == ParamType::Byte || type == ParamType::Bool ? 1 : 4;
}

}  // namespace

PackedScan scan_b64(std::string_view text, std::size_t begin, ParamType type,
                    std::uint64_t n_numbers) {
    PackedScan scan;
    const std::uint64_t n_bytes = n_numbers * b64_size(type);
    const std::uint64_t n_chars = n_bytes / 3 * 4 + (n_bytes % 3 == 0 ? 0 : n_bytes % 3 + 1);
    std::uint64_t found = 0;
    std::size_t at = begin;
    scan.end = begin;
    for (; found < n_chars && at < text.size(); ++at) {
        if (is_blank(text[at])) continue;
        if (kB64[static_cast<unsigned char>(text[at])] == kNoDigit) break;
        ++found;
    }
    // Padding is not written by Arnold, but harmless.
    while (found == n_chars && n_chars % 4 != 0 && at < text.size() && text[at] == '=')
        ++at;
    if (n_chars > 0) scan.end = at;
    scan.n_found = found == n_chars ? n_numbers : found * 3 / 4 / b64_size(type);
    if (found < n_chars) scan.error = PackedError::TooShort;
    return scan;
}

void decode_b64(std::string_view data, ParamType type, std::span<std::uint32_t> out) {
    const std::size_t size = b64_size(type);
    std::uint32_t bits = 0;
    int n_bits = 0;
    std::uint32_t value = 0;
    std::size_t n_bytes = 0;
    std::size_t at = 0;
    for (const char c : data) {
        const std::uint8_t digit = kB64[static_cast<unsigned char>(c)];
        if (digit == kNoDigit) continue;
        bits = bits << 6U | digit;
        n_bits += 6;
        if (n_bits < 8) continue;
        n_bits -= 8;
        value |= (bits >> static_cast<unsigned>(n_bits) & 0xffU) << (8 * n_bytes);
        if (++n_bytes < size) continue;
        if (at == out.size()) return;
        out[at++] = value;
        value = 0;
        n_bytes = 0;
    }
}

}  // namespace lightsieve
