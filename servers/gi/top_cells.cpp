#include "servers/gi/top_cells.h"

#include "core/threads.h"

#include <numeric>

namespace cl::gi {

namespace {

std::vector<uint32_t> touching_octant(const TopCell& parent, int slot) {
    std::vector<uint32_t> ids;
    for (size_t i = 0; i < parent.touching.size(); ++i) {
        if ((parent.masks[i] >> slot) & 1u) {
            ids.push_back(parent.touching[i]);
        }
    }
    return ids;
}

} // namespace

void TopReach::add_brick(uint32_t number) noexcept {
    for (int level = kBrickParentLevel; level >= 0; --level, number /= 8) {
        children_of(level, number / 8) |= uint8_t(1u << (number % 8));
    }
}

bool TopReach::meets(const TopReach& other) const noexcept {
    for (size_t i = first_of(kBrickParentLevel); i < children_.size(); ++i) {
        if ((children_[i] & other.children_[i]) != 0) {
            return true;
        }
    }
    return false;
}

TopReach& TopReach::operator|=(const TopReach& other) noexcept {
    for (size_t i = 0; i < children_.size(); ++i) {
        children_[i] |= other.children_[i];
    }
    return *this;
}

TopCells::TopCells(const Grid& grid, const PlotTriangles& triangles, const TopReach& also,
                   std::span<TopReach> of_surfaces)
    : grid_(grid), triangles_(triangles), also_(also) {
    note_small_triangles(of_surfaces);
    TopCell root{root_cell(grid_), 0, std::vector<uint32_t>(triangles_.broad.size()), {}};
    std::iota(root.touching.begin(), root.touching.end(), 0u);
    cells_.push_back(std::move(root));
    for (size_t i = 0; i < cells_.size(); ++i) {
        find_masks(cells_[i]);
        if (!of_surfaces.empty()) {
            note_broad_triangles(cells_[i], of_surfaces);
        }
        make_children(i);
    }
}

void TopCells::note_small_triangles(std::span<TopReach> of_surfaces) {
    for (uint32_t number = 0; number < kBakeBricks; ++number) {
        const std::span<const LeafPlot> plots = triangles_.small.of_brick(number);
        if (!plots.empty()) {
            also_.add_brick(number);
        }
        if (!of_surfaces.empty()) {
            for (const LeafPlot& plot : plots) {
                of_surfaces[triangles_.by_number[plot.triangle].surface].add_brick(number);
            }
        }
    }
}

void TopCells::find_masks(TopCell& cell) {
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

void TopCells::note_broad_triangles(const TopCell& cell, std::span<TopReach> of_surfaces) const {
    for (size_t i = 0; i < cell.touching.size(); ++i) {
        const uint32_t triangle = triangles_.broad[cell.touching[i]].triangle;
        TopReach& reach = of_surfaces[triangles_.by_number[triangle].surface];
        reach.children_of(cell.box.level, cell.number) |= cell.masks[i];
    }
}

void TopCells::make_children(size_t parent) {
    uint32_t any = also_.children_of(cells_[parent].box.level, cells_[parent].number);
    for (const uint8_t mask : cells_[parent].masks) {
        any |= mask;
    }
    for (int slot = 0; slot < 8; ++slot) {
        if (((any >> slot) & 1u) == 0) {
            continue;
        }
        const uint32_t number = cells_[parent].number * 8 + uint32_t(slot);
        if (cells_[parent].box.level == kBrickParentLevel) {
            cells_[parent].children[slot] = int64_t(bricks_.size());
            bricks_.push_back({parent, slot, number});
        } else {
            cells_[parent].children[slot] = int64_t(cells_.size());
            cells_.push_back({child_cell(grid_, cells_[parent].box, slot),
                              number,
                              touching_octant(cells_[parent], slot),
                              {}});
        }
    }
    if (cells_[parent].box.level != kBrickParentLevel) {
        cells_[parent].touching = {};
        cells_[parent].masks = {};
    }
}

std::vector<uint32_t> TopCells::broad_of(const BrickPlace& brick) const {
    return touching_octant(cells_[brick.parent], brick.slot);
}

} // namespace cl::gi
