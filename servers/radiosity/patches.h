#pragma once

#include "servers/radiosity/cell_index.h"
#include "servers/radiosity/ray_scene.h"
#include "servers/radiosity/still_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

inline constexpr uint32_t kNoPatch = 0xFFFFFFFFu;

/// The surfaces of a still scene in pieces of at most a cell: the elements of the radiosity method. One patch
/// is what lies in one cell, faces one way and is one space with itself: a wall thinner than a cell has a
/// patch on either side, and a floor that it stands on has two in that cell.
struct Patches {
    struct Grid {
        CellGrid cells;
        CellIndex index;
        std::vector<uint32_t> first; ///< first patch of each occupied cell, and one past the last
        /// What a search reads of an occupied cell. Most hold one patch, and there it needs no more: searches
        /// jump about, and each further word of memory would cost them a cache miss.
        struct Sought {
            uint32_t first;  ///< patch
            uint32_t normal; ///< of the only patch, as packSnorm3x10_1x2 with w = 1; 0: there are several
        };
        std::vector<Sought> sought;
    };
    std::vector<Grid> grids; ///< finest first

    std::vector<glm::vec3> position;         ///< a point of the surface that sees the space before it [m]
    std::vector<glm::vec3> normal;           ///< unit length
    std::vector<glm::vec3> albedo, emission; ///< linear, mean over the patch
    std::vector<float> area_m2;
    std::vector<float> openness_m; ///< median of the distances to what is before it [m]
    std::vector<uint8_t> grid;     ///< its grid
    std::vector<uint64_t> order;   ///< its cell's CellGrid::order()

    [[nodiscard]] size_t size() const noexcept { return position.size(); }
    /// The patch that a point of a surface belongs to; kNoPatch if there is none.
    /// @param normal  the surface's, on the side that is meant
    [[nodiscard]] uint32_t find(const glm::vec3& point, const glm::vec3& normal) const noexcept;
    struct SurfacePoint {
        glm::vec3 position, facing; ///< [m], and unit length
    };
    /// The same of many points, if other surfaces share the cell only a patch in sight of the point: one that
    /// stands in a neighbouring cell where the cell's own are all on the other side of a wall.
    /// found.size() == points.size()
    void find_seen(const RayScene& rays, std::span<const SurfacePoint> points,
                   std::span<uint32_t> found) const noexcept;
};

/// Cuts a scene into patches. A surface inside a solid (rays from it meet back sides) gets none.
/// @param grids  the probes' (`probe_count` of them, each cut in full), then outer ones that hold only what
/// no grid
///               before them does. Points outside all get no patch.
[[nodiscard]] Patches make_patches(const StillScene& scene, const RayScene& rays,
                                   std::span<const CellGrid> grids, size_t probe_count);

/// How far a cell's own point stands in front of its surface when rays start there [cells].
inline constexpr float kLift = 0.02f;

} // namespace cl::radiosity
