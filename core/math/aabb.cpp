#include "core/math/aabb.h"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace cl {

bool AABB::intersects_inclusive(const AABB& other) const noexcept {
    return glm::all(glm::lessThanEqual(position, other.end())) &&
           glm::all(glm::lessThanEqual(other.position, end()));
}

bool AABB::intersects(const AABB& other) const noexcept {
    return glm::all(glm::lessThan(position, other.end())) && glm::all(glm::lessThan(other.position, end()));
}

AABB AABB::merged(const AABB& other) const noexcept {
    const glm::vec3 low = glm::min(position, other.position);
    return {low, glm::max(end(), other.end()) - low};
}

AABB AABB::expanded_to(const glm::vec3& point) const noexcept {
    const glm::vec3 low = glm::min(position, point);
    return {low, glm::max(end(), point) - low};
}

AABB AABB::grown(float by_m) const noexcept {
    return {position - glm::vec3(by_m), size + glm::vec3(2.0f * by_m)};
}

AABB transformed(const Transform& xform, const AABB& box) noexcept {
    // Each corner coordinate is a sum of one term per column; its least and greatest are reached by choosing
    // the lesser or greater term of every column by itself.
    glm::vec3 low = xform.xform(box.position);
    glm::vec3 extent(0.0f);
    for (int axis = 0; axis < 3; axis++) {
        const glm::vec3 edge = xform.basis[axis] * box.size[axis];
        low += glm::min(edge, glm::vec3(0.0f));
        extent += glm::abs(edge);
    }
    return {low, extent};
}

float Plane::distance_to(const glm::vec3& p) const noexcept {
    return glm::dot(normal, p) - d;
}

} // namespace cl
