#include "scene/main/node.h"

#include "scene/main/scene_tree.h"

#include "core/object/class_registry.h"

#include <algorithm>
#include <string>

namespace cl::scene {

namespace {

/// "Lamp12" is 12 of the stem "Lamp"; 0 if `name` is not the stem and digits, 1 for the stem alone.
uint64_t number_after_stem(std::string_view name, std::string_view stem) {
    if (name.substr(0, stem.size()) != stem) {
        return 0;
    }
    const std::string_view digits = name.substr(stem.size());
    if (digits.empty()) {
        return 1;
    }
    uint64_t number = 0;
    for (char c : digits) {
        if (c < '0' || c > '9' || number > 100'000'000) {
            return 0;
        }
        number = number * 10 + static_cast<uint64_t>(c - '0');
    }
    return number;
}

/// Interned once: a big scene emits them a million times.
struct SignalNames {
    StringName ready{"ready"}, renamed{"renamed"};
    StringName tree_entered{"tree_entered"}, tree_exiting{"tree_exiting"}, tree_exited{"tree_exited"};
};

const SignalNames& signals() {
    static const SignalNames kNames;
    return kNames;
}

Error refused(std::string message) {
    return Error{ErrorCode::InvalidArgument, std::move(message), {}};
}

} // namespace

void Node::bind(ClassBuilder<Node>& c) {
    c.doc("A named element of the scene tree, with children and groups.");
    c.property(
         "_import_path", [](const Node& n) { return n.import_path_; },
         [](Node& n, NodePath path) { n.import_path_ = std::move(path); })
        .doc("Where an importer found this node. Kept for saving.")
        .default_value(NodePath());
    c.property("pause_mode", &Node::pause_mode, &Node::set_pause_mode)
        .doc("Whether the node runs while the tree is paused.")
        .enumeration("Inherit,Stop,Process")
        .default_value(0);
    c.property("process_priority", &Node::process_priority, &Node::set_process_priority)
        .doc("Order of processing: lower runs first.")
        .default_value(0);
    c.signal("ready", {}, "The node and its children are inside the tree, for the first time.")
        .signal("renamed", {}, "The name changed.")
        .signal("tree_entered", {}, "The node entered a tree; its children have not yet.")
        .signal("tree_exiting", {}, "The node is about to leave its tree; its children have left.")
        .signal("tree_exited", {}, "The node has left its tree.");
    c.method("queue_free", &Node::queue_free, "Destroys the node at the end of the step.");
}

void ScriptInstance::bind(ClassBuilder<ScriptInstance>& c) {
    c.doc("Behaviour attached to a node.");
}

Node::Node() = default;

Node::~Node() {
    CL_ASSERT(!tree_, "a node destroyed inside its tree: only its parent or queue_free() may take it out");
    while (!children_.empty()) {
        children_.pop_back();
    }
}

void Node::set_name(std::string_view name) {
    std::string clean;
    std::copy_if(name.begin(), name.end(), std::back_inserter(clean),
                 [](char c) { return std::string_view(".:@/\"").find(c) == std::string_view::npos; });
    if (clean.empty()) {
        return;
    }
    name_ = parent_ ? parent_->unique_child_name(StringName(clean), *this) : StringName(clean);
    emit_signal(signals().renamed);
}

bool Node::is_ancestor_of(const Node& other) const noexcept {
    for (const Node* n = other.parent_; n; n = n->parent_) {
        if (n == this) {
            return true;
        }
    }
    return false;
}

bool Node::is_before(const Node& other) const noexcept {
    const auto depth = [](const Node* n) {
        int d = 0;
        for (; n->parent_; n = n->parent_) {
            ++d;
        }
        return d;
    };
    const Node* a = this;
    const Node* b = &other;
    const int depth_a = depth(a);
    const int depth_b = depth(b);
    for (int d = depth_a; d > depth_b; --d) {
        a = a->parent_;
    }
    for (int d = depth_b; d > depth_a; --d) {
        b = b->parent_;
    }
    if (a == b) {
        return depth_a < depth_b; // one is an ancestor of the other
    }
    while (a->parent_ != b->parent_) {
        a = a->parent_;
        b = b->parent_;
    }
    return a->index_ < b->index_;
}

Status Node::check_new_child(const Node* child) const {
    if (!child) {
        return refused("expected a node to add, found null");
    }
    if (locks_ > 0) {
        return refused("node '" + name_.str() + "' is notifying its children: defer adding '" +
                       child->name_.str() + "'");
    }
    int depth = 1;
    for (const Node* n = this; n; n = n->parent_, ++depth) {
        if (n == child) {
            return refused("expected a node that is no ancestor of '" + name_.str() + "', found '" +
                           child->name_.str() + "'");
        }
    }
    if (depth > kMaxDepth) {
        return refused("expected at most " + std::to_string(kMaxDepth) + " levels of nodes below each other");
    }
    return {};
}

Status Node::add_child(std::unique_ptr<Node>&& child, Naming naming) {
    if (Status status = check_new_child(child.get()); !status) {
        return status;
    }
    Node& added = *child;
    if (naming == Naming::MakeUnique) {
        added.name_ = unique_child_name(added.name_, added);
    }
    added.parent_ = this;
    added.index_ = children_.size();
    children_.push_back(std::move(child));

    // Until the child is ready this node keeps it: its notifications must not take it away under their feet.
    const ChildrenLock lock(*this);
    added.notify(Notification::Parented);
    if (tree_) {
        added.enter_tree(*tree_);
        added.make_ready();
    }
    return {};
}

Expected<std::unique_ptr<Node>> Node::remove_child(Node& child) {
    if (child.parent_ != this) {
        return refused("expected a child of '" + name_.str() + "', found '" + child.name_.str() + "'");
    }
    if (locks_ > 0) {
        return refused("node '" + name_.str() + "' is notifying its children: defer removing '" +
                       child.name_.str() + "'");
    }
    {
        const ChildrenLock lock(*this);
        if (tree_) {
            child.exit_tree();
        }
    }
    const size_t place = child.index_;
    std::unique_ptr<Node> removed = std::move(children_[place]);
    children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(place));
    renumber_children(place);
    removed->parent_ = nullptr;
    removed->index_ = 0;
    removed->forget_owners_outside();
    removed->notify(Notification::Unparented);
    return removed;
}

