#pragma once

#include "core/math/transform.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cl {

/// Axis-aligned box: least corner and size [m]. A size may be 0 on an axis (a plane), never negative in use.
struct AABB {
    glm::vec3 position{0.0f};
    glm::vec3 size{0.0f};

    [[nodiscard]] glm::vec3 end() const noexcept { return position + size; }
    [[nodiscard]] glm::vec3 center() const noexcept { return position + size * 0.5f; }
    /// Inclusive: boxes that touch do intersect.
    [[nodiscard]] bool intersects_inclusive(const AABB& other) const noexcept;
    /// Strict: boxes that only touch do not intersect.
    [[nodiscard]] bool intersects(const AABB& other) const noexcept;
    [[nodiscard]] AABB merged(const AABB& other) const noexcept;
    [[nodiscard]] AABB expanded_to(const glm::vec3& point) const noexcept;
    [[nodiscard]] AABB grown(float by_m) const noexcept;
    friend bool operator==(const AABB&, const AABB&) = default;
};

/// The box around the eight transformed corners.
[[nodiscard]] AABB transformed(const Transform& xform, const AABB& box) noexcept;

struct Rect2 {
    glm::vec2 position{0.0f};
    glm::vec2 size{0.0f};
    friend bool operator==(const Rect2&, const Rect2&) = default;
};

/// Points p with dot(normal, p) == d.
struct Plane {
    glm::vec3 normal{0.0f};
    float d = 0.0f;
    [[nodiscard]] float distance_to(const glm::vec3& p) const noexcept;
    friend bool operator==(const Plane&, const Plane&) = default;
};

} // namespace cl
