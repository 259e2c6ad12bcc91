#pragma once

#include "servers/radiosity/lighting.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace cl::radiosity {

/// What surfaces that shine by themselves add to a lighting.
enum class Emission : uint8_t { None, Some };

/// A share of a lighting whose bounces are found by themselves: light adds up.
struct LightPart {
    Lighting of;               ///< its sources and sky; with a sky goes the scene's emission
    std::vector<size_t> lamps; ///< the numbers of its sources in the whole
    glm::vec3 weight{1.0f};    ///< how often it is in the whole, a channel each
};

/// At most so many lamps are parts of their own: each costs a solution when it comes or moves.
inline constexpr size_t kMostLampsApart = 16;

/// Shares that add up to a lighting: the sky with the emission, each of the first kMostLampsApart lamps with
/// radiance 1, and all others as one. What is not steady is with the others, so that any number
/// of things that move costs one solution. Depends on the lighting alone.
[[nodiscard]] std::vector<LightPart> parts_of(const Lighting& lighting, Emission emission);

} // namespace cl::radiosity
