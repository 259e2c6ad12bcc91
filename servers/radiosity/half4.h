#pragma once

#include "servers/gi/float4.h"

#include <bit>
#include <cstdint>

namespace cl::radiosity {

/// Four half floats, the first in the lowest bits; rounds to nearest, what is halfway away from 0. A fifth of
/// the time that glm::packHalf1x16 takes for each.
/// @param v  finite, magnitudes of at most 65504
inline uint64_t pack_halves(gi::float4 v) noexcept {
    constexpr int32_t kRebias = (127 - 15) << 23, kHalfway = 1 << 12, kLeastNormal = (127 - 14) << 23;
    const gi::int4 bits = std::bit_cast<gi::int4>(v);
    const gi::int4 magnitude = bits & 0x7FFFFFFF;
    const gi::int4 normal = (magnitude - kRebias + kHalfway) >> 13;
    const gi::int4 small =
        gi::to_int(std::bit_cast<gi::float4>(magnitude) * gi::splat(0x1p24f) + gi::splat(0.5f));
    const gi::int4 halves = gi::select(magnitude >= kLeastNormal, normal, small) | ((bits >> 16) & 0x8000);
    using Short4 = uint16_t __attribute__((vector_size(8)));
    return std::bit_cast<uint64_t>(__builtin_convertvector(halves, Short4));
}

} // namespace cl::radiosity
