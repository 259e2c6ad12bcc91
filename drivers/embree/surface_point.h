#pragma once

#include "drivers/embree/bsdf.h"
#include "drivers/embree/ray_scene.h"
#include "drivers/embree/traced_item.h"

#include <glm/vec3.hpp>

namespace cl::embree {

/// What a ray met, as seen from where it came: all that light needs to know. World space, linear colours.
struct SurfacePoint {
    const TracedItem* item = nullptr;
    glm::vec3 position{0.0f};
    glm::vec3 to_eye{0.0f};           ///< unit length
    glm::vec3 geometric_normal{0.0f}; ///< of the triangle, on the side that was met; unit length
    glm::vec3 albedo{0.0f};
    float metallic = 0.0f;
    float occlusion = 1.0f;      ///< of light from all around, by the material's AO map
    float occlusion_lamp = 1.0f; ///< of lamps and reflections
    Bsdf bsdf;
    glm::vec3 emission{0.0f};

    /// Where rays on the side of `direction` start.
    [[nodiscard]] glm::vec3 start_of(const glm::vec3& direction) const noexcept;
    [[nodiscard]] bool is_outside(const glm::vec3& direction) const noexcept;
};

/// @param direction  of the ray that made the hit, unit length
[[nodiscard]] SurfacePoint surface_point(const TracedItem& item, const Hit& hit,
                                         const glm::vec3& direction) noexcept;

} // namespace cl::embree
