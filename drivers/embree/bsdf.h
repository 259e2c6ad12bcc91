#pragma once

#include "servers/render_types.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace cl::embree {

/// How a surface reflects what comes from other surfaces and from the sky, at one point. Vectors have unit
/// length, in world space; colours are linear.
///
/// Diffuse: Burley, Oren-Nayar or Lambert, times 1 - F as sky light is in the scene pass (spec scene-classes
/// section 14.3), so that a surface sends out no more than it receives (Burley's sheen of
/// rough ones: 4 % more on the mean). Wrap and toon shading have no meaning
/// for light from all around: they reflect it as Lambert does, as in the scene pass. Specular: GGX as
/// servers/shading/brdf.h has it, for all specular modes.
struct Bsdf {
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
    glm::vec3 diffuse{0.0f}; ///< albedo of what is not metal
    glm::vec3 f0{0.0f};
    float gloss = 1.0f; ///< factor on the specular lobe
    float roughness = 1.0f;
    DiffuseMode diffuse_mode = DiffuseMode::Lambert;
};

/// Reflectance times cosine [1/sr], by lobe, and the density [1/sr] with which sample_bsdf() finds the
/// direction.
struct Scattering {
    glm::vec3 diffuse{0.0f}, specular{0.0f};
    float pdf = 0.0f;
    [[nodiscard]] glm::vec3 sum() const noexcept { return diffuse + specular; }
};

struct ScatteredDirection {
    glm::vec3 direction{0.0f};
    Scattering scattering;
};

/// Roughness below which a surface reflects as if it had this one: floats cannot tell narrower lobes.
inline constexpr float kLeastRoughness = 0.05f;

[[nodiscard]] Scattering evaluate_bsdf(const Bsdf& bsdf, const glm::vec3& to_eye,
                                       const glm::vec3& to_light) noexcept;
/// A direction by the density of evaluate_bsdf(); none if nothing is reflected there.
/// @param u_lobe  chooses the lobe, @param u  the direction
[[nodiscard]] std::optional<ScatteredDirection> sample_bsdf(const Bsdf& bsdf, const glm::vec3& to_eye,
                                                            float u_lobe, const glm::vec2& u) noexcept;

} // namespace cl::embree
