#pragma once

#include "drivers/gles3/gl/program.h"
#include "drivers/gles3/passes/scene_draws.h"
#include "drivers/gles3/target_storage.h"

namespace cl::gles3 {

/// Depth of the opaque surfaces before they are shaded, so that each pixel's lighting is computed once.
class DepthPass {
public:
    /// Clears and fills the target's depth.
    Status draw(const RenderTarget& target, const SceneDraws& draws, const Resources& resources);

private:
    gl::ShaderVariants<shaders::Depth> programs_;
};

} // namespace cl::gles3
