#pragma once

#include "servers/gi/octree_writer.h"
#include "servers/gi/top_cells.h"

#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

namespace cl::gi {

/// A brick in a bake's result.
struct BrickRecord {
    uint32_t first_cell = 0; ///< its cells stand in a row
    uint32_t cell_count = 0; ///< 0: there is no brick
    uint32_t leaf_count = 0;
    float alpha = 0.0f; ///< before it was quantised
};

struct BakedBricks {
    BakedOctree octree;
    std::vector<BrickRecord> bricks; ///< kBakeBricks, by number
};

/// What a bake need not plot again: an earlier one's result.
struct KeptBricks {
    TopReach plotted;                      ///< bricks that are made anew all the same
    std::span<const BrickRecord> bricks;   ///< by number
    std::span<const int32_t> dynamic_data; ///< which they are in
};

/// Builds bricks on all workers and joins them below the cells above.
class BrickBake {
public:
    BrickBake(const Grid& grid, const BakeLimits& limits, const BakeProgress& progress);

    /// @param kept  null: all bricks are plotted
    /// @return Cancelled if the progress said so; OutOfMemory beyond the limits.
    Expected<BakedBricks> run(std::span<const PlotSurface> surfaces, const PlotTriangles& triangles,
                              const TopCells& top, const KeptBricks* kept = nullptr);

private:
    struct Brick {
        std::vector<Cell> cells;       ///< plotted; child indices count from the brick's root
        std::span<const int32_t> kept; ///< or cells of an earlier bake, as they are there
        BrickRecord record;
    };

    void build_brick(size_t number, std::span<const PlotSurface> surfaces, const PlotTriangles& triangles);
    void report_brick();
    Expected<BakedBricks> assemble();
    float append_top(size_t number, OctreeWriter& writer);
    float append_brick(size_t number, OctreeWriter& writer);

    const Grid& grid_;
    const BakeProgress& progress_;
    BakeControl control_;
    const TopCells* top_ = nullptr;
    std::vector<Brick> bricks_; ///< as TopCells::bricks()
    std::vector<size_t> todo_;  ///< those that are plotted
    std::mutex progress_mutex_;
    size_t bricks_done_ = 0;
    bool cancelled_ = false;
};

/// Runs what bakes: tells the progress that it begins, and turns a lack of memory into an error.
[[nodiscard]] Expected<BakedOctree> run_bake(const BakeProgress& progress,
                                             const std::function<Expected<BakedOctree>()>& bake);

} // namespace cl::gi
