#pragma once

#include "core/object/object.h"

#include <cstdint>
#include <memory>
#include <unordered_set>
#include <vector>

namespace cl::scene {

class Node;

/// Nodes of one tree with a common trait (a group, those that process), listed in an order that is worked out
/// when it is asked for.
class NodeSet {
public:
    void insert(Node& node) {
        nodes_.insert(&node);
        sorted_ = false;
    }
    void erase(Node& node) {
        if (nodes_.erase(&node) > 0) {
            sorted_ = false;
        }
    }
    [[nodiscard]] bool empty() const noexcept { return nodes_.empty(); }

    /// In tree order, parents before children. @param order_version  changes when the order in the tree does
    [[nodiscard]] const std::vector<Node*>& in_tree_order(uint64_t order_version);
    /// By process_priority, then in tree order.
    [[nodiscard]] const std::vector<Node*>& in_process_order(uint64_t order_version);

private:
    template <typename Before>
    const std::vector<Node*>& ordered(uint64_t order_version, Before&& before);
    std::unordered_set<Node*> nodes_;
    std::vector<Node*> list_;
    uint64_t sorted_version_ = 0;
    bool sorted_ = true;
};

/// Nodes to visit while the visits may remove or destroy any of them.
class NodeSnapshot {
public:
    explicit NodeSnapshot(const std::vector<Node*>& nodes);
    /// Calls visit(Node&) for each node that is still alive, in order.
    template <typename Visit>
    void visit_alive(Visit&& visit) const {
        for (size_t i = 0; i < handles_.size(); ++i) {
            if (Node* node = at(i)) {
                visit(*node);
            }
        }
    }

private:
    [[nodiscard]] Node* at(size_t i) const noexcept;
    std::vector<std::weak_ptr<Object*>> handles_;
};

} // namespace cl::scene
