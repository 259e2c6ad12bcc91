#include "drivers/gles3/gl/workarounds.h"

#include "drivers/gl_api.h"

#include <array>

namespace cl::gles3::gl {

namespace {

// Desktop names that a GLES header does not have (OpenGL 4.5 core, appendix of enumerants).
constexpr GLenum kTextureCubeMapSeamless = 0x884F, kFramebufferSrgb = 0x8DB9, kProgramPointSize = 0x8642;

bool is_desktop(const Capabilities& c) {
    return c.desktop;
}
bool is_native(const Capabilities& c) {
    return !c.browser;
}

constexpr std::array kWorkarounds{
    Workaround{"seamless cube maps",
               "ES filters across the edges of cube faces; desktop GL only when told to, and shows seams in "
               "sky light",
               is_desktop, [] { glEnable(kTextureCubeMapSeamless); }},
    Workaround{"sRGB targets encode",
               "ES encodes on writing to SRGB8_ALPHA8; desktop GL only when told to and stores linear values "
               "otherwise",
               is_desktop, [] { glEnable(kFramebufferSrgb); }},
    Workaround{"point size from the shader",
               "ES reads gl_PointSize; desktop GL only when told to and draws 1-pixel points otherwise",
               is_desktop, [] { glEnable(kProgramPointSize); }},
    Workaround{"primitive restart",
               "the browser always restarts strips and fans at the highest index, others only when told; "
               "told, all agree",
               is_native, [] { glEnable(GL_PRIMITIVE_RESTART_FIXED_INDEX); }},
};

} // namespace

std::span<const Workaround> workarounds() noexcept {
    return kWorkarounds;
}

void apply_workarounds(const Capabilities& capabilities) {
    for (const Workaround& w : kWorkarounds) {
        if (w.applies(capabilities)) {
            w.apply();
        }
    }
}

} // namespace cl::gles3::gl
