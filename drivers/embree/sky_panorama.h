#pragma once

#include "servers/render_types.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace cl::embree {

/// A sky's panorama, to look up and to draw directions from: the brighter a texel, the likelier.
/// Directions have unit length, in the sky's own space (spec scene-classes section 14.2).
/// Source: PBRT 4th edition, sections 12.5.2 (ImageInfiniteLight) and A.5.6 (piecewise constant densities).
class SkyPanorama {
public:
    /// `desc` must hold three numbers a texel. What is not a finite number becomes 0.
    explicit SkyPanorama(const SkyDesc& desc);

    /// Bilinear; wraps around the horizon.
    [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction) const noexcept;
    [[nodiscard]] bool is_black() const noexcept { return !(total_ > 0.0); }

    struct Sample {
        glm::vec3 direction{0.0f};
        float pdf = 0.0f; ///< [1/sr]
    };
    /// Only if it is not black.
    [[nodiscard]] Sample sample(const glm::vec2& u) const noexcept;
    [[nodiscard]] float pdf(const glm::vec3& direction) const noexcept; ///< [1/sr]

private:
    [[nodiscard]] const glm::vec3& texel(int x, int y) const noexcept;
    /// What a texel is chosen by: mean luminance of what radiance() gives in it, times the solid angle of its
    /// row.
    [[nodiscard]] float weight_of(int x, int y) const noexcept;
    /// Density [1/sr] at a height in the panorama, v in [0, 1].
    [[nodiscard]] float pdf_of_texel(int x, int y, float v) const noexcept;

    glm::ivec2 size_;
    std::vector<glm::vec3> texels_;
    std::vector<float> weights_;
    std::vector<float> columns_; ///< of each row: sums of the weights up to and with each column
    std::vector<double> rows_;   ///< sums of the rows up to and with each
    double total_ = 0.0;
};

} // namespace cl::embree
