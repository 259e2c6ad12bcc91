#pragma once

#include "drivers/gles3/gl/draw_state.h"
#include "drivers/gles3/shaders.h"

#include "servers/rasterizer.h"

#include <glm/mat4x4.hpp>

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace cl::gles3 {

/// An omni or spot light's place in the shadow atlas.
struct PlacedLocalShadow {
    gl::Rect rect;
    int atlas_size = 1;       ///< [texels]
    float step_texels = 0.0f; ///< of ShadowBias
    ShadowFit fit = ShadowFit::AsSet;
};

/// Casters nearer than this to an omni or spot cast no shadow [m]. ShadowFit::ByTexel: a part of its range,
/// so that a scene looks the same at any scale; at the end of the range a step of a 24-bit depth is a tenth
/// of a texel of a large map.
[[nodiscard]] constexpr float local_shadow_near_m(ShadowFit fit, float range_m) noexcept {
    return fit == ShadowFit::AsSet ? 0.01f : range_m / 4096.0f;
}

/// View volume of a spot's shadow map: clip from light space (spec scene-classes section 9). 90 degrees and
/// more cast no shadow.
[[nodiscard]] glm::mat4 spot_clip_from_light(const LightDesc& light, ShadowFit fit) noexcept;

/// The light of one omni or spot for shading in view space. @param shadow  nullopt: casts none
[[nodiscard]] shaders::LocalLight make_local_light(const LightItem& light, const Transform& world_from_view,
                                                   const std::optional<PlacedLocalShadow>& shadow) noexcept;

/// One copy of the LightSet block for every different choice of lights among the draws.
class LightSets {
public:
    /// @param lights  made by make_local_light, by the frame's light index; those of directional lights are
    /// unused
    explicit LightSets(std::span<const shaders::LocalLight> lights) : lights_(lights) {}

    /// Index of the set with the item's lights.
    int set_of(const DrawItem& item);
    [[nodiscard]] const std::vector<shaders::LightSetBlock>& blocks() const noexcept { return blocks_; }

private:
    std::span<const shaders::LocalLight> lights_;
    std::map<std::vector<uint16_t>, int> known_; ///< omnis, then 0xFFFF, then spots
    std::vector<shaders::LightSetBlock> blocks_;
};

} // namespace cl::gles3
