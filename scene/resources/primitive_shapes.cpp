#include "scene/resources/primitive_shapes.h"

#include "scene/resources/primitive_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace cl::scene {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kThird = 1.0f / 3.0f;
constexpr float kTwoThirds = 2.0f / 3.0f;

constexpr glm::vec3 kPlusX{1, 0, 0}, kMinusX{-1, 0, 0}, kPlusY{0, 1, 0}, kMinusY{0, -1, 0};
constexpr glm::vec3 kPlusZ{0, 0, 1}, kMinusZ{0, 0, -1};
constexpr glm::vec4 kAlongX{1, 0, 0, 1}, kAgainstX{-1, 0, 0, 1}, kAlongZ{0, 0, 1, 1}, kAgainstZ{0, 0, -1, 1};

/// index / (times * count), the fraction of a row or column of a grid.
float fraction(int index, double times, int count) {
    return static_cast<float>(index / (times * count));
}

/// Point `i` of `segments` around a circle: x = sin, y = cos of the angle, rounded to float as they are
/// stored.
glm::vec2 on_circle(int i, int segments) {
    const float u = static_cast<float>(i) / static_cast<float>(segments);
    const double angle = u * (kPi * 2.0);
    return {static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle))};
}

glm::vec3 normalized_or_zero(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : glm::vec3(0.0f);
}

void add_front_and_back(ShapeBuilder& b, const CubeShape& c) {
    const glm::vec3 s = c.size * -0.5f;
    const int columns = c.subdivide_width + 1, rows = c.subdivide_height + 1;
    const std::vector<float> xs = run(s.x, c.size.x, columns), ys = run(s.y, c.size.y, rows);
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float v = fraction(j, 2.0, rows);
        for (int i = 0; i <= columns; ++i) {
            const float u = fraction(i, 3.0, columns);
            b.vertex({xs[i], -ys[j], -s.z}, kPlusZ, kAlongX, {u, v});
            b.vertex({-xs[i], -ys[j], s.z}, kMinusZ, kAgainstX, {kTwoThirds + u, v});
        }
    }
    b.end_paired_grid(rows, columns);
}

void add_right_and_left(ShapeBuilder& b, const CubeShape& c) {
    const glm::vec3 s = c.size * -0.5f;
    const int columns = c.subdivide_depth + 1, rows = c.subdivide_height + 1;
    const std::vector<float> zs = run(s.z, c.size.z, columns), ys = run(s.y, c.size.y, rows);
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float v = fraction(j, 2.0, rows);
        for (int i = 0; i <= columns; ++i) {
            const float u = fraction(i, 3.0, columns);
            b.vertex({-s.x, -ys[j], -zs[i]}, kPlusX, kAgainstZ, {kThird + u, v});
            b.vertex({s.x, -ys[j], zs[i]}, kMinusX, kAlongZ, {u, 0.5f + v});
        }
    }
    b.end_paired_grid(rows, columns);
}

void add_top_and_bottom(ShapeBuilder& b, const CubeShape& c) {
    const glm::vec3 s = c.size * -0.5f;
    const int columns = c.subdivide_width + 1, rows = c.subdivide_depth + 1;
    const std::vector<float> xs = run(s.x, c.size.x, columns), zs = run(s.z, c.size.z, rows);
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float v = fraction(j, 2.0, rows);
        for (int i = 0; i <= columns; ++i) {
            const float u = fraction(i, 3.0, columns);
            b.vertex({-xs[i], -s.y, -zs[j]}, kPlusY, kAgainstX, {kThird + u, 0.5f + v});
            b.vertex({xs[i], s.y, -zs[j]}, kMinusY, kAlongX, {kTwoThirds + u, 0.5f + v});
        }
    }
    b.end_paired_grid(rows, columns);
}

} // namespace

SurfaceArrays make_shape(const CubeShape& shape) {
    ShapeBuilder b;
    add_front_and_back(b, shape);
    add_right_and_left(b, shape);
    add_top_and_bottom(b, shape);
    return b.take();
}

SurfaceArrays make_shape(const SphereShape& shape) {
    ShapeBuilder b;
    const int rows = shape.rings + 1, columns = shape.radial_segments;
    const double half_height = shape.height * (shape.is_hemisphere ? 1.0 : 0.5);
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float v = fraction(j, 1.0, rows);
        const float w = static_cast<float>(std::sin(kPi * v));
        const float y = static_cast<float>(half_height * std::cos(kPi * v));
        for (int i = 0; i <= columns; ++i) {
            const glm::vec2 c = on_circle(i, columns);
            const bool flat = shape.is_hemisphere && y < 0.0f;
            const glm::vec3 p{c.x * shape.radius * w, flat ? 0.0f : y, c.y * shape.radius * w};
            b.vertex(p, flat ? kMinusY : normalized_or_zero(p), {c.y, 0.0f, -c.x, 1.0f},
                     {fraction(i, 1.0, columns), v});
        }
    }
    b.end_grid(rows, columns);
    return b.take();
}

