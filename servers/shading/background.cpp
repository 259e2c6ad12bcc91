#include "servers/shading/background.h"

#include "core/math/color.h"

namespace cl::shading {

glm::vec3 background_color(const Frame& frame) noexcept {
    if (!frame.has_environment || frame.environment.background_mode == BackgroundMode::ClearColor) {
        return linear_from_srgb(frame.clear_color.rgb());
    }
    const BackgroundMode mode = frame.environment.background_mode;
    const bool is_color = mode == BackgroundMode::Color || mode == BackgroundMode::ColorSky;
    return is_color ? linear_from_srgb(frame.environment.background_color.rgb()) : glm::vec3(0.0f);
}

} // namespace cl::shading
