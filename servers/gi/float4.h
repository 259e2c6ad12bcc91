#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace cl::gi {

/// Four float32 lanes by the compilers' vector extension (GCC, Clang, emscripten). Each lane rounds as a
/// float does, so that a template over float and float4 computes the same bits with either.
using float4 = float __attribute__((vector_size(16)));
/// What comparing float4 gives: -1 in true lanes, 0 in the others.
using int4 = int32_t __attribute__((vector_size(16)));

inline float4 splat(float v) noexcept {
    return float4{v, v, v, v};
}

/// Bit i is set where lane i is true.
inline uint32_t lane_bits(int4 mask) noexcept {
#if defined(__SSE2__)
    return uint32_t(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
    return uint32_t((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}

inline float4 square_root(float4 v) noexcept {
#if defined(__SSE2__)
    return float4(_mm_sqrt_ps(v));
#else
    return float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

/// Towards zero; lanes must fit.
inline int4 to_int(float4 v) noexcept {
    return __builtin_convertvector(v, int4);
}
inline float4 to_float(int4 v) noexcept {
    return __builtin_convertvector(v, float4);
}

// The few operations that float and float4 spell differently.

inline bool either(bool a, bool b) noexcept {
    return a || b;
}
inline int4 either(int4 a, int4 b) noexcept {
    return a | b;
}
inline bool both(bool a, bool b) noexcept {
    return a && b;
}
inline int4 both(int4 a, int4 b) noexcept {
    return a & b;
}
inline float select(bool mask, float a, float b) noexcept {
    return mask ? a : b;
}
inline int4 select(int4 mask, int4 a, int4 b) noexcept {
    return (mask & a) | (~mask & b);
}
inline float4 select(int4 mask, float4 a, float4 b) noexcept {
    return std::bit_cast<float4>(select(mask, std::bit_cast<int4>(a), std::bit_cast<int4>(b)));
}

/// a < b ? a : b, and so b where one is NaN.
inline float lesser(float a, float b) noexcept {
    return a < b ? a : b;
}
inline float4 lesser(float4 a, float4 b) noexcept {
#if defined(__SSE2__)
    return float4(_mm_min_ps(a, b));
#else
    return select(a < b, a, b);
#endif
}
/// a > b ? a : b, and so b where one is NaN.
inline float greater(float a, float b) noexcept {
    return a > b ? a : b;
}
inline float4 greater(float4 a, float4 b) noexcept {
#if defined(__SSE2__)
    return float4(_mm_max_ps(a, b));
#else
    return select(a > b, a, b);
#endif
}
inline float magnitude(float a) noexcept {
    return std::abs(a);
}
inline float4 magnitude(float4 a) noexcept {
    return std::bit_cast<float4>(std::bit_cast<int4>(a) & 0x7FFFFFFF);
}

} // namespace cl::gi