Status Node::move_child(Node& child, size_t index) {
    if (child.parent_ != this) {
        return refused("expected a child of '" + name_.str() + "', found '" + child.name_.str() + "'");
    }
    if (locks_ > 0) {
        return refused("node '" + name_.str() + "' is notifying its children: defer moving '" +
                       child.name_.str() + "'");
    }
    const size_t from = child.index_;
    const size_t to = std::min(index, children_.size() - 1);
    if (from == to) {
        return {};
    }
    const auto at = [this](size_t i) { return children_.begin() + static_cast<std::ptrdiff_t>(i); };
    if (from < to) {
        std::rotate(at(from), at(from + 1), at(to + 1));
    } else {
        std::rotate(at(to), at(from), at(from + 1));
    }
    renumber_children(std::min(from, to));
    if (tree_) {
        tree_->order_changed();
    }
    child.notify(Notification::MovedInParent);
    return {};
}

void Node::renumber_children(size_t from) noexcept {
    for (size_t i = from; i < children_.size(); ++i) {
        children_[i]->index_ = i;
    }
}

StringName Node::unique_child_name(const StringName& wanted, const Node& child) const {
    const StringName base = wanted.empty() ? child.class_name() : wanted;
    const auto is_taken_by = [&](const std::unique_ptr<Node>& c) {
        return c.get() != &child && c->name_ == base;
    };
    if (std::none_of(children_.begin(), children_.end(), is_taken_by)) {
        return base;
    }
    std::string_view stem = base.view();
    while (stem.size() > 1 && stem.back() >= '0' && stem.back() <= '9') {
        stem.remove_suffix(1);
    }
    uint64_t last = 1;
    for (const std::unique_ptr<Node>& c : children_) {
        last = std::max(last, number_after_stem(c->name_.view(), stem));
    }
    return StringName(std::string(stem) + std::to_string(last + 1));
}

Status Node::set_owner(Node* owner) {
    if (owner && !owner->is_ancestor_of(*this)) {
        return refused("expected an ancestor of '" + name_.str() + "' as its owner, found '" +
                       owner->name_.str() + "'");
    }
    owner_ = owner;
    return {};
}

void Node::forget_owners_outside() {
    for_each_in_subtree([](Node& n) {
        if (n.owner_ && !n.owner_->is_ancestor_of(n)) {
            n.owner_ = nullptr;
        }
    });
}

void Node::enter_tree(SceneTree& tree) {
    tree_ = &tree;
    tree.node_entered(*this);
    notify(Notification::EnterTree);
    emit_signal(signals().tree_entered);
    const ChildrenLock lock(*this);
    for (const std::unique_ptr<Node>& child : children_) {
        if (!child->tree_) { // one that the notification added has entered already
            child->enter_tree(tree);
        }
    }
}

void Node::make_ready() {
    {
        const ChildrenLock lock(*this);
        for (const std::unique_ptr<Node>& child : children_) {
            child->make_ready();
        }
    }
    if (!ready_) {
        ready_ = true;
        notify(Notification::Ready);
        emit_signal(signals().ready);
    }
}

void Node::exit_tree() {
    const ChildrenLock lock(*this);
    for (auto child = children_.rbegin(); child != children_.rend(); ++child) {
        (*child)->exit_tree();
    }
    emit_signal(signals().tree_exiting);
    notify(Notification::ExitTree);
    tree_->node_exited(*this);
    tree_ = nullptr;
    emit_signal(signals().tree_exited);
}

void Node::queue_free() {
    if (queued_for_deletion_) {
        return;
    }
    if (tree_) {
        queued_for_deletion_ = true;
        tree_->queue_free(*this);
    } else if (parent_) {
        static_cast<void>(parent_->remove_child(*this)); // and destroy it
    }
}

} // namespace cl::scene
