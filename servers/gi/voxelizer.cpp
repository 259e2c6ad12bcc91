#include "servers/gi/voxelizer.h"

#include "servers/gi/cell_words.h"
#include "servers/gi/octree_builder.h"
#include "servers/gi/plot_triangle.h"
#include "servers/gi/triangle_box.h"

#include "core/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <numeric>

namespace cl::gi {

namespace {

/// Cells up to this level are made here, one by one; each child below is a brick, built on its own by any
/// worker. Fixed, so that the result does not know how many workers there were.
constexpr int kBrickParentLevel = kBakeBrickLevel - 1;

/// A cell above the bricks.
struct TopCell {
    CellBox box;
    uint32_t number;                ///< slots from the root, three bits a level
    std::vector<uint32_t> touching; ///< broad triangles, ascending; emptied once the children have theirs
    std::vector<uint8_t> masks;     ///< octants that each of them touches
    int64_t children[8] = {-1, -1, -1, -1, -1, -1, -1, -1}; ///< top cells, or bricks below kBrickParentLevel
};

struct Brick {
    size_t parent = 0;
    int slot = 0;
    std::vector<Cell> cells;
    uint32_t leaf_count = 0;
    float alpha = 0.0f;
};

std::vector<uint32_t> touching_octant(const TopCell& parent, int slot) {
    std::vector<uint32_t> ids;
    for (size_t i = 0; i < parent.touching.size(); ++i) {
        if ((parent.masks[i] >> slot) & 1u) {
            ids.push_back(parent.touching[i]);
        }
    }
    return ids;
}

class Bake {
public:
    Bake(const Grid& grid, std::span<const PlotSurface> surfaces, const BakeLimits& limits,
         const BakeProgress& progress)
        : grid_(grid), surfaces_(surfaces), progress_(progress) {
        control_.max_cells = std::min<uint64_t>(limits.max_cells, kMaxCells);
    }

    Expected<Octree> run() {
        Expected<PlotTriangles> triangles = collect_triangles(surfaces_, grid_);
        if (!triangles) {
            return triangles.error();
        }
        triangles_ = std::move(*triangles);
        make_top();
        parallel_for_each(bricks_.size(), [&](size_t i) { build_brick(bricks_[i]); });
        if (cancelled_) {
            return Error{ErrorCode::Cancelled, "bake: cancelled"};
        }
        return assemble();
    }

private:
    // --- the top of the tree ---

    void make_top() {
        TopCell root{root_cell(grid_), 0, std::vector<uint32_t>(triangles_.broad.size()), {}};
        std::iota(root.touching.begin(), root.touching.end(), 0u);
        top_.push_back(std::move(root));
        for (size_t i = 0; i < top_.size(); ++i) {
            find_masks(top_[i]);
            make_children(i);
        }
    }

    void find_masks(TopCell& cell) {
        constexpr size_t kGrain = 1024;
        const Octants octants = octants_of(grid_, cell.box);
        cell.masks.resize(cell.touching.size());
        parallel_for(cell.touching.size(), kGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const BroadTriangle& broad = triangles_.broad[cell.touching[i]];
                cell.masks[i] =
                    touched_octants(octants, triangles_.by_number[broad.triangle].v, broad.center_test);
            }
        });
    }

    void make_children(size_t parent) {
        uint32_t any = octants_with_small(top_[parent]);
        for (const uint8_t mask : top_[parent].masks) {
            any |= mask;
        }
        for (int slot = 0; slot < 8; ++slot) {
            if (((any >> slot) & 1u) == 0) {
                continue;
            }
            if (top_[parent].box.level == kBrickParentLevel) {
                top_[parent].children[slot] = int64_t(bricks_.size());
                bricks_.push_back({parent, slot, {}, 0, 0.0f});
            } else {
                top_[parent].children[slot] = int64_t(top_.size());
                top_.push_back({child_cell(grid_, top_[parent].box, slot),
                                top_[parent].number * 8 + uint32_t(slot),
                                touching_octant(top_[parent], slot),
                                {}});
            }
        }
        if (top_[parent].box.level != kBrickParentLevel) {
            top_[parent].touching = {};
            top_[parent].masks = {};
        }
    }

    /// Bits of the children in which small triangles have leaves.
    [[nodiscard]] uint32_t octants_with_small(const TopCell& cell) const {
        const uint32_t bricks_of_child = kBakeBricks >> (3 * (cell.box.level + 1));
        uint32_t octants = 0;
        for (uint32_t i = 0; i < 8 * bricks_of_child; ++i) {
            if (triangles_.small.touches_brick(cell.number * 8 * bricks_of_child + i)) {
                octants |= 1u << (i / bricks_of_child);
            }
        }
        return octants;
    }

