#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cl::gi {

/// A radiance volume with its mips as a GPU would sample it: RGBA8, linear between texels and levels, clamped
/// to the edge. Levels may be of any size; level 0 is the finest.
class VolumeSampler {
public:
    struct Level {
        glm::ivec3 size{0};
        std::span<const uint8_t> rgba8; ///< borrowed; x fastest, then y, then z
    };
    explicit VolumeSampler(std::vector<Level> levels);

    /// @param position  0..1 across the volume
    /// @param lod       clamped to the levels there are
    [[nodiscard]] glm::vec4 sample(const glm::vec3& position, float lod) const noexcept;
    [[nodiscard]] glm::ivec3 size() const noexcept { return levels_.front().size; }

private:
    [[nodiscard]] glm::vec4 sample_level(const Level& level, const glm::vec3& position) const noexcept;
    std::vector<Level> levels_;
};

/// Width of a cone at a distance [voxels]: never below one voxel, where the volume holds no more detail.
[[nodiscard]] float cone_diameter(float distance, float tan_half_aperture) noexcept;

struct Cone {
    glm::vec3 origin{0.0f};    ///< [voxels of level 0]
    glm::vec3 direction{0.0f}; ///< unit length in voxels
    float tan_half_aperture = 1.0f;
    float first_distance = 0.0f; ///< [voxels]
    float max_distance = 0.0f;   ///< [voxels]
};

/// Gathers along a cone: rgb, and in a the opacity met. CPU twin of shaders/lib/cone_trace.glsl, equal to it
/// but for the hardware's filter precision (8 fraction bits). Source: spec gi-shading section 4.1.
[[nodiscard]] glm::vec4 trace_cone(const VolumeSampler& volume, const Cone& cone) noexcept;

} // namespace cl::gi
