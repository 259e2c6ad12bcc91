#include "core/math/color.h"

#include <cmath>

namespace cl {

float linear_from_srgb(float c) noexcept {
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 linear_from_srgb(const glm::vec3& c) noexcept {
    return {linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
}

float srgb_from_linear(float c) noexcept {
    return c <= 0.0031308f ? c * 12.92f : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
}

glm::vec3 srgb_from_linear(const glm::vec3& c) noexcept {
    return {srgb_from_linear(c.r), srgb_from_linear(c.g), srgb_from_linear(c.b)};
}

} // namespace cl
