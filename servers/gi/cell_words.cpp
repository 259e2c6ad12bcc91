#include "servers/gi/cell_words.h"

#include <algorithm>
#include <cmath>

namespace cl::gi {

namespace {

/// Truncates to a byte; the comparison is written so that NaN gives 0.
template <typename Real>
uint32_t byte_of(Real v) {
    return v > Real(0) ? uint32_t(std::min(v, Real(255))) : 0u;
}

uint32_t packed(uint32_t a, uint32_t b, uint32_t c) {
    return (a << 16) | (b << 8) | c;
}

uint32_t channel(uint32_t word, int shift) {
    return (word >> shift) & 255u;
}

} // namespace

uint32_t encode_albedo(const glm::vec3& albedo) noexcept {
    return packed(byte_of(double(albedo.r) * 255.0), byte_of(double(albedo.g) * 255.0),
                  byte_of(double(albedo.b) * 255.0));
}

glm::u8vec3 albedo_bytes(uint32_t word) noexcept {
    return {uint8_t(channel(word, 16)), uint8_t(channel(word, 8)), uint8_t(channel(word, 0))};
}

uint32_t encode_emission(const glm::vec3& emission) noexcept {
    const float length =
        std::sqrt(emission.x * emission.x + emission.y * emission.y + emission.z * emission.z);
    if (!(length > 0.0f)) {
        return 0;
    }
    const uint32_t direction =
        packed(byte_of(emission.x / length * 255.0f), byte_of(emission.y / length * 255.0f),
               byte_of(emission.z / length * 255.0f));
    return (direction << 8) | byte_of(std::min(length / 8.0f, 1.0f) * 255.0f);
}

glm::vec3 decode_emission(uint32_t word) noexcept {
    const float length = float(channel(word, 0)) / 255.0f * 8.0f;
    return {float(channel(word, 24)) / 255.0f * length, float(channel(word, 16)) / 255.0f * length,
            float(channel(word, 8)) / 255.0f * length};
}

uint32_t encode_normal(const glm::vec3& normal) noexcept {
    const auto byte = [](float n) { return byte_of(double(n * 0.5f + 0.5f) * 255.0); };
    return packed(byte(normal.x), byte(normal.y), byte(normal.z));
}

glm::vec3 decode_normal(uint32_t word) noexcept {
    const auto component = [&](int shift) { return float(channel(word, shift) / 255.0 * 2.0 - 1.0); };
    return {component(16), component(8), component(0)};
}

uint32_t encode_level_alpha(int level, float alpha) noexcept {
    const double scaled = double(alpha) * 65535.0;
    const uint32_t bits = scaled > 0.0 ? uint32_t(std::min(scaled, 65535.0)) : 0u;
    return (uint32_t(level) << 16) | bits;
}

} // namespace cl::gi
