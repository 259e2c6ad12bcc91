#pragma once

#include "servers/radiosity/patches.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace cl::radiosity {

/// Steps an axis of a cell in which places are told to the shader.
inline constexpr int kPlaceSteps = 8;

/// How a pixel tells which of two patches of one cell and facing is its own.
enum class SlotTest : uint8_t {
    Place, ///< the nearer one; layers of surface differ along the normal
    Normal ///< the one that faces more as it does
};
struct SlotPlaces {
    SlotTest test = SlotTest::Place;
    /// Of each patch, 0..1: its place in the cell, or 0.5 + 0.5 * its normal in the grid's axes.
    std::array<glm::vec3, 2> at{};
};

/// Tells two patches of a cell apart. By their normals, if these differ: a joint of two walls. Else by their
/// positions, unless a wall stands between them on one surface: then by places such that a point is nearer to
/// the patch on its side of the wall.
[[nodiscard]] SlotPlaces slot_places(const RayScene& rays, const StillScene& scene, const Patches& patches,
                                     uint32_t a, uint32_t b);

/// A patch's position in its cell, 0..1.
[[nodiscard]] glm::vec3 place_in_cell(const Patches& patches, uint32_t patch) noexcept;

} // namespace cl::radiosity
