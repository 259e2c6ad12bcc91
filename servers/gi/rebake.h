#pragma once

#include "servers/gi/brick_bake.h"
#include "servers/gi/voxelizer.h"

#include "core/digest.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cl::gi {

/// A surface that was baked.
struct BakedSurface {
    Digest digest;  ///< of all that plotting it depends on: arrays, place and material
    TopReach reach; ///< what its triangles touch
};

/// What a bake leaves, beside its result, so that the next one plots only what changed: 100 bytes a surface
/// and 8 KiB. Empty: the next one plots all.
struct BakeMemory {
    Grid grid;
    std::vector<BakedSurface> surfaces; ///< in plot order
    std::vector<BrickRecord> bricks;    ///< by number
};

/// Makes surfaces, by their numbers in plot order; they live until revoxelize() returns.
using SurfaceSource = std::function<std::vector<PlotSurface>(std::span<const uint32_t> numbers)>;

/// What voxelize() makes of the same surfaces, to the bit; bricks in which nothing changed come out of the
/// last result. A brick depends on the surfaces that touch it and on their order, as sums in leaves round, so
/// it is plotted again, by all that touch it, where these are not the same in the same order. A surface that
/// changed in any way counts as another one.
/// @param digests       of all surfaces in plot order; equal ones plot the same
/// @param source        asked for surfaces that are new and for those that touch bricks to be plotted
/// @param memory        of the bake that made `last_result`; that of this one afterwards, untouched by errors
/// @param last_result   dynamic_data that the last bake made
/// @return what voxelize() does
[[nodiscard]] Expected<BakedOctree> revoxelize(const Grid& grid, std::span<const Digest> digests,
                                               const SurfaceSource& source, BakeMemory& memory,
                                               std::span<const int32_t> last_result,
                                               const BakeProgress& progress = {},
                                               const BakeLimits& limits = {});

} // namespace cl::gi
