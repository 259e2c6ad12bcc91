#pragma once

#include "drivers/gles3/gl/program.h"
#include "drivers/gles3/passes/resources.h"
#include "drivers/gles3/shaders.h"
#include "drivers/gles3/target_storage.h"

#include "servers/rasterizer.h"

namespace cl::gles3 {

/// The sky's panorama behind what the opaque pass has drawn.
class SkyPass {
public:
    Status draw(const RenderTarget& target, const Frame& frame, const StoredSky& sky,
                const Resources& resources);

private:
    gl::ShaderVariants<shaders::Sky> programs_;
};

} // namespace cl::gles3
