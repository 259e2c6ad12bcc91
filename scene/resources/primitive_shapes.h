#pragma once

#include "servers/mesh_surface.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// Shapes as pure functions of their parameters (spec scene-classes section 17): same positions, order and
// indices as Godot's, by the same float32 additions. Sizes in metres; triangles clockwise seen from outside.
namespace cl::scene {

struct CubeShape {
    glm::vec3 size{2.0f};
    int subdivide_width = 0, subdivide_height = 0, subdivide_depth = 0;
};
struct SphereShape {
    float radius = 1.0f, height = 2.0f;
    int radial_segments = 64, rings = 32;
    bool is_hemisphere = false;
};
struct PlaneShape {
    glm::vec2 size{2.0f};
    int subdivide_width = 0, subdivide_depth = 0;
};
struct QuadShape {
    glm::vec2 size{1.0f};
};
struct PrismShape {
    float left_to_right = 0.5f;
    glm::vec3 size{2.0f};
    int subdivide_width = 0, subdivide_height = 0, subdivide_depth = 0;
};
struct CylinderShape {
    float top_radius = 1.0f, bottom_radius = 1.0f, height = 2.0f;
    int radial_segments = 64, rings = 4;
};
struct CapsuleShape {
    float radius = 1.0f, mid_height = 1.0f;
    int radial_segments = 64, rings = 8;
};

/// Counts taken to the least that makes a shape (4 segments around, 1 ring of a sphere, ...), as Godot does.
[[nodiscard]] CubeShape sanitized(CubeShape shape) noexcept;
[[nodiscard]] SphereShape sanitized(SphereShape shape) noexcept;
[[nodiscard]] PlaneShape sanitized(PlaneShape shape) noexcept;
[[nodiscard]] QuadShape sanitized(QuadShape shape) noexcept;
[[nodiscard]] PrismShape sanitized(PrismShape shape) noexcept;
[[nodiscard]] CylinderShape sanitized(CylinderShape shape) noexcept;
[[nodiscard]] CapsuleShape sanitized(CapsuleShape shape) noexcept;

/// Vertices that make_shape() gives for a sanitized shape, at most; a double, so that it cannot overflow.
[[nodiscard]] double vertex_count(const CubeShape& shape) noexcept;
[[nodiscard]] double vertex_count(const SphereShape& shape) noexcept;
[[nodiscard]] double vertex_count(const PlaneShape& shape) noexcept;
[[nodiscard]] double vertex_count(const QuadShape& shape) noexcept;
[[nodiscard]] double vertex_count(const PrismShape& shape) noexcept;
[[nodiscard]] double vertex_count(const CylinderShape& shape) noexcept;
[[nodiscard]] double vertex_count(const CapsuleShape& shape) noexcept;

/// The shape must be sanitized.
[[nodiscard]] SurfaceArrays make_shape(const CubeShape& shape);
[[nodiscard]] SurfaceArrays make_shape(const SphereShape& shape);
[[nodiscard]] SurfaceArrays make_shape(const PlaneShape& shape);
[[nodiscard]] SurfaceArrays make_shape(const QuadShape& shape);
[[nodiscard]] SurfaceArrays make_shape(const PrismShape& shape);
[[nodiscard]] SurfaceArrays make_shape(const CylinderShape& shape);
[[nodiscard]] SurfaceArrays make_shape(const CapsuleShape& shape);

} // namespace cl::scene
