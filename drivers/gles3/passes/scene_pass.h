#pragma once

#include "drivers/gles3/frame_block.h"
#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/gl/program.h"
#include "drivers/gles3/material_variant.h"
#include "drivers/gles3/passes/scene_draws.h"
#include "drivers/gles3/target_storage.h"

namespace cl::gles3 {

/// Forward shading: each surface once, with all its lights. Radiance goes to the target's linear buffer.
class ScenePass {
public:
    /// A depth texture with one texel, for frames without shadows: every sampler of a draw must have a
    /// texture.
    [[nodiscard]] static Expected<ScenePass> create();

    /// What a frame's surfaces share.
    struct Inputs {
        const Frame& frame;
        FrameFeatures features;
        const SceneDraws& draws;
        const Resources& resources;
        const gl::Texture2D* shadow_atlas = nullptr;       ///< nullptr: no omni or spot casts shadows
        const gl::Texture2D* directional_shadow = nullptr; ///< nullptr: no directional light does
        const StoredSky* sky = nullptr;                    ///< nullptr: light comes from no sky
    };
    /// Draws over a cleared background. With a prepass the target's depth is kept and only equal depth
    /// shaded.
    Status draw_opaque(const RenderTarget& target, const Inputs& inputs, Prepass prepass, FrameStats& stats);
    /// Draws the sorted surfaces over what is there.
    Status draw_transparent(const RenderTarget& target, const Inputs& inputs, FrameStats& stats);
    [[nodiscard]] size_t variant_count() const noexcept { return programs_.size(); }

private:
    explicit ScenePass(gl::Texture2D no_shadow) : no_shadow_(std::move(no_shadow)) {}
    void bind_frame_inputs(const Inputs& inputs) const;
    Status draw_surface(gl::Pass& pass, const SceneDraw& draw, const Inputs& inputs, uint32_t variant,
                        const gl::DrawState& state, FrameStats& stats);
    gl::ShaderVariants<shaders::Scene> programs_;
    gl::Texture2D no_shadow_;
};

} // namespace cl::gles3
