#pragma once

#include "servers/rasterizer.h"

#include <glm/vec3.hpp>

namespace cl::shading {

/// The colour that is seen where nothing is drawn, linear, before background_energy: clear colour or
/// background colour (spec scene-classes section 14.2); black where a sky is drawn.
[[nodiscard]] glm::vec3 background_color(const Frame& frame) noexcept;

} // namespace cl::shading
