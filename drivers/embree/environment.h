#pragma once

#include "drivers/embree/sky_panorama.h"

#include "servers/rasterizer.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace cl::embree {

/// What rays see when they leave the scene, in world directions of unit length, as the scene pass has it
/// (spec scene-classes sections 14.2 and 14.3): the camera the background, matt surfaces the ambient light,
/// glossy ones the sky or the background's colour. Ambient light is radiance, so it is shadowed and bounces.
class Environment {
public:
    /// Borrows the sky; null: none.
    Environment(const Frame& frame, const SkyPanorama* sky);

    [[nodiscard]] glm::vec3 background(const glm::vec3& direction) const noexcept;
    [[nodiscard]] glm::vec3 ambient(const glm::vec3& direction) const noexcept;
    [[nodiscard]] glm::vec3 reflected(const glm::vec3& direction) const noexcept;

    /// False: the same in all directions, or black. Looking for its bright parts is then of no use.
    [[nodiscard]] bool has_bright_parts() const noexcept { return sky_ && !sky_->is_black(); }
    /// Only if it has bright parts.
    [[nodiscard]] SkyPanorama::Sample sample(const glm::vec2& u) const noexcept;
    /// Density [1/sr] of sample(); 0 without bright parts.
    [[nodiscard]] float pdf(const glm::vec3& direction) const noexcept;

private:
    [[nodiscard]] glm::vec3 sky_radiance(const glm::vec3& direction) const noexcept;

    const SkyPanorama* sky_ = nullptr;
    bool shows_sky_ = false; ///< to the camera
    glm::mat3 world_from_sky_{1.0f}, sky_from_world_{1.0f};
    float sky_energy_ = 1.0f;
    float sky_share_ = 0.0f; ///< of the ambient light
    glm::vec3 background_{0.0f}, ambient_{0.0f}, reflected_{0.0f};
    float ambient_energy_ = 1.0f;
};

} // namespace cl::embree
