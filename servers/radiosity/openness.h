#pragma once

#include "servers/radiosity/ray_scene.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace cl::radiosity {

/// A point of a surface, lifted off it so that rays do not meet the surface itself.
[[nodiscard]] glm::vec3 lifted(const glm::vec3& point, const glm::vec3& normal, float cell_m) noexcept;

/// What openness() is of a point inside a solid: most rays meet the backs of surfaces, or all do.
inline constexpr float kInside = -1.0f, kBuried = -2.0f;

/// How open the space before a point is: median of the distances to what is there [m]. Less than 0 if it lies
/// inside a solid.
[[nodiscard]] float openness(const RayScene& rays, const glm::vec3& point, const glm::vec3& normal,
                             float cell_m) noexcept;

/// openness() of several points of one plane. What a buried point sees is buried, too: one ray tells so, and
/// most points that are asked about are.
/// @param buried  one of the plane's, if one is known
[[nodiscard]] std::vector<float> openness_of_all(const RayScene& rays, std::span<const glm::vec3> points,
                                                 const glm::vec3& normal, float cell_m,
                                                 std::optional<glm::vec3> buried);

/// The space that each of some points of one plane borders on: the number of the first point that it can be
/// reached from, by steps from one to another in sight of it.
[[nodiscard]] std::vector<size_t> spaces(const RayScene& rays, std::span<const glm::vec3> points,
                                         const glm::vec3& normal, float cell_m);

} // namespace cl::radiosity
