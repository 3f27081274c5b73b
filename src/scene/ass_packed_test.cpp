// b85 and b64 against encoders written here from the description alone.
#include "scene/ass_packed.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <string>
#include <vector>

namespace lightsieve {
namespace {

std::string digits(std::uint64_t value, std::size_t n) {
    std::string out(5, ' ');
    for (std::size_t i = 5; i-- > 0; value /= 85)
        out[i] = static_cast<char>(36 + value % 85);
    return out.substr(0, n);
}

std::string word(std::uint32_t value) {
    return value == 0 ? "z" : value == 0x3f800000 ? "y" : digits(value, 5);
}

/// Words with runs of three and more written as runs.
std::string words(const std::vector<std::uint32_t>& values) {
    std::string out;
    for (std::size_t i = 0; i < values.size();) {
        std::size_t n = 1;
        while (i + n < values.size() && values[i + n] == values[i])
            ++n;
        if (n >= 3)
            out += "!" + word(values[i]) + word(static_cast<std::uint32_t>(n));
        else
            for (std::size_t k = 0; k < n; ++k)
                out += word(values[i]);
        i += n;
    }
    return out;
}

/// Little-endian words, then the rest from the top of a word down.
std::string bytes(const std::vector<std::uint8_t>& values) {
    std::vector<std::uint32_t> full;
    std::size_t i = 0;
    for (; i + 4 <= values.size(); i += 4)
        full.push_back(values[i] | std::uint32_t{values[i + 1]} << 8U |
                       std::uint32_t{values[i + 2]} << 16U | std::uint32_t{values[i + 3]} << 24U);
    std::string out = words(full);
    const std::size_t rest = values.size() - i;
    std::uint32_t top = 0;
    for (std::size_t k = 0; k < rest; ++k)
        top |= std::uint32_t{values[i + k]} << (24 - 8 * k);
    return rest == 0 ? out : out + digits(top, rest + 1);
}

std::string packed(char letter, const std::vector<std::uint32_t>& values) {
    std::vector<std::uint8_t> raw;
    switch (letter) {
        case 'B':
            for (const std::uint32_t v : values)
                raw.push_back(static_cast<std::uint8_t>(v));
            return letter + bytes(raw);
        case 'C':
            for (const std::uint32_t v : values) {
                raw.push_back(static_cast<std::uint8_t>(v));
                raw.push_back(static_cast<std::uint8_t>(v >> 8U));
            }
            return letter + bytes(raw);
        case 'F': {
            std::vector<std::uint32_t> full((values.size() + 2) / 3);
            for (std::size_t i = 0; i < values.size(); ++i)
                full[i / 3] |= values[i] << (i % 3 * 10);
            return letter + words(full);
        }
        default: return letter + words(values);
    }
}

std::vector<std::uint32_t> decoded(const std::string& text, ParamType type, std::size_t n) {
    const PackedScan scan = scan_b85(text, 0, type, n);
    EXPECT_EQ(scan.error, PackedError::None) << text;
    EXPECT_EQ(scan.end, text.size()) << text;
    std::vector<std::uint32_t> out(n, 12345);
    decode_b85(text, type, out);
    return out;
}

TEST(B85, EveryLetterAndTail) {
    std::mt19937 random(7);
    for (const char letter : {'B', 'C', 'E', 'F'}) {
        const std::uint32_t mask = letter == 'B'   ? 0xff
                                   : letter == 'C' ? 0xffff
                                   : letter == 'F' ? 0x3ff
                                                   : 0xffffffff;
        for (std::size_t n = 1; n <= 40; ++n) {
            std::vector<std::uint32_t> values(n);
            // Repeated values in places, so that runs occur.
            for (std::uint32_t& v : values)
                v = (random() & 3U) == 0 ? static_cast<std::uint32_t>(random()) & mask : 0x2a;
            EXPECT_EQ(decoded(packed(letter, values), ParamType::UInt, n), values) << letter << n;
        }
    }
}

TEST(B85, BytesAndFloats) {
    std::vector<std::uint8_t> raw;
    for (int i = 0; i < 11; ++i)
        raw.push_back(static_cast<std::uint8_t>(i * 25));
    EXPECT_EQ(decoded(bytes(raw), ParamType::Byte, 11),
              std::vector<std::uint32_t>(raw.begin(), raw.end()));
    std::vector<std::uint32_t> floats;
    for (const float f : {0.0F, 1.0F, -0.0F, 1e-40F, 3e38F, 0.1F})
        floats.push_back(std::bit_cast<std::uint32_t>(f));
    EXPECT_EQ(decoded(words(floats), ParamType::Vector, 6), floats);
}

TEST(B85, BlanksMayStandAnywhere) {
    const std::vector<std::uint32_t> values{70000, 0, 0, 0, 0, 5, 6, 7};
    const std::string text = packed('E', values);
    std::string spaced;
    for (const char c : text)
        spaced += std::string(1, c) + " \r\n\t";
    const PackedScan scan = scan_b85(spaced, 0, ParamType::UInt, values.size());
    EXPECT_EQ(scan.error, PackedError::None);
    EXPECT_EQ(scan.end, spaced.size() - 4);
    std::vector<std::uint32_t> out(values.size());
    decode_b85(spaced, ParamType::UInt, out);
    EXPECT_EQ(out, values);
}

TEST(B85, StopsAfterTheLastValue) {
    const std::string text = packed('B', {1, 2, 3, 4, 5});
    EXPECT_EQ(scan_b85(text + "\n name x", 0, ParamType::UInt, 5).end, text.size());
}

TEST(B85, Damage) {
    EXPECT_EQ(scan_b85("E$$", 0, ParamType::UInt, 1).error, PackedError::TooShort);
    EXPECT_EQ(scan_b85("zz}", 0, ParamType::Float, 3).error, PackedError::TooShort);
    EXPECT_EQ(scan_b85("zz}", 0, ParamType::Float, 3).n_found, 2U);
    EXPECT_EQ(scan_b85("", 0, ParamType::UInt, 3).error, PackedError::TooShort);
    EXPECT_EQ(scan_b85("Q$$$$$", 0, ParamType::UInt, 1).error, PackedError::BadLetter);
    // 85^5 - 1 is more than 32 bits.
    EXPECT_EQ(scan_b85("xxxxx", 0, ParamType::Float, 1).error, PackedError::BadCharacter);
    EXPECT_EQ(scan_b85("!z" + digits(5, 5), 0, ParamType::Float, 4).error,
              PackedError::RunTooLong);
    EXPECT_EQ(scan_b85("!z" + digits(4, 5), 0, ParamType::Float, 4).error, PackedError::None);
    EXPECT_EQ(scan_b85("!z", 0, ParamType::Float, 4).error, PackedError::TooShort);
    // A run of nothing makes no progress but ends with the text.
    EXPECT_EQ(scan_b85("!zz!zz", 0, ParamType::Float, 1).error, PackedError::TooShort);
}

TEST(B85, HugeCountsCostNothing) {
    EXPECT_EQ(scan_b85("yyy", 0, ParamType::Vector, std::uint64_t{1} << 60U).error,
              PackedError::TooShort);
    EXPECT_EQ(scan_b64("AAAA", 0, ParamType::Float, std::uint64_t{1} << 60U).error,
              PackedError::TooShort);
}

TEST(B64, ValuesAndEnd) {
    // 1.0f, 2.0f little-endian: 00 00 80 3f 00 00 00 40.
    const std::string text = "AACAPw\nAAAEA rest";
    const PackedScan scan = scan_b64(text, 0, ParamType::Float, 2);
    EXPECT_EQ(scan.error, PackedError::None);
    EXPECT_EQ(text.substr(scan.end), " rest");
    std::vector<std::uint32_t> out(2);
    decode_b64(text.substr(0, scan.end), ParamType::Float, out);
    EXPECT_EQ(out, (std::vector<std::uint32_t>{0x3f800000, 0x40000000}));
    std::vector<std::uint32_t> small(3);
    decode_b64("AQID", ParamType::Byte, small);
    EXPECT_EQ(small, (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(scan_b64("AACAPw\n}", 0, ParamType::Float, 2).n_found, 1U);
}

}  // namespace
}  // namespace lightsieve