    // --- bricks ---

    void build_brick(Brick& brick) {
        if (control_.stop.load(std::memory_order_relaxed)) {
            return;
        }
        const TopCell& parent = top_[brick.parent];
        SubtreeBuilder builder(grid_, surfaces_, triangles_, control_);
        const uint32_t number = parent.number * 8 + uint32_t(brick.slot);
        const std::vector<uint32_t> broad = touching_octant(parent, brick.slot);
        const std::vector<LeafPlot> small = triangles_.small.sorted_by_leaf(number);
        brick.alpha = builder.build(child_cell(grid_, parent.box, brick.slot), {broad, small, number});
        brick.leaf_count = builder.leaf_count();
        brick.cells = builder.take_cells();
        report_brick();
    }

    /// One call at a time and the share only grows, whichever worker it comes from.
    void report_brick() {
        if (!progress_) {
            return;
        }
        const std::lock_guard lock(progress_mutex_);
        ++bricks_done_;
        if (!cancelled_ && !progress_(float(bricks_done_) / float(bricks_.size()))) {
            cancelled_ = true;
            control_.stop.store(true, std::memory_order_relaxed);
        }
    }

    // --- one array of cells ---

    Expected<Octree> assemble() {
        const uint64_t total = control_.cell_count + top_.size();
        if (total > control_.max_cells) {
            return Error{ErrorCode::OutOfMemory,
                         fmt::format("bake: expected at most {} cells, found more", control_.max_cells)};
        }
        Octree octree;
        octree.levels = grid_.levels;
        octree.dims = grid_.dims;
        octree.cells.reserve(total);
        append_top(0, octree);
        return octree;
    }

    /// Depth first, slots in order; the depth is kBrickParentLevel. @return the cell's alpha.
    float append_top(size_t number, Octree& octree) {
        const TopCell& top = top_[number];
        const size_t index = octree.cells.size();
        octree.cells.push_back(empty_cell(top.box.level));
        float child_alphas = 0.0f;
        for (int slot = 0; slot < 8; ++slot) {
            if (top.children[slot] < 0) {
                continue;
            }
            octree.cells[index].children[slot] = uint32_t(octree.cells.size());
            const size_t child = size_t(top.children[slot]);
            child_alphas += top.box.level == kBrickParentLevel ? append_brick(bricks_[child], octree)
                                                               : append_top(child, octree);
        }
        const float alpha = child_alphas / 8.0f;
        octree.cells[index].level_alpha = encode_level_alpha(top.box.level, alpha);
        return alpha;
    }

    static float append_brick(Brick& brick, Octree& octree) {
        const uint32_t offset = uint32_t(octree.cells.size());
        for (Cell cell : brick.cells) {
            for (uint32_t& child : cell.children) {
                child += child == kNoChild ? 0 : offset;
            }
            octree.cells.push_back(cell);
        }
        octree.leaf_count += brick.leaf_count;
        brick.cells = {}; // keeps the peak near one copy
        return brick.alpha;
    }

    const Grid& grid_;
    std::span<const PlotSurface> surfaces_;
    const BakeProgress& progress_;
    BakeControl control_;
    PlotTriangles triangles_;
    std::vector<TopCell> top_;
    std::vector<Brick> bricks_;
    std::mutex progress_mutex_;
    size_t bricks_done_ = 0;
    bool cancelled_ = false;
};

} // namespace

Expected<Octree> voxelize(const Grid& grid, std::span<const PlotSurface> surfaces,
                          const BakeProgress& progress, const BakeLimits& limits) {
    if (progress && !progress(0.0f)) {
        return Error{ErrorCode::Cancelled, "bake: cancelled"};
    }
    try {
        return Bake(grid, surfaces, limits, progress).run();
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::OutOfMemory, "bake: expected memory for the cells, found none"};
    }
}

bool triangle_overlaps_box(const glm::vec3& center, const glm::vec3& half, const glm::vec3& a,
                           const glm::vec3& b, const glm::vec3& c) noexcept {
    const Boxes<float> box{{center.x, center.y, center.z}, {half.x, half.y, half.z}};
    const glm::vec3 vertices[3] = {a, b, c};
    return !separated(box, vertices);
}

} // namespace cl::gi
