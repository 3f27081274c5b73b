#include "scene/cryptomatte.h"

#include <bit>
#include <cstddef>

namespace lightsieve {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";

std::string hex(std::uint32_t value) {
    std::string out(8, '0');
    for (std::size_t i = 8; i-- > 0; value >>= 4U)
        out[i] = kHexDigits[value & 15U];
    return out;
}

/// Mixes one word of the text.
std::uint32_t scrambled(std::uint32_t word) {
    return std::rotl(word * 0xcc9e2d51U, 15) * 0x1b873593U;
}

void append_json(std::string_view text, std::string& out) {
    out += '"';
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (byte < 0x20) {
            out += "\\u00";
            out += kHexDigits[byte >> 4U];
            out += kHexDigits[byte & 15U];
        } else {
            out += c;
        }
    }
    out += '"';
}

}  // namespace

std::uint32_t murmur_hash(std::string_view text) {
    std::uint32_t hash = 0;
    // Whole words, least byte first, then what is left.
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        word |= std::uint32_t{static_cast<unsigned char>(text[i])} << (8 * (i % 4));
        if (i % 4 != 3) continue;
        hash = std::rotl(hash ^ scrambled(word), 13) * 5 + 0xe6546b64U;
        word = 0;
    }
    hash ^= scrambled(word);
    // The end: every bit of the text acts on every bit of the hash.
    hash ^= static_cast<std::uint32_t>(text.size());
    hash = (hash ^ (hash >> 16U)) * 0x85ebca6bU;
    hash = (hash ^ (hash >> 13U)) * 0xc2b2ae35U;
    return hash ^ (hash >> 16U);
}

std::uint32_t matte_id(std::string_view name) {
    const std::uint32_t hash = murmur_hash(name), exponent = (hash >> 23U) & 255U;
    return exponent == 0 || exponent == 255 ? hash ^ (1U << 23U) : hash;
}

std::string manifest_json(const MatteManifest& manifest) {
    std::string out = "{";
    for (const auto& [name, id] : manifest) {
        if (out.size() > 1) out += ',';
        append_json(name, out);
        out += ":\"" + hex(id) + '"';
    }
    return out + '}';
}

std::string matte_key(std::string_view name) { return hex(matte_id(name)).substr(0, 7); }

}  // namespace lightsieve
