#pragma once

#include "servers/render_types.h"

#include "core/image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace cl::embree {

/// A picture: radiance, and how it is shown.
struct Target {
    glm::ivec2 size{0};
    std::vector<glm::vec3> radiance; ///< linear, row 0 at the top
    EnvironmentDesc tone;            ///< exposure, tone mapper and adjustments of the last frame
};

[[nodiscard]] Image radiance_image(const Target& target); ///< RGBF
/// RGBA8 as shown: exposure, tone mapper, sRGB, adjustments (shaders/tone_map.glsl).
[[nodiscard]] Image shown_image(const Target& target);

} // namespace cl::embree
