#pragma once

#include "servers/visual/frustum.h"

#include "core/math/aabb.h"
#include "core/rid.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace cl {

/// Boxes of a scenario, found by overlap in logarithmic time: a binary tree of bounding boxes.
///
/// A new box splits the leaf that it enlarges least; a moved one only refits its ancestors. The tree is built
/// anew (median split, so its depth is logarithmic again) when a share of it was added, removed or moved,
/// which keeps every change at O(log n) amortised without the rotations of a self-balancing tree. A box that
/// is not finite is kept but never found, so that it cannot spoil its neighbours.
class BoxTree {
public:
    using Entry = uint32_t;

    Entry insert(const AABB& box, RID item);
    void move(Entry entry, const AABB& box);
    void remove(Entry entry);
    [[nodiscard]] size_t size() const noexcept { return entries_.size() - free_.size(); }

    /// What overlapping() goes by: true if the boxes share a point, false if either is not finite.
    [[nodiscard]] static bool touching(const AABB& a, const AABB& b) noexcept;
    /// Calls found(RID) for each box that overlaps `box` or touches it, in no particular order.
    template <typename F>
    void overlapping(const AABB& box, F&& found) const {
        const Bounds wanted = bounds_of(box);
        visit([&wanted](const Bounds& b) { return b.touches(wanted); }, found);
    }
    /// Calls found(RID) for each box that `frustum` may see, in no particular order.
    template <typename F>
    void seen_by(const Frustum& frustum, F&& found) const {
        visit([&frustum](const Bounds& b) { return !b.empty() && may_see(frustum, b.least, b.most); }, found);
    }
    /// Calls found(RID) for each box there is, in no particular order.
    template <typename F>
    void all(F&& found) const {
        visit([](const Bounds& b) { return !b.empty(); }, found);
    }
    /// How many boxes, inner ones too, overlapping() compares with `box`: the cost of a query.
    [[nodiscard]] size_t boxes_looked_at(const AABB& box) const {
        const Bounds wanted = bounds_of(box);
        size_t count = 0;
        const auto counting = [&wanted, &count](const Bounds& b) {
            ++count;
            return b.touches(wanted);
        };
        const auto ignore = [](RID) {};
        visit(counting, ignore);
        return count;
    }

private:
    static constexpr float kInfinity = std::numeric_limits<float>::infinity();
    static constexpr uint32_t kNone = 0xFFFFFFFFu;

    struct Bounds {
        glm::vec3 least{kInfinity}, most{-kInfinity};
        [[nodiscard]] bool empty() const noexcept { return least.x > most.x; }
        [[nodiscard]] bool touches(const Bounds& o) const noexcept;
        [[nodiscard]] Bounds merged(const Bounds& o) const noexcept;
        [[nodiscard]] float half_area() const noexcept; ///< [m^2], 0 if empty
        friend bool operator==(const Bounds&, const Bounds&) = default;
    };
    struct Item {
        Bounds bounds;
        RID rid;
        uint32_t leaf = kNone; ///< node that holds it
        bool live = false;
    };
    struct Node {
        Bounds bounds;
        uint32_t parent = kNone;
        uint32_t child = kNone; ///< two children at child and child + 1; kNone: a leaf
        uint32_t item = kNone;  ///< of a leaf; kNone: it was removed
    };
    /// Traversal keeps at most one node a level on its stack, and one more.
    static constexpr size_t kMaxDepth = 60;
    static Bounds bounds_of(const AABB& box) noexcept;
    void refit(uint32_t node) noexcept;
    size_t hang(uint32_t item);
    void put(uint32_t node, uint32_t item) noexcept;
    void rebuild_if_worn();
    void rebuild();
    void split(std::vector<uint32_t>& items, size_t begin, size_t end, uint32_t node);

    /// Depth-first through the nodes that `passes` accepts.
    template <typename Pass, typename F>
    void visit(const Pass& passes, F&& found) const {
        std::array<uint32_t, kMaxDepth + 2> stack{};
        size_t depth = 0;
        if (!nodes_.empty()) {
            stack[depth++] = 0;
        }
        while (depth > 0) {
            const Node& node = nodes_[stack[--depth]];
            if (!passes(node.bounds)) {
                continue;
            }
            if (node.child != kNone) {
                stack[depth++] = node.child + 1;
                stack[depth++] = node.child;
            } else if (node.item != kNone) {
                found(entries_[node.item].rid);
            }
        }
    }

    std::vector<Item> entries_;
    std::vector<uint32_t> free_;
    std::vector<Node> nodes_; ///< node 0 is the root
    size_t wear_ = 0;         ///< weighted changes since the tree was built
    size_t built_nodes_ = 0;  ///< when it was built
};

} // namespace cl
