#include "core/sobol.h"

namespace lightsieve {
namespace {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fU) << 4U) | ((x >> 4U) & 0x0f0f0f0fU);
    x = ((x & 0x33333333U) << 2U) | ((x >> 2U) & 0x33333333U);
    return ((x & 0x55555555U) << 1U) | ((x >> 1U) & 0x55555555U);
}

/// Owen scrambling of a bit-reversed number: each bit is flipped by a hash of the bits below it.
/// Source: Vegdahl 2021, "Building a Better LK Hash", an improvement of Burley 2020, listing 2.
constexpr std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return x;
}

/// Second Sobol dimension of index i, as 32 bits with the first digit at the top. The first is the bit reversal.
/// Direction numbers of primitive polynomial x + 1: v[j] = v[j-1] ^ (v[j-1] >> 1), built by carry-less products.
constexpr std::uint32_t sobol_second(std::uint32_t i) {
    // Pascal's triangle modulo 2 in five steps (i.e. multiplication by the upper triangular matrix of ones).
    std::uint32_t x = i;
    x ^= (x >> 16U) & 0x0000ffffU;
    x ^= (x >> 8U) & 0x00ff00ffU;
    x ^= (x >> 4U) & 0x0f0f0f0fU;
    x ^= (x >> 2U) & 0x33333333U;
    x ^= (x >> 1U) & 0x55555555U;
    return reverse_bits(x);
}

}  // namespace

Vec2f Sampler::at2(std::uint32_t pair) const {
    const std::uint32_t seed = hash_combine(pixel_, pair);
    // Shuffle the order of samples within nested powers of two, then scramble each dimension.
    const std::uint32_t index = reverse_bits(laine_karras(reverse_bits(index_), seed));
    // The first dimension is the reversed index and scrambling wants reversed digits: the reversals cancel.
    const std::uint32_t x = reverse_bits(laine_karras(index, hash_combine(seed, 1)));
    const std::uint32_t y = reverse_bits(laine_karras(reverse_bits(sobol_second(index)), hash_combine(seed, 2)));
    return {unit_float(x), unit_float(y)};
}

}  // namespace lightsieve
