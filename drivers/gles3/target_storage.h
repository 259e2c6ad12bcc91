#pragma once

#include "drivers/gles3/gl/framebuffer.h"
#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/rid_kinds.h"

#include "servers/rasterizer.h"

#include "core/expected.h"
#include "core/image.h"
#include "core/rid.h"

#include <optional>

namespace cl::gles3 {

/// What a viewport is drawn into: scene radiance with depth, and the picture that tone mapping makes of it.
struct RenderTarget {
    glm::ivec2 size{0};                   ///< [pixels]
    gl::Texture2D radiance;               ///< RGBA16F, linear [W m^-2 sr^-1]; nearest, clamped
    gl::Texture2D depth;                  ///< Depth24; nearest, clamped
    gl::Framebuffer scene;                ///< radiance + depth
    gl::Framebuffer depth_only;           ///< depth alone, for the depth prepass
    std::optional<gl::Texture2D> picture; ///< RGBA8, sRGB-encoded by the shader; empty for the window
    gl::Framebuffer output;               ///< the picture, or the window's framebuffer
};

class TargetStorage {
public:
    /// @return Unsupported if the size is below 1 or beyond the driver's limit.
    [[nodiscard]] Expected<RID> create(glm::ivec2 size);
    /// nullptr if stale.
    [[nodiscard]] RenderTarget* get(RID rid) noexcept { return targets_.get(rid); }
    /// The target that ends in the window; remade when `size` is not what it was.
    [[nodiscard]] Expected<RenderTarget*> window(glm::ivec2 size);
    bool free(RID rid) { return targets_.free(rid); }

    /// The pixels, top row first: Srgb8 as RGBA8 of the output, LinearFloat as RGBF of the radiance.
    /// RID 0 reads the window's target.
    /// @return InvalidArgument if stale or if there is no window.
    [[nodiscard]] Expected<Image> read(RID rid, TargetFormat format);

private:
    RID_Owner<RenderTarget> targets_{static_cast<uint32_t>(RIDKind::Target)};
    std::optional<RenderTarget> window_;
};

} // namespace cl::gles3
