#pragma once

#include "servers/rasterizer.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace cl::gles3 {

/// What keeps surfaces from shading themselves where a texel of the shadow map, which holds one depth, covers
/// many.
struct ShadowBias {
    /// Casters are drawn farther from the light: everywhere, and where a surface is parallel to the light's
    /// rays.
    glm::vec2 caster_m{0.0f};
    /// Look-ups step off the surface, along its normal, by so many texels (Holbert 2011, "Saying goodbye to
    /// shadow acne"). A plane stays lit from any side then, and walls stay tight however thin.
    float step_texels = 0.0f;
    friend bool operator==(const ShadowBias&, const ShadowBias&) = default;
};

/// Texels from tap to tap of a shadow filter. Half of Godot's where steps depend on it: edges move by as much
/// as look-ups step off, and a point's shadow is sharp.
[[nodiscard]] constexpr float shadow_tap_texels(ShadowFit fit) noexcept {
    return fit == ShadowFit::AsSet ? 1.0f : 0.5f;
}

/// @param as_set_m  what ShadowFit::AsSet uses for casters
[[nodiscard]] inline ShadowBias shadow_bias(const Frame& frame, glm::vec2 as_set_m) noexcept {
    if (frame.shadow_fit == ShadowFit::AsSet) {
        return {as_set_m, 0.0f};
    }
    // The farthest that lib/shadow.glsl mixes in: its taps 0, 1 or 2 steps away across a row or a column,
    // each filtered over 2 x 2, so that the farthest texel is one aside, too.
    const float taps = static_cast<float>(std::clamp(frame.shadow_filter, 0, 2));
    return {glm::vec2(0.0f), std::hypot(taps * shadow_tap_texels(frame.shadow_fit) + 1.0f, 1.0f)};
}

} // namespace cl::gles3
