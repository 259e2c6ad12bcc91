#include "servers/visual/box_tree.h"

#include "core/assert.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace cl {
namespace {

// How much a change wears the tree: it doubles, or every box moves four times, before it is built anew.
constexpr size_t kInsertWear = 4, kRemoveWear = 4, kMoveWear = 1;
constexpr size_t kWornOut = size_t{1} << 60; ///< built anew at once

} // namespace

bool BoxTree::Bounds::touches(const Bounds& o) const noexcept {
    return least.x <= o.most.x && o.least.x <= most.x && least.y <= o.most.y && o.least.y <= most.y &&
           least.z <= o.most.z && o.least.z <= most.z;
}

BoxTree::Bounds BoxTree::Bounds::merged(const Bounds& o) const noexcept {
    return {glm::min(least, o.least), glm::max(most, o.most)};
}

float BoxTree::Bounds::half_area() const noexcept {
    const glm::vec3 size = empty() ? glm::vec3(0.0f) : most - least;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

BoxTree::Bounds BoxTree::bounds_of(const AABB& box) noexcept {
    const glm::vec3 end = box.end();
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(box.position[axis]) || !std::isfinite(end[axis])) {
            return {};
        }
    }
    return {box.position, end};
}

bool BoxTree::touching(const AABB& a, const AABB& b) noexcept {
    return bounds_of(a).touches(bounds_of(b));
}

BoxTree::Entry BoxTree::insert(const AABB& box, RID item) {
    Entry entry;
    if (free_.empty()) {
        entry = static_cast<Entry>(entries_.size());
        entries_.emplace_back();
    } else {
        entry = free_.back();
        free_.pop_back();
    }
    entries_[entry] = Item{bounds_of(box), item, kNone, true};
    const size_t depth = hang(entry);
    wear_ += depth < kMaxDepth ? kInsertWear : kWornOut;
    rebuild_if_worn();
    return entry;
}

/// Walks down to the leaf that the item enlarges least and puts it beside that leaf's own. @return its depth
size_t BoxTree::hang(uint32_t item) {
    if (nodes_.empty()) {
        nodes_.emplace_back();
        put(0, item);
        return 0;
    }
    const Bounds& bounds = entries_[item].bounds;
    const auto growth = [this, &bounds](uint32_t node) {
        return nodes_[node].bounds.merged(bounds).half_area() - nodes_[node].bounds.half_area();
    };
    uint32_t node = 0;
    size_t depth = 0;
    for (; nodes_[node].child != kNone; ++depth) {
        const uint32_t child = nodes_[node].child;
        nodes_[node].bounds = nodes_[node].bounds.merged(bounds);
        node = growth(child) <= growth(child + 1) ? child : child + 1;
    }
    const uint32_t neighbour = nodes_[node].item;
    if (neighbour == kNone) {
        put(node, item);
        return depth;
    }
    const uint32_t child = static_cast<uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[child].parent = nodes_[child + 1].parent = node;
    nodes_[node].child = child;
    nodes_[node].item = kNone;
    nodes_[node].bounds = nodes_[node].bounds.merged(bounds);
    put(child, neighbour);
    put(child + 1, item);
    return depth + 1;
}

void BoxTree::put(uint32_t node, uint32_t item) noexcept {
    nodes_[node].item = item;
    nodes_[node].bounds = entries_[item].bounds;
    entries_[item].leaf = node;
}

void BoxTree::move(Entry entry, const AABB& box) {
    CL_ASSERT(entry < entries_.size() && entries_[entry].live, "move() of an entry that is not in the tree");
    Item& item = entries_[entry];
    item.bounds = bounds_of(box);
    nodes_[item.leaf].bounds = item.bounds;
    refit(nodes_[item.leaf].parent);
    wear_ += kMoveWear;
    rebuild_if_worn();
}

void BoxTree::remove(Entry entry) {
    CL_ASSERT(entry < entries_.size() && entries_[entry].live,
              "remove() of an entry that is not in the tree");
    Item& item = entries_[entry];
    Node& leaf = nodes_[item.leaf];
    leaf.item = kNone;
    leaf.bounds = {};
    refit(leaf.parent);
    wear_ += kRemoveWear;
    item = {};
    free_.push_back(entry);
    rebuild_if_worn();
}

void BoxTree::refit(uint32_t node) noexcept {
    while (node != kNone) {
        const uint32_t child = nodes_[node].child;
        const Bounds fitted = nodes_[child].bounds.merged(nodes_[child + 1].bounds);
        if (fitted == nodes_[node].bounds) {
            return;
        }
        nodes_[node].bounds = fitted;
        node = nodes_[node].parent;
    }
}

void BoxTree::rebuild_if_worn() {
    if (wear_ > 64 + 2 * built_nodes_) { // that is four times the items there were
        rebuild();
    }
}

void BoxTree::rebuild() {
    std::vector<uint32_t> live;
    live.reserve(size());
    for (uint32_t i = 0; i < entries_.size(); ++i) {
        if (entries_[i].live) {
            live.push_back(i);
        }
    }
    nodes_.clear();
    wear_ = 0;
    if (!live.empty()) {
        nodes_.reserve(2 * live.size());
        nodes_.emplace_back();
        split(live, 0, live.size(), 0);
    }
    built_nodes_ = nodes_.size();
}

/// Fills `node` with items[begin, end): halves them at the median of the axis along which centres spread
/// most.
void BoxTree::split(std::vector<uint32_t>& items, size_t begin, size_t end, uint32_t node) {
    Bounds all, centers;
    // An empty box (not finite) counts as one at the origin.
    const auto center = [this](uint32_t i) {
        const Bounds& b = entries_[i].bounds;
        return b.empty() ? glm::vec3(0.0f) : 0.5f * b.least + 0.5f * b.most;
    };
    for (size_t i = begin; i < end; ++i) {
        all = all.merged(entries_[items[i]].bounds);
        centers = centers.merged({center(items[i]), center(items[i])});
    }
    nodes_[node].bounds = all;
    if (end - begin == 1) {
        put(node, items[begin]);
        return;
    }
    const glm::vec3 spread = centers.most - centers.least;
    const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : (spread.y >= spread.z ? 1 : 2);
    const size_t middle = begin + (end - begin) / 2;
    const auto at = [&items](size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&center, axis](uint32_t a, uint32_t b) {
        const float ca = center(a)[axis], cb = center(b)[axis];
        return ca != cb ? ca < cb : a < b;
    });
    const uint32_t child = static_cast<uint32_t>(nodes_.size());
    nodes_[node].child = child;
    nodes_.resize(nodes_.size() + 2);
    nodes_[child].parent = nodes_[child + 1].parent = node;
    split(items, begin, middle, child);
    split(items, middle, end, child + 1);
}

} // namespace cl
