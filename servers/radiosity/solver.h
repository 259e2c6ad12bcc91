#pragma once

#include "servers/radiosity/light_memory.h"
#include "servers/radiosity/lighting.h"
#include "servers/radiosity/rgb4.h"
#include "servers/radiosity/transport.h"

#include <glm/vec3.hpp>

#include <atomic>
#include <vector>

namespace cl::radiosity {

/// Light that arrives, as radiance averaged over the cosine-weighted hemisphere (irradiance / pi), linear:
/// times albedo it is what a surface sends out.
struct Solution {
    std::vector<glm::vec3> arriving; ///< one a patch, without light straight from sources
    std::vector<Rgb4> leaving;       ///< one a patch: emission and all light it sends on
    int bounces = 0;
};

/// Lights the patches and lets the light bounce until less than a thousandth is missing.
/// The same numbers for any number of threads. @param stop  gives up early with an unusable result
/// @param memory  of this transport; null: none
[[nodiscard]] Solution solve(const Transport& transport, const Lighting& lighting,
                             const std::atomic<bool>& stop, LightMemory* memory = nullptr);

} // namespace cl::radiosity
