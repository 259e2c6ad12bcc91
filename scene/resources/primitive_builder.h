#pragma once

#include "servers/mesh_surface.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace cl::scene {

/// steps + 1 coordinates from `start` to `start + length`, by repeated float32 addition: the last one may
/// miss the end by a rounding, as Godot's does.
[[nodiscard]] std::vector<float> run(float start, float length, int steps);

/// Whether a grid starts with a full row of quads or with an edge that has shrunk to a point.
enum class FirstRow { Quads, Apex };

/// Collects vertices row by row and makes the triangles between the rows (rule Q of spec scene-classes
/// section 17).
class ShapeBuilder {
public:
    /// Returns the vertex's index.
    uint32_t vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec4& tangent,
                    glm::vec2 uv);
    void triangle(uint32_t a, uint32_t b, uint32_t c);

    /// The vertices that follow are a grid of (rows + 1) * (columns + 1), row by row.
    void begin_grid() { grid_start_ = static_cast<uint32_t>(arrays_.positions.size()); }
    void end_grid(int rows, int columns);
    /// The same for two faces whose vertices alternate.
    void end_paired_grid(int rows, int columns, FirstRow first_row = FirstRow::Quads);

    [[nodiscard]] SurfaceArrays take() { return std::move(arrays_); }

private:
    SurfaceArrays arrays_;
    uint32_t grid_start_ = 0;
};

} // namespace cl::scene
