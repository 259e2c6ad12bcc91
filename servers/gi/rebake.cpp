#include "servers/gi/rebake.h"

#include "servers/gi/brick_filter.h"

#include <bit>
#include <unordered_map>
#include <utility>

namespace cl::gi {

namespace {

using DigestsOfBricks = std::vector<std::vector<Digest>>;

/// Of each brick the surfaces that touch it, in plot order.
DigestsOfBricks digests_of_bricks(std::span<const BakedSurface> surfaces) {
    DigestsOfBricks of(kBakeBricks);
    for (const BakedSurface& surface : surfaces) {
        for (uint32_t parent = 0; parent < kBakeBricks / 8; ++parent) {
            uint32_t slots = surface.reach.children_of(kBrickParentLevel, parent);
            for (; slots != 0; slots &= slots - 1) {
                of[parent * 8 + uint32_t(std::countr_zero(slots))].push_back(surface.digest);
            }
        }
    }
    return of;
}

/// Bricks that the same surfaces touch in the same order are left out.
TopReach changed_bricks(std::span<const BakedSurface> before, std::span<const BakedSurface> now) {
    const DigestsOfBricks of_before = digests_of_bricks(before), of_now = digests_of_bricks(now);
    TopReach changed;
    for (uint32_t brick = 0; brick < kBakeBricks; ++brick) {
        if (of_before[brick] != of_now[brick]) {
            changed.add_brick(brick);
        }
    }
    return changed;
}

class Rebake {
public:
    Rebake(const Grid& grid, std::span<const Digest> digests, const SurfaceSource& source,
           const BakeMemory& memory)
        : grid_(grid), source_(source), memory_(memory) {
        std::unordered_map<Digest, const TopReach*, DigestHash> known;
        for (const BakedSurface& surface : memory.surfaces) {
            known.emplace(surface.digest, &surface.reach);
        }
        for (const Digest& digest : digests) {
            const auto found = known.find(digest);
            if (found == known.end()) {
                unknown_.push_back(uint32_t(now_.size()));
            }
            now_.push_back({digest, found == known.end() ? TopReach() : *found->second});
        }
    }

    Expected<BakedBricks> run(BrickBake& bake, std::span<const int32_t> last_result) {
        if (!unknown_.empty()) {
            const std::vector<PlotSurface> surfaces = source_(unknown_);
            const Expected<PlotTriangles> triangles = collect_triangles(surfaces, grid_);
            if (!triangles) {
                return triangles.error();
            }
            const TopCells top = place_unknown(*triangles);
            if (unknown_.size() == now_.size()) {
                return bake.run(surfaces, *triangles, top);
            }
        }
        return bake_changed(bake, last_result);
    }

    std::vector<BakedSurface> take_surfaces() { return std::move(now_); }

private:
    TopCells place_unknown(const PlotTriangles& triangles) {
        std::vector<TopReach> reach(unknown_.size());
        TopCells top(grid_, triangles, {}, reach);
        for (size_t i = 0; i < reach.size(); ++i) {
            now_[unknown_[i]].reach = reach[i];
        }
        return top;
    }

    Expected<BakedBricks> bake_changed(BrickBake& bake, std::span<const int32_t> last_result) const {
        const TopReach changed = changed_bricks(memory_.surfaces, now_);
        TopReach all;
        std::vector<uint32_t> needed;
        for (uint32_t i = 0; i < now_.size(); ++i) {
            all |= now_[i].reach;
            if (now_[i].reach.meets(changed)) {
                needed.push_back(i);
            }
        }
        const std::vector<PlotSurface> surfaces =
            needed.empty() ? std::vector<PlotSurface>() : source_(needed);
        const BrickFilter filter(grid_, changed);
        const Expected<PlotTriangles> triangles = collect_triangles(surfaces, grid_, &filter);
        if (!triangles) {
            return triangles.error();
        }
        const KeptBricks kept{changed, memory_.bricks, last_result};
        return bake.run(surfaces, *triangles, TopCells(grid_, *triangles, all), &kept);
    }

    const Grid& grid_;
    const SurfaceSource& source_;
    const BakeMemory& memory_;
    std::vector<BakedSurface> now_;
    std::vector<uint32_t> unknown_; ///< numbers of surfaces
};

bool is_usable(const BakeMemory& memory, const Grid& grid, std::span<const int32_t> last_result) {
    return memory.grid.levels == grid.levels && memory.grid.box == grid.box && !last_result.empty();
}

} // namespace

Expected<BakedOctree> revoxelize(const Grid& grid, std::span<const Digest> digests,
                                 const SurfaceSource& source, BakeMemory& memory,
                                 std::span<const int32_t> last_result, const BakeProgress& progress,
                                 const BakeLimits& limits) {
    return run_bake(progress, [&]() -> Expected<BakedOctree> {
        static const BakeMemory kNone;
        Rebake rebake(grid, digests, source, is_usable(memory, grid, last_result) ? memory : kNone);
        BrickBake bake(grid, limits, progress);
        Expected<BakedBricks> baked = rebake.run(bake, last_result);
        if (!baked) {
            return baked.error();
        }
        memory = {grid, rebake.take_surfaces(), std::move(baked->bricks)};
        return std::move(baked->octree);
    });
}

} // namespace cl::gi
