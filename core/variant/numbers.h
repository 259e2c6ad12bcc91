#pragma once

#include <cstdint>

namespace cl {

/// Drops the fraction; saturates beyond 64 bits, NaN gives 0 (a plain cast would be undefined).
[[nodiscard]] inline int64_t truncated_to_int(double value) noexcept {
    constexpr double kTwoPow63 = 9223372036854775808.0;
    if (value >= kTwoPow63) {
        return INT64_MAX;
    }
    if (value < -kTwoPow63) {
        return INT64_MIN;
    }
    return value == value ? static_cast<int64_t>(value) : 0;
}

/// What a real becomes as an element of a PoolIntArray: truncated toward 0; what does not fit 32 bits (NaN
/// too) gives the least int, as Godot 3.2.3 does on x86-64.
[[nodiscard]] inline int32_t truncated_to_int32(double value) noexcept {
    return value > -2147483649.0 && value < 2147483648.0 ? static_cast<int32_t>(value) : INT32_MIN;
}

} // namespace cl
