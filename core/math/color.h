#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace cl {

/// A colour as scene files store it: sRGB-encoded unless the name says otherwise, not clamped, alpha
/// straight.
struct Color {
    float r = 0.0f;
    float g = 0.0f;
    float b = 0.0f;
    float a = 1.0f;
    [[nodiscard]] glm::vec3 rgb() const noexcept { return {r, g, b}; }
    friend bool operator==(const Color&, const Color&) = default;
};

/// sRGB-encoded value to linear (IEC 61966-2-1, the spec's threshold 0.04045).
[[nodiscard]] float linear_from_srgb(float c) noexcept;
[[nodiscard]] glm::vec3 linear_from_srgb(const glm::vec3& c) noexcept;
/// Linear value to sRGB-encoded (threshold 0.0031308). Not clamped.
[[nodiscard]] float srgb_from_linear(float c) noexcept;
[[nodiscard]] glm::vec3 srgb_from_linear(const glm::vec3& c) noexcept;

} // namespace cl
