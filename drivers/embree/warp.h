#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// Uniform numbers in the unit square to what paths need: directions, points, and the weights that join two
// ways of finding the same light.
namespace cl::embree {

inline constexpr float kPi = 3.14159265359f;

/// An orthonormal frame around `normal` (unit length): local z is the normal.
struct Basis {
    glm::vec3 tangent, bitangent, normal;
    /// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited" (JCGT 6-1).
    explicit Basis(const glm::vec3& unit_normal) noexcept;
    [[nodiscard]] glm::vec3 to_world(const glm::vec3& local) const noexcept;
    [[nodiscard]] glm::vec3 to_local(const glm::vec3& world) const noexcept;
};

/// Direction about local z with density cos / pi (Malley's method, PBRT 4th edition, A.5.3).
[[nodiscard]] glm::vec3 cosine_hemisphere(const glm::vec2& u) noexcept;

/// Barycentric coordinates (of the second and third corner) of a uniform point on a triangle (PBRT, A.5.5).
[[nodiscard]] glm::vec2 uniform_triangle(const glm::vec2& u) noexcept;

/// Half vector about local z, from the GGX normals that `to_eye` sees. @param to_eye  z > 0
/// Source: Heitz 2018, "Sampling the GGX Distribution of Visible Normals" (JCGT 7-4), listing in appendix A.
[[nodiscard]] glm::vec3 visible_ggx_normal(const glm::vec3& to_eye, float alpha, const glm::vec2& u) noexcept;
/// Share of the microfacets at slope `cosine` > 0 that their neighbours do not hide (Heitz 2018, equation 2).
[[nodiscard]] float ggx_visible_share(float cosine, float alpha) noexcept;

/// Weight of a sample of density `pdf` where the other way would have found it with density `other`.
/// Source: Veach and Guibas 1995, "Optimally Combining Sampling Techniques", power heuristic with exponent 2.
[[nodiscard]] float power_heuristic(float pdf, float other) noexcept;

} // namespace cl::embree
