#pragma once

#include "servers/gi/probe_data.h"
#include "servers/gi/relight.h"

#include <glm/mat3x3.hpp>

#include <vector>

namespace cl::tests {

/// Columns x, y, z with z opposite to the direction of travel.
glm::mat3 facing(const glm::vec3& travel);

// Lights in cells: their transforms have no scale.
gi::CachedLight omni(const glm::vec3& position, float range);
gi::CachedLight sun(const glm::vec3& travel);
gi::CachedLight spot(const glm::vec3& position, const glm::vec3& travel, float angle_deg, float range);

/// A floor, a wall and a sphere's shell of leaves in 64^3 cells, with all kinds of normals and some emission.
gi::Octree busy_octree();
/// Lights of every kind, inside of the grid and outside, that light parts of it.
std::vector<gi::CachedLight> busy_lights();

} // namespace cl::tests
