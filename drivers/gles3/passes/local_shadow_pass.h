#pragma once

#include "drivers/gles3/gl/framebuffer.h"
#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/light_sets.h"
#include "drivers/gles3/passes/caster_draw.h"
#include "drivers/gles3/passes/omni_paraboloids.h"
#include "drivers/gles3/shadow_atlas.h"
#include "drivers/gles3/shadow_bias.h"

#include <map>
#include <optional>
#include <vector>

namespace cl::gles3 {

/// The shadow maps of omni and spot lights, in one atlas. A map is kept while its light, its casters and its
/// place stay as they are (spec scene-classes section 9).
class LocalShadowPass {
public:
    /// Brings the maps of the frame's lights up to date.
    /// @return their places by light index; empty for lights that cast none or found no slot.
    Expected<std::vector<std::optional<PlacedLocalShadow>>>
    draw(const Frame& frame, const Resources& resources, CasterDraw& casters);
    /// Depth with hardware compare; nullptr before any light needed it.
    [[nodiscard]] const gl::Texture2D* atlas() const noexcept { return atlas_ ? &atlas_->texture : nullptr; }

private:
    struct Atlas {
        gl::Texture2D texture;
        gl::Framebuffer framebuffer;
        ShadowAtlas slots;
    };
    /// All that a map's texels depend on.
    struct Drawn {
        gl::Rect rect;
        ShadowBias bias;
        Transform world_from_light;
        uint64_t casters_version = 0;
        float range_m = 0.0f, spot_angle_deg = 0.0f;
        bool reverse_cull = false;
        LightType type = LightType::Omni;
        ShadowFit fit = ShadowFit::AsSet;
        friend bool operator==(const Drawn&, const Drawn&) = default;
    };
    Status prepare_atlas(int size);
    Status draw_spot(const LightItem& light, const Drawn& now, const Resources& resources,
                     CasterDraw& casters);
    Status draw_faces(const LightItem& light, const Drawn& now, const Resources& resources,
                      CasterDraw& casters);
    Status draw_light(const LightItem& light, const Drawn& now, const Resources& resources,
                      CasterDraw& casters);

    std::optional<Atlas> atlas_;
    std::map<RID, Drawn> drawn_;
    OmniParaboloids paraboloids_;
};

/// How large a light's reach looks: its radius over the mean of the picture's half width and half height
/// there, at most 1. Fitted to the sizes of real Godot's maps in pictures of one omni and one spot from 3 to
/// 22 m away.
[[nodiscard]] float light_coverage(const LightItem& light, const CameraDesc& camera,
                                   glm::ivec2 frame_size) noexcept;

} // namespace cl::gles3
