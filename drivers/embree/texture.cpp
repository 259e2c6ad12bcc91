#include "drivers/embree/texture.h"

#include "core/math/color.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace cl::embree {

namespace {

/// Linear value of each sRGB byte.
const std::array<float, 256>& linear_of_byte() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (size_t i = 0; i < t.size(); ++i) {
            t[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
        }
        return t;
    }();
    return table;
}

} // namespace

Texture::Texture(const Image& image, const TextureParams& params, TextureColorSpace space)
    : size_(image.size), params_(params), space_(space) {
    if (is_float_format(image.format)) {
        const Image rgba = image.converted_to(PixelFormat::RGBAF);
        floats_.assign(rgba.floats().begin(), rgba.floats().end());
        // One bad texel must not spread over the picture.
        std::replace_if(
            floats_.begin(), floats_.end(), [](float v) { return !std::isfinite(v); }, 0.0f);
    } else {
        bytes_ = image.converted_to(PixelFormat::RGBA8).data;
    }
}

int Texture::wrap(int index, int size) const noexcept {
    if (params_.mirrored_repeat) {
        const int period = 2 * size;
        const int at = ((index % period) + period) % period;
        return at < size ? at : period - 1 - at;
    }
    return params_.repeat ? ((index % size) + size) % size : std::clamp(index, 0, size - 1);
}

glm::vec4 Texture::texel(int x, int y) const noexcept {
    const size_t at = (static_cast<size_t>(wrap(y, size_.y)) * static_cast<size_t>(size_.x) +
                       static_cast<size_t>(wrap(x, size_.x))) *
                      4;
    if (!floats_.empty()) {
        return {floats_[at], floats_[at + 1], floats_[at + 2], floats_[at + 3]};
    }
    const float alpha = static_cast<float>(bytes_[at + 3]) / 255.0f;
    if (space_ == TextureColorSpace::Srgb) {
        const std::array<float, 256>& linear = linear_of_byte();
        return {linear[bytes_[at]], linear[bytes_[at + 1]], linear[bytes_[at + 2]], alpha};
    }
    return {glm::vec3(bytes_[at], bytes_[at + 1], bytes_[at + 2]) / 255.0f, alpha};
}

glm::vec4 Texture::sample(const glm::vec2& uv) const noexcept {
    constexpr float kFarthest = 1e6f; // [texels]: what is beyond has no digits left for a place in the image
    const glm::vec2 at = uv * glm::vec2(size_);
    if (!(std::abs(at.x) < kFarthest) || !(std::abs(at.y) < kFarthest)) {
        return texel(0, 0);
    }
    if (!params_.filter) {
        const glm::vec2 corner = glm::floor(at);
        return texel(static_cast<int>(corner.x), static_cast<int>(corner.y));
    }
    const glm::vec2 corner = glm::floor(at - 0.5f);
    const glm::vec2 f = at - 0.5f - corner;
    const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), f.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), f.x), f.y);
}

} // namespace cl::embree
