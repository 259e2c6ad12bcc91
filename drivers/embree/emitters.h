#pragma once

#include "drivers/embree/traced_item.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cl::embree {

/// The triangles that send out light, chosen by how much they may send: area times mean emission. One table
/// for the scene. Source: PBRT 4th edition, sections 12.2 (DiffuseAreaLight) and 12.6.2 (PowerLightSampler).
class Emitters {
public:
    /// Borrows the items, which must outlive it unmoved.
    explicit Emitters(std::span<const TracedItem> items);

    [[nodiscard]] bool empty() const noexcept { return entries_.empty(); }

    /// A point on an emitter.
    struct Point {
        glm::vec3 position{0.0f};
        glm::vec3 front_normal{0.0f}; ///< unit length
        uint32_t item = 0, triangle = 0;
        SurfaceCoordinates coordinates;
        float pdf_area = 0.0f; ///< [1/m^2]
    };
    /// @param u_triangle  chooses the triangle, @param u  the point on it. None if the table is empty.
    [[nodiscard]] std::optional<Point> sample(float u_triangle, const glm::vec2& u) const noexcept;
    /// Density [1/m^2] with which sample() finds each point of a triangle; 0 if it never does.
    [[nodiscard]] float pdf_area(uint32_t item, uint32_t triangle) const noexcept;

private:
    struct Entry {
        uint32_t item, triangle;
        float pdf_area;
    };
    std::span<const TracedItem> items_;
    std::vector<Entry> entries_;
    std::vector<float> upper_;               ///< of each entry: share of the power up to and with it
    std::vector<std::vector<float>> pdf_of_; ///< [item][triangle]; empty where an item does not emit
};

/// Density of a direction [1/sr] of one of a point: `cosine` at the surface that holds the point.
[[nodiscard]] inline float solid_angle_pdf(float pdf_area, float distance2_m2, float cosine) noexcept {
    return cosine > 0.0f ? pdf_area * distance2_m2 / cosine : 0.0f;
}

} // namespace cl::embree
