#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace cl::gles3 {

/// An equirectangular picture of linear radiance with box-filtered mips, to be sampled on the CPU.
/// Directions are in the sky maps' space (shaders/lib/sky.glsl): u = atan2(x, z) / 2 pi, v = acos(y) / pi.
class Panorama {
public:
    /// @param radiance  size.x * size.y texels, row 0 at the zenith, finite; size at least 1x1
    Panorama(glm::ivec2 size, std::vector<glm::vec3> radiance);

    [[nodiscard]] glm::ivec2 size() const noexcept { return levels_.front().size; }
    [[nodiscard]] std::span<const glm::vec3> texels() const noexcept { return levels_.front().texels; }
    [[nodiscard]] int level_count() const noexcept { return static_cast<int>(levels_.size()); }
    /// Bilinear within a level (u repeats, v does not), linear between levels. `direction.y` is used as it
    /// is, also where it is not of unit length (see irradiance in sky_filter.h).
    [[nodiscard]] glm::vec3 sample(const glm::vec3& direction, float lod) const noexcept;

private:
    struct Level {
        glm::ivec2 size{0};
        std::vector<glm::vec3> texels;
    };
    [[nodiscard]] static glm::vec3 sample_level(const Level& level, const glm::vec2& uv) noexcept;
    std::vector<Level> levels_;
};

} // namespace cl::gles3
