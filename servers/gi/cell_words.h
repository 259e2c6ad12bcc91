#pragma once

#include <glm/ext/vector_uint3_sized.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace cl::gi {

// The colour words of a cell (spec gi-probe-data section 5.2): what a bake writes and relighting reads.
// All encoders truncate and send NaN to 0.

/// 0x00RRGGBB. @param albedo  sRGB-encoded.
[[nodiscard]] uint32_t encode_albedo(const glm::vec3& albedo) noexcept;
[[nodiscard]] glm::u8vec3 albedo_bytes(uint32_t word) noexcept;

/// 0xRRGGBBLL: unit direction and length / 8, so that emission longer than 8 saturates.
[[nodiscard]] uint32_t encode_emission(const glm::vec3& emission) noexcept;
[[nodiscard]] glm::vec3 decode_emission(uint32_t word) noexcept;

/// 0x00XXYYZZ. A zero normal becomes 0x7F7F7F, which decodes to -0.0039 on each axis.
[[nodiscard]] uint32_t encode_normal(const glm::vec3& normal) noexcept;
/// byte / 255 * 2 - 1, not renormalised.
[[nodiscard]] glm::vec3 decode_normal(uint32_t word) noexcept;

/// Level in bits 31..16, opacity in 15..0.
[[nodiscard]] uint32_t encode_level_alpha(int level, float alpha) noexcept;

} // namespace cl::gi
