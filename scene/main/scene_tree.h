#pragma once

#include "scene/main/node.h"
#include "scene/main/node_set.h"

#include "core/expected.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

namespace cl {
class VisualServer;
}

namespace cl::scene {

class World;

/// Where the pictures of a tree go.
struct ViewportOptions {
    glm::ivec2 size{1024, 600}; ///< [pixels]
    bool to_window = false;     ///< true: the graphics context's window, false: an image read back by request
};

/// The nodes of a running program, and its clock. One step is: Process for all who want it, the calls that
/// were deferred, transforms told to the renderer, the nodes freed that asked for it. Drawing is up to the
/// caller. Without a VisualServer a tree can be loaded, run, baked and saved, but not drawn.
class SceneTree {
public:
    SceneTree();
    /// Borrows the server, which must outlive the tree and the resources that its nodes used.
    explicit SceneTree(VisualServer& server, const ViewportOptions& viewport = {});
    /// Owns the server, and destroys it after the nodes.
    explicit SceneTree(std::unique_ptr<VisualServer> server, const ViewportOptions& viewport = {});
    ~SceneTree();
    SceneTree(const SceneTree&) = delete;
    SceneTree& operator=(const SceneTree&) = delete;

    /// "/root", which is always there.
    [[nodiscard]] Node& root() noexcept { return *root_; }
    /// The root of the loaded scene, a child of root(); nullptr if there is none.
    [[nodiscard]] Node* scene() const;
    /// Puts a scene in the place of the one before, which is destroyed.
    Status set_scene(std::unique_ptr<Node>&& scene);
    /// What the 3D nodes share: scenario, viewport, current camera, environment.
    [[nodiscard]] World& world() noexcept { return *world_; }
    /// nullptr if the tree has none.
    [[nodiscard]] VisualServer* server() const noexcept { return server_; }

    // --- time ----------------------------------------------------------------------------------------
    /// @param delta_s  time since the last step [s]
    void step(double delta_s);
    [[nodiscard]] double delta_s() const noexcept { return delta_s_; } ///< of the step that runs or ran last
    [[nodiscard]] double time_s() const noexcept { return time_s_; }   ///< sum of the steps
    [[nodiscard]] uint64_t step_count() const noexcept { return step_count_; }
    void set_paused(bool paused);
    [[nodiscard]] bool is_paused() const noexcept { return paused_; }

    /// Calls `f` at the end of the step; what is deferred meanwhile waits for the end of the next one.
    void defer(std::function<void()> f);

    /// Tells the renderer what changed and draws one frame. Unsupported if the tree has no server.
    Status draw();
    /// False if draw() would show what it showed last (VisualServer::has_changed()).
    [[nodiscard]] bool has_changed();
    /// The same, but first lets every GI probe take in the light as it is now: what is drawn does not depend
    /// on the frames before.
    Status draw_settled();

    // --- groups --------------------------------------------------------------------------------------
    /// In tree order.
    [[nodiscard]] std::vector<Node*> nodes_in_group(const StringName& group);
    /// Calls a method of every node of a group, in tree order. Nodes without that method are left out.
    void call_group(const StringName& group, const StringName& method,
                    std::span<const Variant> arguments = {});

private:
    friend class Node;
    void node_entered(Node& node);
    void node_exited(Node& node);
    void group_entered(const StringName& group, Node& node) { groups_[group].insert(node); }
    void group_exited(const StringName& group, Node& node);
    void processing_changed(Node& node);
    void order_changed() noexcept { ++order_version_; }
    void queue_free(Node& node) { to_free_.push_back(node.handle()); }
    void process_nodes();
    void run_deferred();
    void free_queued();

    std::unique_ptr<VisualServer> owned_server_; // first: destroyed last
    VisualServer* server_ = nullptr;
    std::unique_ptr<World> world_;
    std::unique_ptr<Node> root_;
    std::weak_ptr<Object*> scene_;
    std::unordered_map<StringName, NodeSet> groups_;
    NodeSet processing_;
    std::vector<std::function<void()>> deferred_;
    std::vector<std::weak_ptr<Object*>> to_free_;
    uint64_t order_version_ = 0; // of processing priorities and places in the tree
    double delta_s_ = 0.0;
    double time_s_ = 0.0;
    uint64_t step_count_ = 0;
    bool paused_ = false;
};

} // namespace cl::scene
