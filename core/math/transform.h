#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cl {

/// Affine map p' = basis * p + origin. Columns of `basis` are the images of the x, y and z axes. [m]
struct Transform {
    glm::mat3 basis{1.0f};
    glm::vec3 origin{0.0f};

    [[nodiscard]] glm::vec3 xform(const glm::vec3& point) const noexcept { return basis * point + origin; }
    [[nodiscard]] Transform operator*(const Transform& right) const noexcept {
        return {basis * right.basis, basis * right.origin + origin};
    }
    /// The inverse of any invertible transform. A singular basis gives non-finite numbers.
    [[nodiscard]] Transform inverse() const noexcept;
    /// Gram-Schmidt on the columns x, y, z in that order: what cameras, lights and GI probes use as their
    /// global transform (scene scale has no effect on them).
    [[nodiscard]] Transform orthonormalized() const noexcept;
    [[nodiscard]] glm::mat4 to_mat4() const noexcept;
    friend bool operator==(const Transform&, const Transform&) = default;
};

/// 2D affine map; columns x, y, origin.
struct Transform2D {
    glm::vec2 x{1.0f, 0.0f};
    glm::vec2 y{0.0f, 1.0f};
    glm::vec2 origin{0.0f};
    friend bool operator==(const Transform2D&, const Transform2D&) = default;
};

/// Rotation from Euler angles in Godot's YXZ order. @param euler_rad  angles about x, y, z [rad]
[[nodiscard]] glm::mat3 basis_from_euler_yxz(const glm::vec3& euler_rad) noexcept;
/// Inverse of basis_from_euler_yxz for a rotation matrix; [rad].
[[nodiscard]] glm::vec3 euler_yxz_from_basis(const glm::mat3& basis) noexcept;

} // namespace cl
