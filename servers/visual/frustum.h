#pragma once

#include "core/math/aabb.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>

namespace cl {

/// The six planes of what a camera sees. Plane (n, d) keeps points with dot(n, p) + d >= 0.
struct Frustum {
    std::array<glm::vec4, 6> planes;
};

/// Planes of the clip volume -w <= x, y, z <= w (Gribb and Hartmann 2001), not normalised.
[[nodiscard]] Frustum frustum_from_clip(const glm::mat4& clip_from_world) noexcept;

/// False only if the box lies wholly outside one plane: never wrong about a visible box, at times about one
/// that is outside near an edge of the frustum.
[[nodiscard]] bool may_see(const Frustum& frustum, const glm::vec3& least, const glm::vec3& most) noexcept;

} // namespace cl
