#pragma once

#include "drivers/gl_context.h"
#include "drivers/gles3/rasterizer_gles3.h"

#include "servers/rasterizer_checked.h"
#include "servers/visual_server.h"

#include <memory>
#include <utility>

namespace cl::demo {

/// A server that draws with GLES 3 where nobody sees it. Unsupported if there is no GL.
inline Expected<std::unique_ptr<VisualServer>> make_offscreen_server() {
    Expected<std::unique_ptr<drivers::GLContext>> context = drivers::create_offscreen_context();
    if (!context) {
        return context.error();
    }
    Expected<std::unique_ptr<gles3::RasterizerGLES3>> rasterizer =
        gles3::RasterizerGLES3::create(std::move(*context));
    if (!rasterizer) {
        return rasterizer.error();
    }
    return std::make_unique<VisualServer>(std::make_unique<RasterizerChecked>(std::move(*rasterizer)));
}

} // namespace cl::demo
