#pragma once

#include "drivers/gles3/panorama.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <vector>

// What a sky sends to surfaces: irradiance for diffuse light, radiance blurred by roughness for gloss. Both
// are dual paraboloids, twice as high as wide: z >= 0 below, z < 0 above and mirrored in v
// (shaders/lib/sky.glsl). Source: spec scene-classes section 14.4. Departs in sample counts and, for rough
// layers, in the resolution they are computed at (then enlarged): 0.15 s instead of half a minute on 2 cores,
// within two 8-bit levels.
namespace cl::gles3 {

/// Twice as high as wide; row 0 is v = 0.
struct ParaboloidMap {
    int width = 0; ///< [texels]
    std::vector<glm::vec3> texels;

    /// Bilinear, clamped at the edges. `direction` has unit length.
    [[nodiscard]] glm::vec3 sample(const glm::vec3& direction) const noexcept;
    /// The direction of a texel's centre, unit length.
    [[nodiscard]] static glm::vec3 direction_at(glm::ivec2 texel, int width) noexcept;
    [[nodiscard]] ParaboloidMap resized(int new_width) const;
};

inline constexpr int kSkyLayers = 6;        ///< roughness 0, 0.2 .. 1
inline constexpr int kIrradianceWidth = 32; ///< [texels]

/// Mean radiance over the hemisphere of each normal, weighted by the cosine. Two traits of Godot's are kept,
/// for its pictures show them: a uniform sky gives 0.988 of its radiance, and the frame around the normal is
/// not normalised, so that the hemisphere narrows towards the poles.
[[nodiscard]] ParaboloidMap filter_irradiance(const Panorama& sky);

/// The layers from smooth to rough, all of the given width. Runs on all worker threads.
[[nodiscard]] std::array<ParaboloidMap, kSkyLayers> filter_radiance(const Panorama& sky, int width);

} // namespace cl::gles3
