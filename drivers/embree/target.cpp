#include "drivers/embree/target.h"

#include "servers/shading/tone_map.h"

#include "core/math/color.h"

#include <glm/common.hpp>

#include <cstring>

namespace cl::embree {

Image radiance_image(const Target& target) {
    Image image{target.size, PixelFormat::RGBF,
                std::vector<uint8_t>(target.radiance.size() * sizeof(glm::vec3))};
    std::memcpy(image.data.data(), target.radiance.data(), image.data.size());
    return image;
}

Image shown_image(const Target& target) {
    const EnvironmentDesc& e = target.tone;
    const glm::vec3 adjustments(e.brightness, e.contrast, e.saturation);
    Image image{target.size, PixelFormat::RGBA8, {}};
    image.data.reserve(target.radiance.size() * 4);
    for (const glm::vec3& radiance : target.radiance) {
        glm::vec3 encoded =
            srgb_from_linear(shading::tone_map(radiance * e.exposure, e.tone_mapper, e.white));
        if (e.adjustment_enabled) {
            encoded = glm::clamp(shading::adjust(encoded, adjustments), 0.0f, 1.0f);
        }
        for (int channel = 0; channel < 3; ++channel) {
            image.data.push_back(shading::byte_from_encoded(encoded[channel]));
        }
        image.data.push_back(255);
    }
    return image;
}

} // namespace cl::embree
