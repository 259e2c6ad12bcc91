#pragma once

#include "drivers/embree/surface_point.h"

#include "servers/rasterizer.h"

#include <glm/vec3.hpp>

#include <limits>
#include <optional>

namespace cl::embree {

/// Lights of the scene: points, cones and directions without size, in Godot's units. The twin of
/// shaders/lib/lights.glsl, with rays for shadow maps (spec scene-classes section 8): a white Lambert surface
/// that faces a lamp of energy 1 sends out radiance 1 times the attenuation.
class Lamp {
public:
    explicit Lamp(const LightItem& item);

    /// What arrives at a point, were nothing in the way.
    struct Arrival {
        glm::vec3 to_lamp{0.0f}; ///< unit length
        float distance_m = std::numeric_limits<float>::infinity();
        glm::vec3 color{0.0f}; ///< linear, times pi; negative for a lamp that takes light away
    };
    /// None if the lamp does not reach there or leaves the item out.
    [[nodiscard]] std::optional<Arrival> arrival(const SurfacePoint& at) const noexcept;
    [[nodiscard]] bool casts_shadow() const noexcept { return shadow_; }
    /// Factor on the colour where something is in the way.
    [[nodiscard]] const glm::vec3& shadow_color() const noexcept { return shadow_color_; }
    /// Factor on specular reflection.
    [[nodiscard]] float specular() const noexcept { return specular_; }
    /// Factor on what arrives at surfaces that the camera does not see itself: the scene's word on how much a
    /// light takes part in global illumination (1 unless it says something).
    [[nodiscard]] float bounce_factor() const noexcept { return bounce_factor_; }

private:
    [[nodiscard]] float attenuation(const glm::vec3& to_lamp, float distance_m) const noexcept;

    LightType type_;
    glm::vec3 position_, axis_; ///< the axis points against the light's way
    glm::vec3 color_, shadow_color_;
    float range_m_, exponent_;
    float cos_angle_, angle_exponent_;
    float specular_, bounce_factor_;
    uint32_t cull_mask_;
    bool shadow_;
};

/// Radiance that a point reflects to the eye of what arrives from a lamp: the same terms, by the material's
/// modes, as the scene pass adds up.
[[nodiscard]] glm::vec3 reflect_lamp(const SurfacePoint& at, const Lamp::Arrival& arrival,
                                     float specular_factor) noexcept;

} // namespace cl::embree
