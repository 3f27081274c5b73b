// A number of 64 bits by which data are told from other data: checksums, and "is this still the same scene?".
//
// Not for secrets: whoever wants to can make two texts of one fingerprint.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace lightsieve {

class Fingerprint {
  public:
    /// Adds bytes; how they are cut into calls counts, too.
    void add(std::span<const std::byte> bytes) {
        std::size_t i = 0;
        for (; i + 8 <= bytes.size(); i += 8)
            mix(word(bytes.subspan(i, 8)));
        mix(word(bytes.subspan(i)));
        mix(bytes.size());
    }
    void add(std::string_view text) { add(std::as_bytes(std::span(text.data(), text.size()))); }
    void add(std::uint64_t value) { mix(value); }

    [[nodiscard]] std::uint64_t value() const { return finished(state_); }
    /// 16 hexadecimal digits.
    [[nodiscard]] std::string text() const {
        constexpr std::string_view kDigits = "0123456789abcdef";
        std::string out(16, '0');
        std::uint64_t left = value();
        for (std::size_t i = 16; i-- > 0; left >>= 4U)
            out[i] = kDigits[left & 15U];
        return out;
    }

  private:
    [[nodiscard]] static std::uint64_t word(std::span<const std::byte> bytes) {
        std::uint64_t out = 0;
        if (!bytes.empty()) std::memcpy(&out, bytes.data(), bytes.size());
        return out;
    }
    /// Source: the 64-bit finaliser of Appleby's MurmurHash3.
    [[nodiscard]] static constexpr std::uint64_t finished(std::uint64_t x) {
        x ^= x >> 33U;
        x *= 0xff51afd7ed558ccdU;
        x ^= x >> 33U;
        x *= 0xc4ceb9fe1a85ec53U;
        return x ^ (x >> 33U);
    }
    void mix(std::uint64_t value) { state_ = finished(state_ ^ value) + 0x9e3779b97f4a7c15U; }

    std::uint64_t state_ = 0x243f6a8885a308d3U;
};

}  // namespace lightsieve
