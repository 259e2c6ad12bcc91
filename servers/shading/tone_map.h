#pragma once

#include "servers/render_types.h"

#include <glm/vec3.hpp>

#include <cstdint>

// From scene radiance to what a screen shows: the CPU twin of shaders/lib/tone_map.glsl and of the tone map
// pass.
namespace cl::shading {

/// Linear radiance after exposure to linear [0, 1] (spec scene-classes section 14.9).
/// @param white  the radiance that maps to 1; has no effect on ToneMapper::Linear
[[nodiscard]] glm::vec3 tone_map(const glm::vec3& radiance, ToneMapper mapper, float white) noexcept;

/// Brightness, contrast and saturation of an sRGB-encoded colour (section 14.10); all 1 changes nothing.
[[nodiscard]] glm::vec3 adjust(const glm::vec3& encoded,
                               const glm::vec3& brightness_contrast_saturation) noexcept;

/// The byte that Godot writes for an encoded value: rounded to half precision, then floor(v * 255)
/// (section 14.11: a viewport is read back as halves, and their conversion to 8 bit truncates).
[[nodiscard]] uint8_t byte_from_encoded(float encoded) noexcept;

} // namespace cl::shading
