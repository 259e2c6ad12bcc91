#pragma once

#include "core/image.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace cl::radiosity {

/// A texture as light transport needs it: linear rgb and alpha, box-filtered mips, at most 256 texels an edge
/// (a finer one is of no use to patches of a few centimetres). Repeats.
class ColorMap {
public:
    /// 8-bit texels are decoded from sRGB, floats are taken as linear. An empty image gives white.
    explicit ColorMap(const Image& image);
    /// @param footprint  edge of the area to average over, in UVs. Nearest texel of the nearest mip.
    [[nodiscard]] glm::vec4 sample(glm::vec2 uv, float footprint) const noexcept;

private:
    struct Level {
        glm::ivec2 size{0};
        std::vector<glm::vec4> texels;
    };
    std::vector<Level> levels_; ///< never empty; the last is 1 x 1
};

} // namespace cl::radiosity
