#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cl::radiosity {

/// A convex polygon on the stack: a triangle cut by the six planes of a box has at most 9 corners.
struct Polygon {
    std::array<glm::vec3, 10> corners;
    size_t count = 0;

    void add(const glm::vec3& corner) noexcept {
        if (count < corners.size()) {
            corners[count++] = corner;
        }
    }
    /// Centroid in the first three numbers' place, area returned.
    float area_and_centroid(glm::vec3& centroid) const noexcept {
        float area = 0.0f;
        centroid = glm::vec3(0.0f);
        for (size_t i = 2; i < count; ++i) {
            const float part =
                0.5f * glm::length(glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]));
            centroid += part / 3.0f * (corners[0] + corners[i - 1] + corners[i]);
            area += part;
        }
        centroid = area > 0.0f ? centroid / area : corners[0];
        return area;
    }
};

/// The part of a polygon where sign * (p[axis] - at) >= 0. Source: Sutherland and Hodgman 1974.
[[nodiscard]] inline Polygon clip(const Polygon& in, int axis, float at, float sign) noexcept {
    Polygon out;
    for (size_t i = 0; i < in.count; ++i) {
        const glm::vec3 &a = in.corners[i], &b = in.corners[i + 1 == in.count ? 0 : i + 1];
        const float da = sign * (a[axis] - at), db = sign * (b[axis] - at);
        if (da >= 0.0f) {
            out.add(a);
        }
        if ((da >= 0.0f) != (db >= 0.0f)) {
            out.add(a + (b - a) * (da / (da - db)));
        }
    }
    return out;
}

/// Calls f(first, last) with the whole numbers whose unit slabs a polygon touches along an axis, within [0,
/// end).
template <typename F>
void for_each_slab(const Polygon& polygon, int axis, int end, const F& f) {
    float low = polygon.corners[0][axis], high = low;
    for (size_t i = 1; i < polygon.count; ++i) {
        low = std::min(low, polygon.corners[i][axis]);
        high = std::max(high, polygon.corners[i][axis]);
    }
    if (!(high >= 0.0f) || !(low < float(end))) {
        return;
    }
    const int first = int(std::floor(std::max(low, 0.0f)));
    const int last = int(std::floor(std::min(high, float(end) - 0.5f)));
    for (int i = first; i <= last; ++i) {
        const Polygon slab = clip(clip(polygon, axis, float(i), 1.0f), axis, float(i + 1), -1.0f);
        if (slab.count >= 3) {
            f(i, slab);
        }
    }
}

/// Calls f(cell, piece) for each cell of [0, dims) that a polygon enters, with the piece inside it.
template <typename F>
void for_each_cell_piece(const Polygon& polygon, const glm::ivec3& dims, const F& f) {
    for_each_slab(polygon, 0, dims.x, [&](int x, const Polygon& px) {
        for_each_slab(px, 1, dims.y, [&](int y, const Polygon& pxy) {
            for_each_slab(pxy, 2, dims.z,
                          [&](int z, const Polygon& piece) { f(glm::ivec3(x, y, z), piece); });
        });
    });
}

} // namespace cl::radiosity
