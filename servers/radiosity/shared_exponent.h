#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace cl::radiosity {

/// RGB as the texture format RGB9_E5 has it: bits 0 to 8, 9 to 17, 18 to 26, exponent in 27 to 31. Rounds to
/// nearest. @param color  finite; below 0 counts as 0, above 65408 as that
/// Source: OpenGL ES 3.0.6, section 3.8.3.2. By whole numbers alone: with the logarithms and powers written
/// there (as glm::packF3x9_E1x5 has them) packing was a tenth of a relight.
[[nodiscard]] inline uint32_t pack_shared_exponent(const glm::vec3& color) noexcept {
    constexpr int kBias = 15, kMantissa = 9;
    const auto in_range = [](float v) { return v > 0.0f ? std::min(v, 65408.0f) : 0.0f; };
    const float r = in_range(color.x), g = in_range(color.y), b = in_range(color.z);
    const float largest = std::max(r, std::max(g, b));
    uint32_t bits = 0;
    std::memcpy(&bits, &largest, sizeof bits);
    int exponent = std::max(int(bits >> 23) - 127, -kBias - 1) + 1 + kBias;
    // 2^(bias + mantissa - exponent), in the exponent's place of a float.
    const auto scale_of = [](int e) {
        const uint32_t word = uint32_t(127 + kBias + kMantissa - e) << 23;
        float scale = 0.0f;
        std::memcpy(&scale, &word, sizeof scale);
        return scale;
    };
    // Small and not negative: exact, and without the call that lround is.
    const auto rounded = [](float v) { return uint32_t(v + 0.5f); }; // NOLINT(bugprone-incorrect-roundings)
    exponent += rounded(largest * scale_of(exponent)) >> kMantissa;  // 511.5 and more need one bit less
    const float scale = scale_of(exponent);
    return rounded(r * scale) | rounded(g * scale) << kMantissa | rounded(b * scale) << (2 * kMantissa) |
           uint32_t(exponent) << (3 * kMantissa);
}

} // namespace cl::radiosity
