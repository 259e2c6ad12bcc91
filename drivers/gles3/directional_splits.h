#pragma once

#include "drivers/gles3/shadow_bias.h"

#include "servers/rasterizer.h"

#include "core/math/transform.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace cl::gles3 {

inline constexpr int kMaxSplits = 4;

/// One part of a directional light's shadow map: what it covers and how it is projected.
struct DirectionalSplit {
    float begin_m = 0.0f, end_m = 0.0f; ///< view depths
    glm::vec3 low_m{0.0f},
        high_m{0.0f}; ///< box in light space: x, y as the map spans them, z = depths 1 and 0
    glm::vec2 tile{0.0f}, tile_size{1.0f}; ///< its part of the light's area, 0..1
    ShadowBias bias;
    friend bool operator==(const DirectionalSplit&, const DirectionalSplit&) = default;
};

struct DirectionalShadow {
    Transform light_from_world; ///< rotation: the light shines along -z
    int count = 0;              ///< of splits; 0: no shadow
    std::array<DirectionalSplit, kMaxSplits> splits{};
    float fade_begin_m = 0.0f, fade_end_m = 0.0f; ///< view depths between which the shadow fades out

    /// GL clip coordinates of split `i` from light space.
    [[nodiscard]] glm::mat4 clip_from_light(int i) const noexcept;
    friend bool operator==(const DirectionalShadow&, const DirectionalShadow&) = default;
};

/// The visible part of the world between two view depths: near corners, then far ones, in view space [m].
[[nodiscard]] std::array<glm::vec3, 8> view_corners(const CameraDesc& camera, glm::ivec2 frame_size,
                                                    float begin_m, float end_m) noexcept;

/// Splits the camera's shadow range and fits a box of light space to each part (spec scene-classes section
/// 9). Stable depth range: a sphere around the part, moved in whole texels only, so that shadow edges do not
/// crawl when the camera moves; optimized: the part's own bounds.
/// @param frame        its camera, size, casters and settings; casters nearer to the light are not cut off
/// @param area_texels  size of the light's area of the shadow map
[[nodiscard]] DirectionalShadow fit_directional_shadow(const LightItem& light, const Frame& frame,
                                                       glm::ivec2 area_texels) noexcept;

/// Part `index` of a shadow map that `count` lights share: halves for 2, quarters for up to 4, and so on.
/// @return position and size, 0..1
struct MapArea {
    glm::vec2 position{0.0f}, size{1.0f};
};
[[nodiscard]] MapArea directional_area(int index, int count) noexcept;

} // namespace cl::gles3
