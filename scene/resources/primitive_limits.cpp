#include "scene/resources/primitive_shapes.h"

#include <algorithm>

namespace cl::scene {

namespace {

double grid(double columns, double rows) noexcept {
    return (columns + 1.0) * (rows + 1.0);
}

void at_least(int& count, int least) noexcept {
    count = std::max(count, least);
}

} // namespace

CubeShape sanitized(CubeShape shape) noexcept {
    at_least(shape.subdivide_width, 0);
    at_least(shape.subdivide_height, 0);
    at_least(shape.subdivide_depth, 0);
    return shape;
}

SphereShape sanitized(SphereShape shape) noexcept {
    at_least(shape.radial_segments, 4);
    at_least(shape.rings, 1);
    return shape;
}

PlaneShape sanitized(PlaneShape shape) noexcept {
    at_least(shape.subdivide_width, 0);
    at_least(shape.subdivide_depth, 0);
    return shape;
}

QuadShape sanitized(QuadShape shape) noexcept {
    return shape;
}

PrismShape sanitized(PrismShape shape) noexcept {
    at_least(shape.subdivide_width, 0);
    at_least(shape.subdivide_height, 0);
    at_least(shape.subdivide_depth, 0);
    return shape;
}

CylinderShape sanitized(CylinderShape shape) noexcept {
    at_least(shape.radial_segments, 4);
    at_least(shape.rings, 0);
    return shape;
}

CapsuleShape sanitized(CapsuleShape shape) noexcept {
    at_least(shape.radial_segments, 4);
    at_least(shape.rings, 1);
    return shape;
}

double vertex_count(const CubeShape& s) noexcept {
    const double w = s.subdivide_width + 1.0, h = s.subdivide_height + 1.0, d = s.subdivide_depth + 1.0;
    return 2.0 * (grid(w, h) + grid(d, h) + grid(w, d));
}

double vertex_count(const SphereShape& s) noexcept {
    return grid(s.radial_segments, s.rings + 1.0);
}

double vertex_count(const PlaneShape& s) noexcept {
    return grid(s.subdivide_width + 1.0, s.subdivide_depth + 1.0);
}

double vertex_count(const QuadShape&) noexcept {
    return 6.0;
}

double vertex_count(const PrismShape& s) noexcept {
    const double w = s.subdivide_width + 1.0, h = s.subdivide_height + 1.0, d = s.subdivide_depth + 1.0;
    return 2.0 * (grid(w, h) + grid(d, h)) + grid(w, d);
}

double vertex_count(const CylinderShape& s) noexcept {
    return grid(s.radial_segments, s.rings + 1.0) + 2.0 * (s.radial_segments + 2.0);
}

double vertex_count(const CapsuleShape& s) noexcept {
    return 3.0 * grid(s.radial_segments, s.rings + 1.0);
}

} // namespace cl::scene
