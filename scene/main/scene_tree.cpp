#include "scene/main/scene_tree.h"

#include "scene/3d/world.h"

#include "servers/visual_server.h"

#include "core/object/class_registry.h"

#include <algorithm>
#include <iterator>
#include <unordered_set>
#include <utility>

namespace cl::scene {

namespace {

Node* alive(const std::weak_ptr<Object*>& handle) {
    const std::shared_ptr<Object*> object = handle.lock();
    return object ? static_cast<Node*>(*object) : nullptr;
}

} // namespace

SceneTree::SceneTree() : world_(std::make_unique<World>()), root_(std::make_unique<Node>()) {
    root_->set_name("root");
    root_->enter_tree(*this);
    root_->make_ready();
}

SceneTree::SceneTree(VisualServer& server, const ViewportOptions& viewport) : SceneTree() {
    server_ = &server;
    world_ = std::make_unique<World>(server, viewport);
}

SceneTree::SceneTree(std::unique_ptr<VisualServer> server, const ViewportOptions& viewport)
    : SceneTree(*server, viewport) {
    owned_server_ = std::move(server);
}

SceneTree::~SceneTree() {
    root_->exit_tree();
    deferred_.clear();
    root_.reset();
}

Node* SceneTree::scene() const {
    return alive(scene_);
}

Status SceneTree::set_scene(std::unique_ptr<Node>&& scene) {
    if (Node* old = this->scene()) {
        Expected<std::unique_ptr<Node>> removed = root_->remove_child(*old);
        if (!removed) {
            return removed.error();
        }
    }
    Node* added = scene.get();
    if (Status status = root_->add_child(std::move(scene)); !status) {
        return status;
    }
    scene_ = added->handle();
    return {};
}

void SceneTree::step(double delta_s) {
    delta_s_ = delta_s;
    time_s_ += delta_s;
    ++step_count_;
    process_nodes();
    run_deferred();
    world_->flush_transforms();
    free_queued();
}

void SceneTree::process_nodes() {
    if (processing_.empty()) {
        return;
    }
    NodeSnapshot(processing_.in_process_order(order_version_)).visit_alive([this](Node& node) {
        if (node.tree() == this && node.is_processing() && node.can_process()) {
            node.notify(Notification::Process);
        }
    });
}

void SceneTree::run_deferred() {
    const std::vector<std::function<void()>> calls = std::exchange(deferred_, {});
    for (const std::function<void()>& call : calls) {
        call();
    }
}

void SceneTree::free_queued() {
    for (const std::weak_ptr<Object*>& handle : std::exchange(to_free_, {})) {
        Node* node = alive(handle);
        if (!node) {
            continue; // gone with an ancestor, or by its owner
        }
        node->queued_for_deletion_ = false;
        if (Node* parent = node->parent()) {
            static_cast<void>(parent->remove_child(*node)); // and destroy it
        }
    }
}

void SceneTree::defer(std::function<void()> f) {
    deferred_.push_back(std::move(f));
}

Status SceneTree::draw() {
    if (!server_) {
        return Error{ErrorCode::Unsupported, "expected a tree with a VisualServer to draw it", {}};
    }
    world_->flush_transforms();
    return server_->draw();
}

bool SceneTree::has_changed() {
    if (!server_) {
        return false;
    }
    world_->flush_transforms();
    return server_->has_changed();
}

Status SceneTree::draw_settled() {
    if (server_) {
        world_->flush_transforms();
        server_->settle();
    }
    return draw();
}

void SceneTree::set_paused(bool paused) {
    if (paused_ == paused) {
        return;
    }
    std::vector<Node*> before;
    root_->for_each_in_subtree([&](Node& n) {
        if (n.can_process()) {
            before.push_back(&n);
        }
    });
    paused_ = paused;
    std::vector<Node*> changed;
    if (paused) {
        std::copy_if(before.begin(), before.end(), std::back_inserter(changed),
                     [](const Node* n) { return !n->can_process(); });
    } else {
        const std::unordered_set<Node*> ran(before.begin(), before.end());
        root_->for_each_in_subtree([&](Node& n) {
            if (ran.count(&n) == 0) {
                changed.push_back(&n);
            }
        });
    }
    NodeSnapshot(changed).visit_alive(
        [paused](Node& n) { n.notify(paused ? Notification::Paused : Notification::Unpaused); });
}

std::vector<Node*> SceneTree::nodes_in_group(const StringName& group) {
    const auto found = groups_.find(group);
    return found == groups_.end() ? std::vector<Node*>() : found->second.in_tree_order(order_version_);
}

void SceneTree::call_group(const StringName& group, const StringName& method,
                           std::span<const Variant> arguments) {
    NodeSnapshot(nodes_in_group(group)).visit_alive([&](Node& node) {
        static_cast<void>(node.call_method(method, arguments)); // a node without the method is left out
    });
}

void SceneTree::node_entered(Node& node) {
    for (const Node::Group& group : node.groups()) {
        groups_[group.name].insert(node);
    }
    processing_changed(node);
    order_changed();
}

void SceneTree::node_exited(Node& node) {
    for (const Node::Group& group : node.groups()) {
        group_exited(group.name, node);
    }
    processing_.erase(node);
}

void SceneTree::group_exited(const StringName& group, Node& node) {
    const auto found = groups_.find(group);
    if (found == groups_.end()) {
        return;
    }
    found->second.erase(node);
    if (found->second.empty()) {
        groups_.erase(found);
    }
}

void SceneTree::processing_changed(Node& node) {
    if (node.is_processing()) {
        processing_.insert(node);
    } else {
        processing_.erase(node);
    }
}

} // namespace cl::scene
