#include "servers/shading/tone_map.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>

namespace cl::shading {

namespace {

glm::vec3 filmic_curve(const glm::vec3& x) noexcept {
    constexpr float a = 0.88f, b = 0.6f, c = 0.1f, d = 0.2f, e = 0.01f, f = 0.3f;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

glm::vec3 aces_curve(const glm::vec3& x) noexcept {
    constexpr float a = 2.51f * 0.85f * 0.85f, b = 0.03f * 0.85f, c = 2.43f * 0.85f * 0.85f,
                    d = 0.59f * 0.85f;
    constexpr float e = 0.14f;
    return x * (a * x + b) / (x * (c * x + d) + e);
}

} // namespace

glm::vec3 tone_map(const glm::vec3& radiance, ToneMapper mapper, float white) noexcept {
    glm::vec3 c = radiance;
    const glm::vec3 w(white);
    switch (mapper) {
    case ToneMapper::Linear:
        break;
    case ToneMapper::Reinhard:
        c = (white * c + c) / (c * white + white);
        break;
    case ToneMapper::Filmic:
        c = filmic_curve(c) / filmic_curve(w);
        break;
    case ToneMapper::Aces:
        c = aces_curve(c) / aces_curve(w);
        break;
    }
    return glm::clamp(c, 0.0f, 1.0f);
}

glm::vec3 adjust(const glm::vec3& encoded, const glm::vec3& brightness_contrast_saturation) noexcept {
    glm::vec3 c = encoded * brightness_contrast_saturation.x;
    c = glm::mix(glm::vec3(0.5f), c, brightness_contrast_saturation.y);
    const glm::vec3 gray(glm::dot(glm::vec3(1.0f), c) * 0.33333f);
    return glm::mix(gray, c, brightness_contrast_saturation.z);
}

uint8_t byte_from_encoded(float encoded) noexcept {
    const float half = glm::unpackHalf1x16(glm::packHalf1x16(std::clamp(encoded, 0.0f, 1.0f)));
    return static_cast<uint8_t>(std::floor(half * 255.0f));
}

} // namespace cl::shading