SurfaceArrays make_shape(const PlaneShape& shape) {
    ShapeBuilder b;
    const int columns = shape.subdivide_width + 1, rows = shape.subdivide_depth + 1;
    const std::vector<float> xs = run(shape.size.x * -0.5f, shape.size.x, columns);
    const std::vector<float> zs = run(shape.size.y * -0.5f, shape.size.y, rows);
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            b.vertex({-xs[i], 0.0f, -zs[j]}, kPlusY, kAlongX,
                     {1.0f - fraction(i, 1.0, columns), 1.0f - fraction(j, 1.0, rows)});
        }
    }
    b.end_grid(rows, columns);
    return b.take();
}

SurfaceArrays make_shape(const QuadShape& shape) {
    const glm::vec2 h = shape.size * 0.5f;
    const glm::vec3 corners[4] = {{-h.x, -h.y, 0}, {-h.x, h.y, 0}, {h.x, h.y, 0}, {h.x, -h.y, 0}};
    const glm::vec2 uvs[4] = {{0, 1}, {0, 0}, {1, 0}, {1, 1}};
    ShapeBuilder b;
    for (int corner : {0, 1, 2, 0, 2, 3}) {
        b.vertex(corners[corner], kPlusZ, kAlongX, uvs[corner]);
    }
    return b.take();
}

namespace {

void add_cylinder_side(ShapeBuilder& b, const CylinderShape& shape) {
    const int rows = shape.rings + 1, columns = shape.radial_segments;
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float v = fraction(j, 1.0, rows);
        const float radius = shape.top_radius + (shape.bottom_radius - shape.top_radius) * v;
        const float y = shape.height * 0.5f - shape.height * v;
        for (int i = 0; i <= columns; ++i) {
            const glm::vec2 c = on_circle(i, columns);
            // The normal does not lean on a cone: that is what Godot makes.
            b.vertex({c.x * radius, y, c.y * radius}, {c.x, 0.0f, c.y}, {c.y, 0.0f, -c.x, 1.0f},
                     {fraction(i, 1.0, columns), v * 0.5f});
        }
    }
    b.end_grid(rows, columns);
}

void add_cylinder_top(ShapeBuilder& b, const CylinderShape& shape) {
    const float y = shape.height * 0.5f;
    const uint32_t center = b.vertex({0, y, 0}, kPlusY, kAlongX, {0.25f, 0.75f});
    for (int i = 0; i <= shape.radial_segments; ++i) {
        const glm::vec2 c = on_circle(i, shape.radial_segments);
        const uint32_t last = b.vertex({c.x * shape.top_radius, y, c.y * shape.top_radius}, kPlusY, kAlongX,
                                       {(c.x + 1.0f) * 0.25f, 0.5f + (c.y + 1.0f) * 0.25f});
        if (i > 0) {
            b.triangle(center, last, last - 1);
        }
    }
}

void add_cylinder_bottom(ShapeBuilder& b, const CylinderShape& shape) {
    const float y = shape.height * -0.5f;
    const uint32_t center = b.vertex({0, y, 0}, kMinusY, kAlongX, {0.75f, 0.75f});
    for (int i = 0; i <= shape.radial_segments; ++i) {
        const glm::vec2 c = on_circle(i, shape.radial_segments);
        const uint32_t last = b.vertex({c.x * shape.bottom_radius, y, c.y * shape.bottom_radius}, kMinusY,
                                       kAlongX, {0.5f + (c.x + 1.0f) * 0.25f, 1.0f - (c.y + 1.0f) * 0.25f});
        if (i > 0) {
            b.triangle(center, last - 1, last);
        }
    }
}

} // namespace

SurfaceArrays make_shape(const CylinderShape& shape) {
    ShapeBuilder b;
    add_cylinder_side(b, shape);
    if (shape.top_radius > 0.0f) {
        add_cylinder_top(b, shape);
    }
    if (shape.bottom_radius > 0.0f) {
        add_cylinder_bottom(b, shape);
    }
    return b.take();
}

namespace {

enum class Cap { Top, Bottom };

void add_capsule_cap(ShapeBuilder& b, const CapsuleShape& shape, Cap cap) {
    const int rows = shape.rings + 1, columns = shape.radial_segments;
    const float first_v = cap == Cap::Top ? 0.0f : 1.0f;
    const float shift_z = shape.mid_height * (cap == Cap::Top ? 0.5f : -0.5f);
    const float uv_start = cap == Cap::Top ? 0.0f : kTwoThirds;
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float v = fraction(j, 1.0, rows);
        const double angle = 0.5 * kPi * (v + first_v);
        const float w = static_cast<float>(std::sin(angle));
        const float z = static_cast<float>(shape.radius * std::cos(angle));
        for (int i = 0; i <= columns; ++i) {
            const glm::vec2 c = on_circle(i, columns);
            const glm::vec3 p{c.x * shape.radius * w, -c.y * shape.radius * w, z};
            b.vertex(p + glm::vec3(0, 0, shift_z), normalized_or_zero(p), {c.y, c.x, 0.0f, 1.0f},
                     {fraction(i, 1.0, columns), uv_start + v * kThird});
        }
    }
    b.end_grid(rows, columns);
}

