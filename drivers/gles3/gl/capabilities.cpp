#include "drivers/gles3/gl/capabilities.h"

#include "drivers/gl_api.h"

#include <algorithm>
#include <string_view>

namespace cl::gles3::gl {

namespace {

int get_int(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

/// Mesa's rasterisers and the browsers', by what they call themselves.
bool runs_on_cpu() {
    const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string_view renderer = text ? text : "";
    return renderer.find("llvmpipe") != renderer.npos || renderer.find("softpipe") != renderer.npos ||
           renderer.find("SwiftShader") != renderer.npos;
}

} // namespace

Capabilities Capabilities::query() {
    Capabilities c;
#ifdef __EMSCRIPTEN__
    c.browser = true;
#endif
    const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    c.desktop = version && !std::string_view(version).starts_with("OpenGL ES");
    // Desktop 3.0 has these two in core; its extension lists need not repeat them.
    c.color_buffer_float = c.desktop || GLAD_GL_EXT_color_buffer_float;
    c.float_linear = c.desktop || GLAD_GL_OES_texture_float_linear;
    c.software = runs_on_cpu();
    c.debug_labels = GLAD_GL_KHR_debug && glObjectLabelKHR && glPushDebugGroupKHR && glPopDebugGroupKHR;
    if (GLAD_GL_EXT_texture_filter_anisotropic) {
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &c.max_anisotropy);
    }
    c.max_texture_size = get_int(GL_MAX_TEXTURE_SIZE);
    c.max_texture_3d_size = get_int(GL_MAX_3D_TEXTURE_SIZE);
    c.max_cube_size = get_int(GL_MAX_CUBE_MAP_TEXTURE_SIZE);
    c.uniform_offset_alignment = std::max(16, get_int(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT));
    return c;
}

} // namespace cl::gles3::gl
