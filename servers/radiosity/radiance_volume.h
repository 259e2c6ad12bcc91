#pragma once

#include "servers/radiosity/solver.h"
#include "servers/radiosity/transport.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace cl::radiosity {

/// What cones march through for glossy reflections: the light that leaves the surfaces of a probe's cells.
struct RadianceVolume {
    struct Level {
        glm::ivec3 size{0};
        /// x fastest, then y, then z. a: opacity; rgb: a * square root of (radiance / range), so that what a
        /// sampler mixes with empty texels is (rgb / a)^2 still. The root keeps the dark in 8 bits.
        std::vector<uint8_t> rgba8;
    };
    std::vector<Level> levels; ///< edges are powers of two, down to 1 x 1 x 1
    float range = 1.0f;        ///< brightest radiance there is
};

/// Edges of the volume of a grid: the powers of two that hold it.
[[nodiscard]] glm::ivec3 radiance_volume_size(const CellGrid& grid) noexcept;

/// Coarse texels stay opaque where a wall crosses them: opacity is twice the mean of the eight finer ones, at
/// most 1, as a plane fills half of them.
[[nodiscard]] RadianceVolume make_radiance_volume(const Transport& transport, size_t probe,
                                                  const Solution& solution);

} // namespace cl::radiosity
