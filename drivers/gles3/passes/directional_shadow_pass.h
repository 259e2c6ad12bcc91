#pragma once

#include "drivers/gles3/frame_block.h"
#include "drivers/gles3/gl/framebuffer.h"
#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/passes/caster_draw.h"

#include <optional>
#include <vector>

namespace cl::gles3 {

/// The shadow maps of directional lights: one texture, shared in equal areas, each cut in 1, 2 or 4 splits.
/// An area is drawn again only when its splits or its casters changed.
class DirectionalShadowPass {
public:
    /// @return one entry per directional light of the frame; count 0 where a light casts no shadow.
    Expected<std::vector<PlacedDirectionalShadow>> draw(const Frame& frame, const Resources& resources,
                                                        CasterDraw& casters);
    /// Depth with hardware compare; nullptr before any light needed it.
    [[nodiscard]] const gl::Texture2D* map() const noexcept { return map_ ? &map_->texture : nullptr; }

private:
    struct Map {
        gl::Texture2D texture;
        gl::Framebuffer framebuffer;
    };
    /// All that an area's texels depend on.
    struct Drawn {
        RID light;
        gl::Rect area;
        DirectionalShadow shadow;
        uint64_t casters_version = 0;
        bool reverse_cull = false;
        friend bool operator==(const Drawn&, const Drawn&) = default;
    };
    Status prepare_map(int size);
    Status draw_light(const LightItem& light, const Drawn& now, const Resources& resources,
                      CasterDraw& casters);

    std::optional<Map> map_;
    std::vector<Drawn> drawn_;
};

} // namespace cl::gles3
