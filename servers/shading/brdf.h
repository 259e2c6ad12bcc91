#pragma once

#include <glm/vec3.hpp>

// Reflection of one light and of the environment, as pure functions: the CPU twin of shaders/lib/brdf.glsl
// and lib/environment_brdf.glsl. Vectors have unit length, colours are linear. Cosines: nl = N.L and
// nv_signed = N.V signed; nv, lh, nh clamped at 0, with H = normalize(V + L). Source: spec scene-classes
// section 8.
namespace cl::shading {

inline constexpr float kPi = 3.14159265359f;

/// Weight of Schlick's Fresnel approximation: (1 - cosine)^5, the cosine clamped to [0, 1].
[[nodiscard]] float schlick_weight(float cosine) noexcept;

// Diffuse terms include the cosine. Light colour (energy * pi) * albedo * term = outgoing radiance.
[[nodiscard]] float diffuse_burley(float nl, float nv, float lh, float roughness) noexcept;
[[nodiscard]] float diffuse_lambert(float nl) noexcept;
[[nodiscard]] float diffuse_lambert_wrap(float nl, float roughness) noexcept;
/// @param lv  L.V
[[nodiscard]] glm::vec3 diffuse_oren_nayar(float nl, float nv_signed, float lv, float roughness,
                                           const glm::vec3& albedo) noexcept;
[[nodiscard]] float diffuse_toon(float nl, float roughness) noexcept;

/// Reflectance at normal incidence.
[[nodiscard]] glm::vec3 f0_from_material(const glm::vec3& albedo, float metallic, float specular) noexcept;

// Specular terms include the cosine. Roughness must be above 0: at 0 a point light has no visible gloss.
[[nodiscard]] glm::vec3 specular_ggx(float nl, float nv, float lh, float nh, float roughness,
                                     const glm::vec3& f0) noexcept;
[[nodiscard]] float phong_exponent(float roughness) noexcept;
[[nodiscard]] float specular_blinn(float nl, float nh, float roughness) noexcept;
/// @param rv  R.V with R the mirror direction of L
[[nodiscard]] float specular_phong(float nl, float nv, float rv, float roughness) noexcept;
[[nodiscard]] float specular_toon(float rv, float roughness) noexcept;

/// Fresnel term of light from all around (spec gi-shading section 7, step 1). @param nv  in [0, 1]
[[nodiscard]] glm::vec3 fresnel_rough(const glm::vec3& f0, float roughness, float nv) noexcept;
/// What of the reflected environment reaches the eye (step 4; Lazarov 2013).
[[nodiscard]] glm::vec3 environment_brdf(const glm::vec3& fresnel, float roughness, float nv) noexcept;

} // namespace cl::shading
