#pragma once

#include "servers/cones/volume.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <span>

namespace cl::cones {

/// Cones of all surfaces (spec gi-shading section 4).
struct ConeSettings {
    std::span<const glm::vec4> cones; ///< xyz: direction in (tangent, binormal, normal), w: weight; at most 6
    float tan_half_aperture = 1.0f;   ///< of the diffuse ones
    float reach = 1.0f;               ///< part of a probe's reach that they go
    float specular_least_tan = 0.0f;
};

/// One GI probe as it lights some surfaces; units as in spec gi-shading section 2.
struct ConeProbe {
    const Volume* volume = nullptr; ///< nullptr: it lights nothing
    glm::mat4 cells_from_view{1.0f};
    glm::vec3 bounds{0.0f};        ///< of the box [cells]
    glm::vec3 uv_from_cells{0.0f}; ///< 1 / size of the volume
    float multiplier = 0.0f;       ///< radiance from the volume's values
    float bias = 0.0f;             ///< [cells]
    float normal_bias = 0.0f;      ///< [m]
    float reach = 0.0f;            ///< the box's diagonal [cells]; at most some thousand
    bool blend_ambient = false;    ///< what is beyond the volume enters where cones leave it
};

/// The probes of some surfaces.
struct ConeSet {
    std::array<ConeProbe, 2> probes;
};

/// A picture's surfaces, and the light they gather.
struct ConePicture {
    glm::ivec2 size{0};
    std::span<const glm::vec4>
        places; ///< xyz: view space [m]; w: 1 + number of the set, 0 where there is none
    std::span<const glm::vec4> shapes; ///< xyz: shading normal, view space; w: roughness
    /// rgb: radiance; a: share of what is beyond the volumes (ambient light, environment), to be added by the
    /// caller. Written where there is a set, all else stays.
    std::span<glm::vec4> diffuse, specular;
};

/// Whether this processor can: it needs AVX2.
[[nodiscard]] bool can_gather() noexcept;

/// What the fragments' cones gather (shaders/lib/gi_probe.glsl, its twin), on all workers. For rasterisers
/// whose shaders run on the CPU too: it filters the same texels to the same 8 bits in half the time, as one
/// load brings two neighbours with all channels, two levels are filtered side by side, cones of one aperture
/// share their distances and each ends by itself.
void gather_cones(const ConeSettings& settings, std::span<const ConeSet> sets, const ConePicture& picture);

} // namespace cl::cones