void add_capsule_tube(ShapeBuilder& b, const CapsuleShape& shape) {
    const int rows = shape.rings + 1, columns = shape.radial_segments;
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float v = fraction(j, 1.0, rows);
        const float z = shape.mid_height * 0.5f - shape.mid_height * v;
        for (int i = 0; i <= columns; ++i) {
            const glm::vec2 c = on_circle(i, columns);
            b.vertex({c.x * shape.radius, -c.y * shape.radius, z}, {c.x, -c.y, 0.0f}, {c.y, c.x, 0.0f, 1.0f},
                     {fraction(i, 1.0, columns), kThird + v * kThird});
        }
    }
    b.end_grid(rows, columns);
}

} // namespace

SurfaceArrays make_shape(const CapsuleShape& shape) {
    ShapeBuilder b;
    add_capsule_cap(b, shape, Cap::Top);
    add_capsule_tube(b, shape);
    add_capsule_cap(b, shape, Cap::Bottom);
    return b.take();
}

namespace {

void add_prism_front_and_back(ShapeBuilder& b, const PrismShape& p) {
    const glm::vec3 s = p.size * -0.5f;
    const float k = p.left_to_right;
    const int columns = p.subdivide_width + 1, rows = p.subdivide_height + 1;
    const std::vector<float> ys = run(s.y, p.size.y, rows);
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float scale = (ys[j] - s.y) / p.size.y;
        const float width = scale * p.size.x;
        const float start = s.x + (1.0f - scale) * p.size.x * k;
        const float front_u = (1.0f - scale) * k * kThird;
        const float back_u = kTwoThirds + (1.0f - scale) * (1.0f - k) * kThird;
        const float v = fraction(j, 2.0, rows);
        const std::vector<float> xs = run(0.0f, width, columns);
        for (int i = 0; i <= columns; ++i) {
            const float u = scale * fraction(i, 3.0, columns);
            b.vertex({start + xs[i], -ys[j], -s.z}, kPlusZ, kAlongX, {front_u + u, v});
            b.vertex({start + width - xs[i], -ys[j], s.z}, kMinusZ, kAgainstX, {back_u + u, v});
        }
    }
    b.end_paired_grid(rows, columns, FirstRow::Apex);
}

void add_prism_right_and_left(ShapeBuilder& b, const PrismShape& p) {
    const glm::vec3 s = p.size * -0.5f;
    const float k = p.left_to_right;
    const glm::vec3 right_normal = normalized_or_zero({p.size.y, p.size.x * k, 0.0f});
    const glm::vec3 left_normal = normalized_or_zero({-p.size.y, p.size.x * k, 0.0f});
    const int columns = p.subdivide_depth + 1, rows = p.subdivide_height + 1;
    const std::vector<float> ys = run(s.y, p.size.y, rows), zs = run(s.z, p.size.z, columns);
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float scale = (ys[j] - s.y) / p.size.y;
        const float left = s.x + p.size.x * (1.0f - scale) * k;
        const float right = left + p.size.x * scale;
        const float v = fraction(j, 2.0, rows);
        for (int i = 0; i <= columns; ++i) {
            const float u = fraction(i, 3.0, columns);
            b.vertex({right, -ys[j], -zs[i]}, right_normal, kAgainstZ, {kThird + u, v});
            b.vertex({left, -ys[j], zs[i]}, left_normal, kAlongZ, {u, 0.5f + v});
        }
    }
    b.end_paired_grid(rows, columns);
}

void add_prism_bottom(ShapeBuilder& b, const PrismShape& p) {
    const glm::vec3 s = p.size * -0.5f;
    const int columns = p.subdivide_width + 1, rows = p.subdivide_depth + 1;
    const std::vector<float> xs = run(s.x, p.size.x, columns), zs = run(s.z, p.size.z, rows);
    b.begin_grid();
    for (int j = 0; j <= rows; ++j) {
        const float v = fraction(j, 2.0, rows);
        for (int i = 0; i <= columns; ++i) {
            b.vertex({xs[i], s.y, -zs[j]}, kMinusY, kAlongX,
                     {kTwoThirds + fraction(i, 3.0, columns), 0.5f + v});
        }
    }
    b.end_grid(rows, columns);
}

} // namespace

SurfaceArrays make_shape(const PrismShape& shape) {
    ShapeBuilder b;
    add_prism_front_and_back(b, shape);
    add_prism_right_and_left(b, shape);
    add_prism_bottom(b, shape);
    return b.take();
}

} // namespace cl::scene
