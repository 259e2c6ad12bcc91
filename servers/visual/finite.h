#pragma once

#include "servers/render_types.h"

#include "core/math/aabb.h"
#include "core/math/color.h"
#include "core/math/transform.h"

#include <glm/vec3.hpp>

#include <cmath>

namespace cl {

// Numbers that are not finite are refused at the server's door: a NaN equals nothing, so a light that holds
// one would look changed on every frame.

[[nodiscard]] inline bool is_finite(const glm::vec3& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
[[nodiscard]] inline bool is_finite(const Transform& t) noexcept {
    return is_finite(t.basis[0]) && is_finite(t.basis[1]) && is_finite(t.basis[2]) && is_finite(t.origin);
}
[[nodiscard]] inline bool is_finite(const AABB& box) noexcept {
    return is_finite(box.position) && is_finite(box.size) && is_finite(box.end());
}
/// The parameters that decide where a light shines and how strongly.
[[nodiscard]] inline bool is_finite(const LightDesc& light) noexcept {
    return is_finite(light.color.rgb()) && std::isfinite(light.energy) &&
           std::isfinite(light.indirect_energy) && std::isfinite(light.range_m) &&
           std::isfinite(light.attenuation) && std::isfinite(light.spot_angle_deg) &&
           std::isfinite(light.spot_angle_attenuation);
}

} // namespace cl
