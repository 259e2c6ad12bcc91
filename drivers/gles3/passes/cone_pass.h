#pragma once

#include "drivers/gles3/gl/program.h"
#include "drivers/gles3/passes/scene_draws.h"
#include "drivers/gles3/target_storage.h"

namespace cl::gles3 {

/// The cones of GI probes where shaders run on the CPU anyway: a prepass writes depth and where cones start,
/// the CPU traces them by code of its own (servers/cones), and the scene pass reads the light by pixel.
class ConePass {
public:
    /// Clears and fills the target's depth, then the light of its `cones`. Waits for GL.
    /// @param frame_block  what the shaders know of the cones
    Status draw(RenderTarget& target, const Frame& frame, const shaders::FrameBlock& frame_block,
                const SceneDraws& draws, const Resources& resources);

private:
    Status draw_points(const RenderTarget& target, const SceneDraws& draws, const Resources& resources);
    gl::ShaderVariants<shaders::ConePoints> programs_;
};

} // namespace cl::gles3
