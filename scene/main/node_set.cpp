#include "scene/main/node_set.h"

#include "scene/main/node.h"

#include <algorithm>

namespace cl::scene {

template <typename Before>
const std::vector<Node*>& NodeSet::ordered(uint64_t order_version, Before&& before) {
    if (!sorted_ || sorted_version_ != order_version) {
        list_.assign(nodes_.begin(), nodes_.end());
        std::sort(list_.begin(), list_.end(), before);
        sorted_ = true;
        sorted_version_ = order_version;
    }
    return list_;
}

const std::vector<Node*>& NodeSet::in_tree_order(uint64_t order_version) {
    return ordered(order_version, [](const Node* a, const Node* b) { return a->is_before(*b); });
}

const std::vector<Node*>& NodeSet::in_process_order(uint64_t order_version) {
    return ordered(order_version, [](const Node* a, const Node* b) {
        return a->process_priority() != b->process_priority() ? a->process_priority() < b->process_priority()
                                                              : a->is_before(*b);
    });
}

NodeSnapshot::NodeSnapshot(const std::vector<Node*>& nodes) {
    handles_.reserve(nodes.size());
    for (const Node* node : nodes) {
        handles_.push_back(node->handle());
    }
}

Node* NodeSnapshot::at(size_t i) const noexcept {
    const std::shared_ptr<Object*> object = handles_[i].lock();
    return object ? static_cast<Node*>(*object) : nullptr;
}

} // namespace cl::scene
