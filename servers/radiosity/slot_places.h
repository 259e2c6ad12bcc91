#pragma once

#include "servers/radiosity/patches.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace cl::radiosity {

/// Steps an axis of a cell in which places are told to the shader.
inline constexpr int kPlaceSteps = 8;

/// Where two patches of one cell and facing are said to lie in it, 0..1: a pixel belongs to the nearer one.
/// Their own positions, unless a wall stands between them on one surface: then such that a point is nearer to
/// the patch on its side of the wall.
[[nodiscard]] std::array<glm::vec3, 2> slot_places(const RayScene& rays, const StillScene& scene,
                                                   const Patches& patches, uint32_t a, uint32_t b);

/// A patch's position in its cell, 0..1.
[[nodiscard]] glm::vec3 place_in_cell(const Patches& patches, uint32_t patch) noexcept;

} // namespace cl::radiosity
