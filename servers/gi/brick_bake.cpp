#include "servers/gi/brick_bake.h"

#include "servers/gi/cell_words.h"

#include "core/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace cl::gi {

namespace {

Error cancelled() {
    return {ErrorCode::Cancelled, "bake: cancelled"};
}

} // namespace

BrickBake::BrickBake(const Grid& grid, const BakeLimits& limits, const BakeProgress& progress)
    : grid_(grid), progress_(progress) {
    control_.max_cells = std::min<uint64_t>(limits.max_cells, kMaxCells);
}

Expected<BakedBricks> BrickBake::run(std::span<const PlotSurface> surfaces, const PlotTriangles& triangles,
                                     const TopCells& top, const KeptBricks* kept) {
    top_ = &top;
    bricks_.resize(top.bricks().size());
    for (size_t i = 0; i < bricks_.size(); ++i) {
        const uint32_t number = top.bricks()[i].number;
        if (!kept || kept->plotted.has_brick(number)) {
            todo_.push_back(i);
            continue;
        }
        bricks_[i].record = kept->bricks[number];
        bricks_[i].kept =
            cells_of(kept->dynamic_data, kept->bricks[number].first_cell, kept->bricks[number].cell_count);
        control_.cell_count += bricks_[i].record.cell_count;
    }
    parallel_for_each(todo_.size(), [&](size_t i) { build_brick(todo_[i], surfaces, triangles); });
    return cancelled_ ? Expected<BakedBricks>(cancelled()) : assemble();
}

void BrickBake::build_brick(size_t number, std::span<const PlotSurface> surfaces,
                            const PlotTriangles& triangles) {
    if (control_.stop.load(std::memory_order_relaxed)) {
        return;
    }
    const BrickPlace& place = top_->bricks()[number];
    const CellBox box = child_cell(grid_, top_->cells()[place.parent].box, place.slot);
    const std::vector<uint32_t> broad = top_->broad_of(place);
    const std::vector<LeafPlot> small = triangles.small.sorted_by_leaf(place.number);
    SubtreeBuilder builder(grid_, surfaces, triangles, control_);
    Brick& brick = bricks_[number];
    brick.record.alpha = builder.build(box, {broad, small, place.number});
    brick.record.leaf_count = builder.leaf_count();
    brick.cells = builder.take_cells();
    brick.record.cell_count = uint32_t(brick.cells.size());
    report_brick();
}

/// One call at a time and the share only grows, whichever worker it comes from.
void BrickBake::report_brick() {
    if (!progress_) {
        return;
    }
    const std::lock_guard lock(progress_mutex_);
    ++bricks_done_;
    if (!cancelled_ && !progress_(float(bricks_done_) / float(todo_.size()))) {
        cancelled_ = true;
        control_.stop.store(true, std::memory_order_relaxed);
    }
}

Expected<BakedBricks> BrickBake::assemble() {
    const uint64_t total = control_.cell_count + top_->cells().size();
    if (total > control_.max_cells) {
        return Error{ErrorCode::OutOfMemory,
                     fmt::format("bake: expected at most {} cells, found more", control_.max_cells)};
    }
    OctreeWriter writer(grid_.levels, grid_.dims, total);
    append_top(0, writer);
    BakedBricks baked;
    baked.bricks.resize(kBakeBricks);
    baked.octree.cell_count = uint32_t(total);
    for (size_t i = 0; i < bricks_.size(); ++i) {
        baked.octree.leaf_count += bricks_[i].record.leaf_count;
        baked.bricks[top_->bricks()[i].number] = bricks_[i].record;
    }
    baked.octree.dynamic_data = writer.finish(baked.octree.leaf_count);
    return baked;
}

/// Depth first, slots in order; the depth is kBrickParentLevel. @return the cell's alpha.
float BrickBake::append_top(size_t number, OctreeWriter& writer) {
    const TopCell& top = top_->cells()[number];
    const uint32_t index = writer.next();
    writer.append(empty_cell(top.box.level));
    float child_alphas = 0.0f;
    for (int slot = 0; slot < 8; ++slot) {
        if (top.children[slot] < 0) {
            continue;
        }
        writer.set_child(index, slot, writer.next());
        const size_t child = size_t(top.children[slot]);
        child_alphas +=
            top.box.level == kBrickParentLevel ? append_brick(child, writer) : append_top(child, writer);
    }
    const float alpha = child_alphas / 8.0f;
    writer.set_level_alpha(index, encode_level_alpha(top.box.level, alpha));
    return alpha;
}

float BrickBake::append_brick(size_t number, OctreeWriter& writer) {
    Brick& brick = bricks_[number];
    const uint32_t first = writer.next();
    if (brick.kept.empty()) {
        writer.append(brick.cells, first);
        brick.cells = {}; // keeps the peak near one copy
    } else {
        writer.append(brick.kept, first - brick.record.first_cell);
    }
    brick.record.first_cell = first;
    return brick.record.alpha;
}

Expected<BakedOctree> run_bake(const BakeProgress& progress,
                               const std::function<Expected<BakedOctree>()>& bake) {
    if (progress && !progress(0.0f)) {
        return cancelled();
    }
    try {
        return bake();
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::OutOfMemory, "bake: expected memory for the cells, found none"};
    }
}

} // namespace cl::gi
