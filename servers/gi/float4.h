#pragma once

#include <array>
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

// The few operations that float and float4 spell differently.

inline bool either(bool a, bool b) noexcept {
    return a || b;
}
inline int4 either(int4 a, int4 b) noexcept {
    return a | b;
}
inline float select(bool mask, float a, float b) noexcept {
    return mask ? a : b;
}
inline float4 select(int4 mask, float4 a, float4 b) noexcept {
    return mask ? a : b;
}

template <typename F>
F lesser(F a, F b) noexcept {
    return select(a < b, a, b);
}
template <typename F>
F greater(F a, F b) noexcept {
    return select(a > b, a, b);
}
template <typename F>
F magnitude(F a) noexcept {
    return select(a < F{}, -a, a);
}

} // namespace cl::gi
