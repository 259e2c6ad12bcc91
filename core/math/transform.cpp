#include "core/math/transform.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cl {
namespace {

/// Unit vector along v; the zero vector stays zero, so that a flattened basis gives finite numbers.
glm::vec3 normalized_or_zero(const glm::vec3& v) noexcept {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : glm::vec3(0.0f);
}

} // namespace

Transform Transform::inverse() const noexcept {
    const glm::mat3 inverse_basis = glm::inverse(basis);
    return {inverse_basis, -(inverse_basis * origin)};
}

Transform Transform::orthonormalized() const noexcept {
    const glm::vec3 x = normalized_or_zero(basis[0]);
    const glm::vec3 y = normalized_or_zero(basis[1] - x * glm::dot(x, basis[1]));
    const glm::vec3 z = normalized_or_zero(basis[2] - x * glm::dot(x, basis[2]) - y * glm::dot(y, basis[2]));
    return {glm::mat3(x, y, z), origin};
}

glm::mat4 Transform::to_mat4() const noexcept {
    glm::mat4 m(basis);
    m[3] = glm::vec4(origin, 1.0f);
    return m;
}

glm::mat3 basis_from_euler_yxz(const glm::vec3& euler_rad) noexcept {
    const float cx = std::cos(euler_rad.x), sx = std::sin(euler_rad.x);
    const float cy = std::cos(euler_rad.y), sy = std::sin(euler_rad.y);
    const float cz = std::cos(euler_rad.z), sz = std::sin(euler_rad.z);
    // Columns of the product Ry * Rx * Rz.
    return {glm::vec3(cy * cz + sy * sx * sz, cx * sz, cy * sx * sz - sy * cz),
            glm::vec3(sy * sx * cz - cy * sz, cx * cz, sy * sz + cy * sx * cz),
            glm::vec3(sy * cx, -sx, cy * cx)};
}

glm::vec3 euler_yxz_from_basis(const glm::mat3& basis) noexcept {
    constexpr float kHalfPi = std::numbers::pi_v<float> / 2.0f;
    const float sin_x = std::clamp(-basis[2][1], -1.0f, 1.0f);
    // At the poles y and z turn about one axis: all of the turn is given to y. 1 - 1e-6 is where cos(x),
    // known to float precision, no longer says anything about y and z.
    if (std::abs(sin_x) > 1.0f - 1e-6f) {
        const float sign = sin_x > 0.0f ? 1.0f : -1.0f;
        return {sign * kHalfPi, std::atan2(sign * basis[1][0], basis[0][0]), 0.0f};
    }
    return {std::asin(sin_x), std::atan2(basis[2][0], basis[2][2]), std::atan2(basis[0][1], basis[1][1])};
}

} // namespace cl
