// Four floats that one instruction takes at once (a vector extension that GCC and Clang share).
//
// Arithmetic and comparisons are the language's own, lane by lane, in the order that they are written in: a lane has the bits
// that a float would have.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace lightsieve {

using Float4 = float __attribute__((vector_size(16)));
/// What comparisons of Float4 give: -1 where they hold, else 0.
using Int4 = std::int32_t __attribute__((vector_size(16)));
/// Four words of bits.
using Word4 = std::uint32_t __attribute__((vector_size(16)));

constexpr Float4 all(float v) { return Float4{v, v, v, v}; }
inline Float4 load(const std::array<float, 4>& lanes) {
    Float4 out;
    std::memcpy(&out, lanes.data(), sizeof(out));
    return out;
}
inline void store(Float4 v, float* to) { std::memcpy(to, &v, sizeof(v)); }

/// a > b ? a : b, so b where either is nan. By name where there is an instruction: g++ does not find it beside constants.
inline Float4 larger(Float4 a, Float4 b) {
#if defined(__SSE__)
    return _mm_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}
/// a < b ? a : b, so b where either is nan.
inline Float4 smaller(Float4 a, Float4 b) {
#if defined(__SSE__)
    return _mm_min_ps(a, b);
#else
    return a < b ? a : b;
#endif
}
/// Absolute values.
inline Float4 magnitude(Float4 v) {
    return __builtin_bit_cast(Float4, __builtin_bit_cast(Int4, v) & 0x7fff'ffff);
}
inline Float4 root(Float4 v) {
#if defined(__SSE__)
    return _mm_sqrt_ps(v);
#else
    return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}
constexpr float sum_of(Float4 v) { return (v[0] + v[1]) + (v[2] + v[3]); }
/// Whether a comparison holds anywhere.
inline bool any(Int4 holds) {
    using Long2 = std::int64_t __attribute__((vector_size(16)));
    const auto halves = __builtin_bit_cast(Long2, holds);
    return (halves[0] | halves[1]) != 0;
}

}  // namespace lightsieve
