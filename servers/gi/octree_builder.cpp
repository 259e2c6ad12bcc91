#include "servers/gi/octree_builder.h"

#include "servers/gi/cell_words.h"
#include "servers/gi/leaf_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cl::gi {

namespace {

/// Leaf cells along half a child's parent, i.e. along a child of a cell at `level`.
int child_cells(const Grid& grid, int level) {
    return 1 << (grid.levels - 2 - level);
}

/// Fix-up and quantisation of one leaf (spec gi-bake section 6).
Cell leaf_cell(int level, const LeafSum& sum) {
    Cell cell = empty_cell(level);
    cell.albedo = encode_albedo(sum.albedo / sum.alpha);
    cell.emission = encode_emission(sum.emission / sum.alpha);
    constexpr float kCancelled = 0.01f; // opposing surfaces in one leaf leave no normal
    const glm::vec3 n = sum.normal / sum.alpha;
    const float length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    cell.normal = encode_normal(length < kCancelled ? glm::vec3(0.0f) : n / length);
    cell.level_alpha = encode_level_alpha(level, 1.0f);
    return cell;
}

} // namespace

CellBox root_cell(const Grid& grid) noexcept {
    return {grid.cubic_box.position, grid.cubic_box.size.x, 0, glm::ivec3(0)};
}

CellBox child_cell(const Grid& grid, const CellBox& parent, int slot) noexcept {
    CellBox child = parent;
    child.size_m = parent.size_m * 0.5f;
    child.level = parent.level + 1;
    for (int axis = 0; axis < 3; ++axis) {
        if ((slot >> axis) & 1) {
            child.position[axis] += child.size_m;
            child.origin[axis] += child_cells(grid, parent.level);
        }
    }
    return child;
}

Octants octants_of(const Grid& grid, const CellBox& parent) noexcept {
    Octants octants;
    const float half = parent.size_m * 0.5f * 0.5f;
    for (int slot = 0; slot < 8; ++slot) {
        const CellBox child = child_cell(grid, parent, slot);
        Boxes<float4>& boxes = slot < 4 ? octants.lower : octants.upper;
        for (int axis = 0; axis < 3; ++axis) {
            boxes.center[axis][slot % 4] = child.position[axis] + half;
            boxes.half[axis][slot % 4] = half;
        }
        const bool inside =
            child.origin.x < grid.dims.x && child.origin.y < grid.dims.y && child.origin.z < grid.dims.z;
        octants.inside = uint8_t(octants.inside | (inside ? 1 << slot : 0));
    }
    return octants;
}

Cell empty_cell(int level) noexcept {
    Cell cell{};
    std::fill(std::begin(cell.children), std::end(cell.children), kNoChild);
    cell.normal = encode_normal(glm::vec3(0.0f));
    cell.level_alpha = encode_level_alpha(level, 0.0f);
    return cell;
}

float SubtreeBuilder::build(const CellBox& box, const Content& content) {
    ids_.assign(content.broad.begin(), content.broad.end());
    masks_.clear();
    small_ = content.small;
    const float alpha = build_cell(box, content.number, {0, ids_.size()});
    count_cells();
    return alpha;
}

float SubtreeBuilder::build_cell(const CellBox& box, uint32_t number, List touching) {
    if (box.level == grid_.levels - 1) {
        build_leaf(box, number, touching);
        return 1.0f;
    }
    const size_t index = cells_.size();
    cells_.push_back(empty_cell(box.level));
    count_cells();

    const Octants octants = octants_of(grid_, box);
    const size_t masks_begin = masks_.size();
    uint32_t any = octants_with_small(box.level, number);
    for (size_t i = 0; i < touching.count; ++i) {
        const BroadTriangle& broad = triangles_.broad[ids_[touching.begin + i]];
        masks_.push_back(touched_octants(octants, triangles_.by_number[broad.triangle].v, broad.center_test));
        any |= masks_.back();
    }
    float child_alphas = 0.0f;
    for (int slot = 0; slot < 8 && !control_.stop.load(std::memory_order_relaxed); ++slot) {
        if (((any >> slot) & 1u) == 0) {
            continue;
        }
        cells_[index].children[slot] = uint32_t(cells_.size());
        const List list = push_children_list(touching, masks_begin, slot);
        child_alphas += build_cell(child_cell(grid_, box, slot), number * 8 + uint32_t(slot), list);
        ids_.resize(list.begin);
    }
    masks_.resize(masks_begin);
    const float alpha = child_alphas / 8.0f;
    cells_[index].level_alpha = encode_level_alpha(box.level, alpha);
    return alpha;
}

uint32_t SubtreeBuilder::octants_with_small(int level, uint32_t number) const {
    const int child_bits = 3 * (grid_.levels - 2 - level);
    uint32_t octants = 0;
    auto next = small_.begin();
    while (next != small_.end() && (next->leaf >> child_bits) / 8 == number) {
        const uint32_t child = next->leaf >> child_bits;
        octants |= 1u << (child % 8);
        next = std::partition_point(next, small_.end(),
                                    [&](const LeafPlot& p) { return (p.leaf >> child_bits) == child; });
    }
    return octants;
}

SubtreeBuilder::List SubtreeBuilder::push_children_list(List touching, size_t masks_begin, int slot) {
    List list{ids_.size(), 0};
    for (size_t i = 0; i < touching.count; ++i) {
        if ((masks_[masks_begin + i] >> slot) & 1u) {
            ids_.push_back(ids_[touching.begin + i]);
        }
    }
    list.count = ids_.size() - list.begin;
    return list;
}

void SubtreeBuilder::build_leaf(const CellBox& box, uint32_t number, List touching) {
    static const CenterTest kNoTest;
    const LeafBox leaf{box.position, box.size_m};
    LeafSum sum;
    const auto plot = [&](uint32_t triangle, const CenterTest& test) {
        const PlotTriangle& t = triangles_.by_number[triangle];
        sampler_.plot(leaf, t, test, surfaces_[t.surface], sum);
    };
    const auto plot_small_below = [&](uint32_t triangle) {
        while (!small_.empty() && small_.front().leaf == number && small_.front().triangle < triangle) {
            plot(small_.front().triangle, kNoTest);
            small_ = small_.subspan(1);
        }
    };
    for (size_t i = 0; i < touching.count; ++i) {
        const BroadTriangle& broad = triangles_.broad[ids_[touching.begin + i]];
        plot_small_below(broad.triangle);
        plot(broad.triangle, broad.center_test);
    }
    plot_small_below(std::numeric_limits<uint32_t>::max());
    cells_.push_back(leaf_cell(box.level, sum));
    ++leaf_count_;
}

void SubtreeBuilder::count_cells() {
    const uint64_t grown = cells_.size() - counted_cells_;
    counted_cells_ = cells_.size();
    if (control_.cell_count.fetch_add(grown, std::memory_order_relaxed) + grown > control_.max_cells) {
        control_.stop.store(true, std::memory_order_relaxed);
    }
}

} // namespace cl::gi
