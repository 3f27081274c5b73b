#include "core/sobol.h"

#include "core/float4.h"

namespace lightsieve {
namespace {

// Everything below is written once for a word and for four of them.
using Byte16 = std::uint8_t __attribute__((vector_size(16)));

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fU) << 4U) | ((x >> 4U) & 0x0f0f0f0fU);
    x = ((x & 0x33333333U) << 2U) | ((x >> 2U) & 0x33333333U);
    return ((x & 0x55555555U) << 1U) | ((x >> 1U) & 0x55555555U);
}
/// Bytes are shuffled into reversed order, then each half byte looks up its own reversal.
Word4 reverse_bits(Word4 x) {
    constexpr Byte16 kOrder{3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12};
    constexpr Byte16 kReversed{0x0, 0x8, 0x4, 0xc, 0x2, 0xa, 0x6, 0xe,
                               0x1, 0x9, 0x5, 0xd, 0x3, 0xb, 0x7, 0xf};
    const Byte16 bytes = __builtin_shuffle(__builtin_bit_cast(Byte16, x), kOrder);
    const Byte16 low = bytes & 0x0fU;
    const auto high =
        __builtin_bit_cast(Byte16, (__builtin_bit_cast(Word4, bytes) >> 4U) & 0x0f0f0f0fU);
    return __builtin_bit_cast(
        Word4, __builtin_shuffle(kReversed << 4U, low) | __builtin_shuffle(kReversed, high));
}

/// Owen scrambling of a bit-reversed number: each bit is flipped by a hash of the bits below it.
/// Source: Vegdahl 2021, "Building a Better LK Hash", an improvement of Burley 2020, listing 2.
template <class Word>
constexpr Word laine_karras(Word x, Word seed) {
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return x;
}

/// Second Sobol dimension of index i, bit-reversed (the first, bit-reversed, is the index itself).
/// Direction numbers of primitive polynomial x + 1: v[j] = v[j-1] ^ (v[j-1] >> 1), i.e. Pascal's triangle modulo 2, i.e.
/// multiplication by the upper triangular matrix of ones in five steps.
template <class Word>
constexpr Word reversed_sobol_second(Word i) {
    i ^= (i >> 16U) & 0x0000ffffU;
    i ^= (i >> 8U) & 0x00ff00ffU;
    i ^= (i >> 4U) & 0x0f0f0f0fU;
    i ^= (i >> 2U) & 0x33333333U;
    return i ^ ((i >> 1U) & 0x55555555U);
}

/// As core/sobol.h has it for one word: signed numbers are what instructions convert, and 24 bits fit.
Float4 unit_float(Word4 x) {
    return __builtin_convertvector(__builtin_bit_cast(Int4, x >> 8U), Float4) * 0x1p-24F;
}

/// One dimension each of x and y, as words.
template <class Word>
struct Point {
    Word x, y;
};

/// seed     of the pair
/// digits   the sample's index, bit-reversed
template <class Word>
constexpr Point<Word> scrambled(Word seed, Word digits) {
    // Shuffle the order of samples within nested powers of two, then scramble each dimension. The first dimension is the
    // reversed index and scrambling wants reversed digits: the reversals cancel.
    const Word index = reverse_bits(laine_karras(digits, seed));
    const Word one = Word{} + 1U;
    return {
        reverse_bits(laine_karras(index, hash_combine(seed, one))),
        reverse_bits(laine_karras(reversed_sobol_second(index), hash_combine(seed, one + 1U)))};
}

}  // namespace

Vec2f Sampler::at2(std::uint32_t pair) const {
    const Point<std::uint32_t> p = scrambled(hash_combine(pixel_, pair), reverse_bits(index_));
    return {lightsieve::unit_float(p.x), lightsieve::unit_float(p.y)};
}

std::array<Vec2f, 4> Sampler::at2x4(std::uint32_t pair) const {
    const Word4 zero{};
    const Word4 seed = hash_combine(zero + pixel_, Word4{pair, pair + 1, pair + 2, pair + 3});
    const Point<Word4> p = scrambled(seed, zero + reverse_bits(index_));
    const Float4 x = unit_float(p.x), y = unit_float(p.y);
    return {{{x[0], y[0]}, {x[1], y[1]}, {x[2], y[2]}, {x[3], y[3]}}};
}

}  // namespace lightsieve
