#pragma once

#include "servers/radiosity/color_map.h"

#include "core/math/aabb.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace cl::radiosity {

/// How a surface sends light on. Colours are linear.
struct Surface {
    glm::vec3 albedo{1.0f};   ///< of all reflection: what a metal reflects bounces too, as if diffuse
    glm::vec3 emission{0.0f}; ///< radiance
    std::shared_ptr<const ColorMap> albedo_map, emission_map; ///< null: none
    bool emission_multiplies = false;                         ///< else the map is added to the colour
    float emission_energy = 1.0f;                             ///< applied to the map
    glm::vec2 uv_scale{1.0f}, uv_offset{0.0f};
    bool two_sided = false;
    float alpha_cutoff = 0.0f; ///< > 0: rays pass where alpha is below
};

/// The triangles that do not move, in world space [m].
struct StillScene {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;        ///< one a position
    std::vector<glm::uvec3> triangles; ///< into positions; counter-clockwise seen from the front
    std::vector<uint32_t> surface_of;  ///< one a triangle
    std::vector<Surface> surfaces;

    /// Of all positions.
    [[nodiscard]] AABB bounds() const noexcept;
    /// Unit length, out of the front; 0 for a degenerate triangle.
    [[nodiscard]] glm::vec3 normal(uint32_t triangle) const noexcept;
    /// UVs at barycentric weights of vertices 1 and 2, scaled and offset as the surface says.
    [[nodiscard]] glm::vec2 uv(uint32_t triangle, glm::vec2 barycentric) const noexcept;
    /// @param footprint_uv  edge of the area to average over, in UVs
    [[nodiscard]] glm::vec3 albedo(uint32_t triangle, glm::vec2 barycentric,
                                   float footprint_uv) const noexcept;
    [[nodiscard]] glm::vec3 emission(uint32_t triangle, glm::vec2 barycentric,
                                     float footprint_uv) const noexcept;
    /// True where rays pass through a cut-out surface.
    [[nodiscard]] bool is_hole(uint32_t triangle, glm::vec2 barycentric) const noexcept;
    /// How many UVs a metre of the triangle covers, about.
    [[nodiscard]] float uv_per_m(uint32_t triangle) const noexcept;
};

} // namespace cl::radiosity
