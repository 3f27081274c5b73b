// Packed array data of .ass files: Arnold's base 85 ("b85") and base 64 ("b64").
//
// b85 packs 32-bit words as 5 characters of '$'..'x' (codes 36..120), most significant digit first; `z` is the word 0,
// `y` the word 0x3f800000 (1.0f), `!` W N the word W repeated N times. Floats are their bit patterns. BYTE and BOOL put
// four values in a word, low byte first. INT and UINT begin with a letter that says how wide their values are:
// B 8 bits, F 10 bits (three a word), C 16 bits, E 32 bits. What remains when the bytes do not fill a
// word (1 to 3 of them) is written as one character more, bytes from the top of the word down. b64 is ordinary base 64
// of the little-endian values. Blanks and newlines mean nothing in either, so only the number of values tells where
// the data ends: `scan_packed` finds that place, `decode_packed` reads the values.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "scene/value.h"

namespace lightsieve {

/// Numbers in one element of a type: VECTOR 3, MATRIX 16, FLOAT 1.
[[nodiscard]] std::size_t component_count(ParamType type);
/// Whether values of a type are stored as floats.
[[nodiscard]] bool is_float_type(ParamType type);

/// Why packed data cannot be read.
enum class PackedError : std::uint8_t {
    None,
    TooShort,      ///< the data ends before all values are there
    BadLetter,     ///< INT or UINT data begins with another letter than B, C, E, F
    BadCharacter,  ///< base 64 or 85 characters that stand for no word
    RunTooLong,    ///< a run repeats past the last value
};

struct PackedScan {
    PackedError error = PackedError::None;
    std::size_t end =
        0;  ///< offset after the last character of the data, or of the place of the error
    std::uint64_t n_found = 0;  ///< numbers (not elements) that are there; exact for TooShort
};

/// Finds the end of packed data.
///
/// begin      offset of the first character after the array's head
/// n_numbers  elements * keys * component_count(type)
[[nodiscard]] PackedScan scan_b85(std::string_view text, std::size_t begin, ParamType type,
                                  std::uint64_t n_numbers);
[[nodiscard]] PackedScan scan_b64(std::string_view text, std::size_t begin, ParamType type,
                                  std::uint64_t n_numbers);

/// Reads data that `scan_b85` or `scan_b64` accepted for out.size() numbers. Each number takes one word: the bits of a float,
/// or an integer.
void decode_b85(std::string_view data, ParamType type, std::span<std::uint32_t> out);
void decode_b64(std::string_view data, ParamType type, std::span<std::uint32_t> out);

}  // namespace lightsieve
