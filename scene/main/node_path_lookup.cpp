// Finding nodes by path, and naming the way to them.
#include "scene/main/node.h"
#include "scene/main/scene_tree.h"

#include <algorithm>

namespace cl::scene {

namespace {

NodePath joined(const std::vector<std::string_view>& names, std::string_view prefix) {
    std::string text(prefix);
    for (size_t i = 0; i < names.size(); ++i) {
        text += i > 0 ? "/" : "";
        text += names[i];
    }
    return NodePath(text);
}

} // namespace

Node* Node::find_child(const StringName& name) const noexcept {
    const auto found = std::find_if(children_.begin(), children_.end(),
                                    [&](const auto& child) { return child->name_ == name; });
    return found == children_.end() ? nullptr : found->get();
}

Node* Node::get_node(const NodePath& path) const {
    static const StringName kHere(".");
    static const StringName kUp("..");
    Node* at = const_cast<Node*>(this); // the tree is not part of a node's value
    size_t first = 0;
    if (path.is_absolute()) {
        if (!tree_ || path.names().empty() || path.names()[0] != tree_->root().name()) {
            return nullptr;
        }
        at = &tree_->root();
        first = 1;
    }
    for (size_t i = first; at && i < path.names().size(); ++i) {
        const StringName& name = path.names()[i];
        if (name == kUp) {
            at = at->parent_;
        } else if (name != kHere) {
            at = at->find_child(name);
        }
    }
    return at;
}

NodePath Node::path() const {
    std::vector<std::string_view> names;
    for (const Node* n = this; n; n = n->parent_) {
        names.push_back(n->name_.view());
    }
    std::reverse(names.begin(), names.end());
    return joined(names, tree_ ? "/" : "");
}

NodePath Node::path_to(const Node& other) const {
    if (&other == this) {
        return NodePath(".");
    }
    std::vector<std::string_view> ups;
    const Node* common = this;
    while (common && common != &other && !common->is_ancestor_of(other)) {
        ups.push_back("..");
        common = common->parent_;
    }
    if (!common) {
        return NodePath();
    }
    std::vector<std::string_view> names;
    for (const Node* n = &other; n != common; n = n->parent_) {
        names.push_back(n->name_.view());
    }
    ups.insert(ups.end(), names.rbegin(), names.rend());
    return joined(ups, "");
}

} // namespace cl::scene
