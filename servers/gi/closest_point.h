#pragma once

#include <glm/vec3.hpp>

namespace cl::gi {

/// The point of a triangle nearest to p. Where v[1] == v[2] it may be NaN, and its consumer takes vertex 0
/// then: cells at the pole of a sphere, whose last triangles are such, are Godot's only so. Source: Eberly,
/// "Distance Between Point and Triangle in 3D" (geometrictools.com), regions 0 to 6.
[[nodiscard]] glm::vec3 closest_point_of_triangle(const glm::vec3 (&v)[3], const glm::vec3& p) noexcept;

} // namespace cl::gi
