#pragma once

#include "drivers/gles3/gl/framebuffer.h"
#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/rid_kinds.h"

#include "servers/rasterizer.h"

#include "core/expected.h"
#include "core/image.h"
#include "core/rid.h"

#include <glm/vec4.hpp>

#include <optional>
#include <vector>

namespace cl::gles3 {

/// A target's surfaces as cones on the CPU start from them, and the light that these gather.
struct ConeBuffers {
    gl::Texture2D places, shapes; ///< RGBA32F: shaders/cone_points.glsl
    gl::Framebuffer points;       ///< both, with the target's depth
    gl::Texture2D light; ///< RGBA32F, twice as high: diffuse below, specular above (servers/cones/gather.h)
    std::vector<glm::vec4> place_pixels, shape_pixels,
        light_pixels; ///< as the CPU sees them, bottom row first
};

/// What a viewport is drawn into: scene radiance with depth, and the picture that tone mapping makes of it.
struct RenderTarget {
    glm::ivec2 size{0};                   ///< [pixels]
    gl::Texture2D radiance;               ///< RGBA16F, linear [W m^-2 sr^-1]; nearest, clamped
    gl::Texture2D depth;                  ///< Depth24; nearest, clamped
    gl::Framebuffer scene;                ///< radiance + depth
    gl::Framebuffer depth_only;           ///< depth alone, for the depth prepass
    std::optional<gl::Texture2D> picture; ///< RGBA8, sRGB-encoded by the shader; empty for the window
    gl::Framebuffer output;               ///< the picture, or the window's framebuffer
    std::optional<ConeBuffers> cones{};   ///< once cones are traced on the CPU
};

/// Whether the driver's textures are large enough for cones on the CPU.
[[nodiscard]] bool cone_buffers_fit(const RenderTarget& target) noexcept;
/// Makes the target's `cones` if there are none yet. @return Unsupported if memory ran out.
Status make_cone_buffers(RenderTarget& target);

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
