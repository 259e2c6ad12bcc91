#pragma once

#include "servers/radiosity/air_points.h"
#include "servers/radiosity/field_map.h"
#include "servers/radiosity/solver.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

/// Radiance at a point in the air in two bands of spherical harmonics: mean, and mean times direction.
struct AirLight {
    glm::vec3 mean;
    std::array<glm::vec3, 3> slope; ///< along x, y, z of the world
};

/// Light of each probe's points: what leaves the patches that they see, and the sky.
[[nodiscard]] std::vector<std::vector<AirLight>>
light_air(std::span<const AirPoints> air, const Lighting& lighting, const Solution& solution);

/// The same as RGBA half floats for the texels of FieldMap::air: for each probe four slabs (mean, slopes
/// along x, y, z of the world). a of the last three: how far the point reaches along x, y, z of the grid, 32
/// * quarters of a cell below + quarters above.
[[nodiscard]] std::vector<uint16_t> encode_air(std::span<const AirPoints> air, const FieldMap& map,
                                               std::span<const std::vector<AirLight>> light);

} // namespace cl::radiosity
