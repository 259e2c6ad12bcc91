#pragma once

#include "servers/rasterizer.h"

#include "core/image.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace cl::embree {

/// An image that is read at points, as a GL sampler reads its largest level: colours are linearised before
/// they are mixed. There are no smaller levels: many samples a pixel are the better filter.
class Texture {
public:
    Texture(const Image& image, const TextureParams& params, TextureColorSpace space);

    /// Straight RGBA, linear. @param uv  (0, 0) is the corner of the first texel of the first row
    [[nodiscard]] glm::vec4 sample(const glm::vec2& uv) const noexcept;

private:
    [[nodiscard]] glm::vec4 texel(int x, int y) const noexcept;
    /// Column or row of a texel that may lie outside.
    [[nodiscard]] int wrap(int index, int size) const noexcept;

    glm::ivec2 size_;
    TextureParams params_;
    TextureColorSpace space_;
    std::vector<uint8_t> bytes_; ///< RGBA8, or empty
    std::vector<float> floats_;  ///< RGBA, or empty
};

} // namespace cl::embree
