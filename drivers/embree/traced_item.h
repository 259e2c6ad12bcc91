#pragma once

#include "drivers/embree/material.h"
#include "drivers/embree/mesh.h"

#include "servers/rasterizer.h"

#include "core/math/transform.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace cl::embree {

/// A surface placed in the world.
struct TracedItem {
    TracedItem(const WorldItem& item, std::shared_ptr<const TriangleSurface> triangles,
               const Material::FindTexture& find);

    std::shared_ptr<const TriangleSurface> surface;
    Material material;
    std::vector<glm::vec3> positions; ///< of the vertices, world space [m]
    glm::mat3 normals_from_local;     ///< as the scene pass turns normals: not of unit length
    bool mirrored;
    uint32_t layers;
    ShadowCasting casting;

    /// Corner positions of a triangle.
    struct Corners {
        glm::vec3 a, b, c;
    };
    [[nodiscard]] Corners corners(uint32_t triangle) const noexcept;
    /// Normal of a triangle on its front side, its length twice the area [m^2]. Front faces are clockwise.
    [[nodiscard]] glm::vec3 front_normal(uint32_t triangle) const noexcept;
    /// @param barycentric  weights of the second and third corner
    [[nodiscard]] SurfaceCoordinates coordinates(uint32_t triangle,
                                                 const glm::vec2& barycentric) const noexcept;
    /// True if a ray can meet the side at all: a culled side is not there, for light as for the eye.
    [[nodiscard]] bool shows(bool front_side) const noexcept;
};

/// Mixes the values of a triangle's corners. @param b  weights of the second and third
template <typename T>
[[nodiscard]] T interpolate(const T& first, const T& second, const T& third, const glm::vec2& b) noexcept {
    return first * (1.0f - b.x - b.y) + second * b.x + third * b.y;
}

} // namespace cl::embree
