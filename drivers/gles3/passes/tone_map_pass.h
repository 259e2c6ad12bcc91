#pragma once

#include "drivers/gles3/gl/program.h"
#include "drivers/gles3/passes/resources.h"
#include "drivers/gles3/shaders.h"
#include "drivers/gles3/target_storage.h"

#include "servers/rasterizer.h"

namespace cl::gles3 {

/// Radiance to picture: exposure, tone mapper, sRGB, adjustments (spec scene-classes sections 14.9 to 14.11).
class ToneMapPass {
public:
    Status draw(const RenderTarget& target, const Frame& frame, const Resources& resources);

private:
    gl::ShaderVariants<shaders::ToneMap> programs_;
};

} // namespace cl::gles3
