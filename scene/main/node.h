#pragma once

#include "scene/main/notification.h"
#include "scene/main/script_instance.h"

#include "core/expected.h"
#include "core/node_path.h"
#include "core/object/object.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cl {
template <typename T>
class ClassBuilder;
}

namespace cl::scene {

class SceneTree;

enum class PauseMode : uint8_t { Inherit, Stop, Process };

/// What add_child() does about a name that a sibling already has.
enum class Naming : uint8_t {
    MakeUnique, ///< a number is put after it: Lamp, Lamp2, Lamp3
    Keep,       ///< kept as it is, as loading a scene file does; paths then find the first of that name
};

/// Whether saving a scene writes a node's membership of a group.
enum class GroupSaving : uint8_t { NotSaved, Saved };

/// One element of the scene tree: a name, a parent, children that it owns in order, groups, maybe a script.
/// Changes its children only outside of their notifications: while a node is telling its children that they
/// enter, leave or are ready, adding to and removing from it is refused; defer such changes.
class Node : public Object {
public:
    static constexpr std::string_view kClassName = "Node";
    static void bind(ClassBuilder<Node>& c);
    /// Deepest nesting that add_child() accepts: walking the tree recurses, and a file must not overflow the
    /// stack.
    static constexpr int kMaxDepth = 2000;

    Node();
    ~Node() override;
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    // --- name and place ------------------------------------------------------------------------------
    [[nodiscard]] const StringName& name() const noexcept { return name_; }
    /// Drops the characters . : @ / " and, below a parent, makes the name unique among its siblings.
    /// An empty name is refused.
    void set_name(std::string_view name);
    /// As a scene file says, unchecked.
    void set_name_verbatim(StringName name) { name_ = name; }

    [[nodiscard]] Node* parent() const noexcept { return parent_; }
    [[nodiscard]] const std::vector<std::unique_ptr<Node>>& children() const noexcept { return children_; }
    [[nodiscard]] size_t index() const noexcept { return index_; } ///< place among the siblings
    [[nodiscard]] bool is_ancestor_of(const Node& other) const noexcept;
    /// True if this node comes before `other` of the same tree, parents before children.
    [[nodiscard]] bool is_before(const Node& other) const noexcept;

    /// Takes `child` as the last child. On an error `child` stays with the caller.
    /// @return InvalidArgument if it is null, this node or an ancestor of it, or nested deeper than
    /// kMaxDepth,
    ///         or while this node is notifying its children.
    Status add_child(std::unique_ptr<Node>&& child, Naming naming = Naming::MakeUnique);
    /// Makes a T, names it and adds it as the last child.
    template <typename T = Node>
    T& add_new(std::string_view name);
    /// Gives `child` back to the caller, out of the tree. InvalidArgument if it is not a child of this node,
    /// or while this node is notifying its children.
    Expected<std::unique_ptr<Node>> remove_child(Node& child);
    /// Moves `child` to a place among its siblings; an index beyond the last means the last.
    Status move_child(Node& child, size_t index);

    /// The node at the end of a path, or nullptr: "A/B", "..", ".", or "/root/Main" inside a tree. A name
    /// that several children have means the first of them; a property after a colon is ignored.
    [[nodiscard]] Node* get_node(const NodePath& path) const;
    [[nodiscard]] Node* get_node(std::string_view path) const { return get_node(NodePath(path)); }
    /// get_node() if it is a T, else nullptr.
    template <typename T>
    [[nodiscard]] T* get_node_as(std::string_view path) const {
        return dynamic_cast<T*>(get_node(path));
    }
    /// "/root/Main/Lamp" inside a tree, else the names from the topmost ancestor down.
    [[nodiscard]] NodePath path() const;
    /// Relative path from here to `other`, which has an ancestor in common; an empty path if not.
    [[nodiscard]] NodePath path_to(const Node& other) const;

    /// The scene root that this node belongs to on saving; nullptr for such a root. Forgotten when the owner
    /// is no longer an ancestor.
    [[nodiscard]] Node* owner() const noexcept { return owner_; }
    /// InvalidArgument if `owner` is not an ancestor.
    Status set_owner(Node* owner);
    /// The scene file that this node is the root of ("res://a.tscn"), else empty.
    [[nodiscard]] const std::string& scene_file() const noexcept { return scene_file_; }
    void set_scene_file(std::string path) { scene_file_ = std::move(path); }

    // --- tree ----------------------------------------------------------------------------------------
    [[nodiscard]] SceneTree* tree() const noexcept { return tree_; }
    [[nodiscard]] bool is_inside_tree() const noexcept { return tree_ != nullptr; }
    [[nodiscard]] bool is_ready() const noexcept { return ready_; }
    /// Destroys this node at the end of the step; outside of a tree at once when it has a parent.
    /// A node without parent or tree belongs to its unique_ptr and is left alone.
    void queue_free();
    [[nodiscard]] bool is_queued_for_deletion() const noexcept { return queued_for_deletion_; }

    // --- groups --------------------------------------------------------------------------------------
    struct Group {
        StringName name;
        GroupSaving saving = GroupSaving::NotSaved;
    };
    void add_to_group(const StringName& group, GroupSaving saving = GroupSaving::NotSaved);
    void remove_from_group(const StringName& group);
    [[nodiscard]] bool is_in_group(const StringName& group) const noexcept;
    [[nodiscard]] const std::vector<Group>& groups() const noexcept { return groups_; }

    // --- processing ----------------------------------------------------------------------------------
    /// Off for a plain node. A script turns it on.
    void set_process(bool on);
    [[nodiscard]] bool is_processing() const noexcept { return processing_; }
    /// False where the tree is paused and this node is not to run then.
    [[nodiscard]] bool can_process() const noexcept;
    [[nodiscard]] PauseMode pause_mode() const noexcept { return pause_mode_; }
    SetResult set_pause_mode(PauseMode mode);
    [[nodiscard]] int process_priority() const noexcept { return process_priority_; }
    void set_process_priority(int priority);

    // --- behaviour -----------------------------------------------------------------------------------
    /// Attaches behaviour (or takes it off: nullptr). Its properties take the values that a scene file gave
    /// this node under the same names. If the node is ready, the script's ready() follows at once.
    void set_script_instance(std::unique_ptr<ScriptInstance> script);
    [[nodiscard]] ScriptInstance* script_instance() const noexcept { return script_.get(); }

    /// Calls a method of the script, else of the node. NotFound if neither has it.
    Expected<Variant> call_method(const StringName& method, std::span<const Variant> arguments = {});
    /// The same at the end of the step, if both node and tree are still there; outside of a tree at once.
    void call_deferred(const StringName& method, std::vector<Variant> arguments = {});
    /// Calls `method` of `target` with the signal's arguments and then `binds`, as long as `target` lives.
    /// NotFound if this class has no such signal. The method is looked up when the signal comes.
    Status connect_method(const StringName& signal, Node& target, const StringName& method,
                          ConnectFlags flags = ConnectFlags::None, std::vector<Variant> binds = {});

    /// A copy of this node and its children: stored properties, groups, names and scripts (registered scripts
    /// alone), but not its connections. Owners within the copied subtree are kept.
    /// nullptr if the class is not registered.
    [[nodiscard]] std::unique_ptr<Node> duplicate() const;

    /// Calls `visit` for this node and all below it, parents before children. Must not change the tree.
    template <typename Visit>
    void for_each_in_subtree(Visit&& visit) {
        visit(*this);
        for (const std::unique_ptr<Node>& child : children_) {
            child->for_each_in_subtree(visit);
        }
    }

protected:
    /// Override to hear of a node's life, and call the base class's first (last on ExitTree and Unparented).
    virtual void notification(Notification what);
    /// Copies what properties do not say; called by duplicate() on the fresh copy.
    virtual void copy_state_from(const Node& original);
    /// Sends a notification to the node, then to its script.
    void notify(Notification what);

    SetResult set_dynamic(const StringName& property, const Variant& value) override;
    bool get_dynamic(const StringName& property, Variant& value) const override;

    /// While it lives, `node` refuses to add or remove children: somebody walks them.
    class ChildrenLock {
    public:
        explicit ChildrenLock(Node& node) noexcept : node_(node) { ++node_.locks_; }
        ~ChildrenLock() { --node_.locks_; }
        ChildrenLock(const ChildrenLock&) = delete;
        ChildrenLock& operator=(const ChildrenLock&) = delete;

    private:
        Node& node_;
    };

private:
    friend class SceneTree;

    [[nodiscard]] Status check_new_child(const Node* child) const;
    [[nodiscard]] StringName unique_child_name(const StringName& wanted, const Node& child) const;
    [[nodiscard]] Node* find_child(const StringName& name) const noexcept;
    void renumber_children(size_t from) noexcept;
    void enter_tree(SceneTree& tree);
    void make_ready();
    void exit_tree();
    void forget_owners_outside();
    [[nodiscard]] std::unique_ptr<Node> duplicate_alone() const;

    StringName name_;
    Node* parent_ = nullptr;
    size_t index_ = 0;
    std::vector<std::unique_ptr<Node>> children_;
    Node* owner_ = nullptr;
    SceneTree* tree_ = nullptr;
    std::string scene_file_;
    std::vector<Group> groups_;
    std::unique_ptr<ScriptInstance> script_;
    NodePath import_path_; // `_import_path` of files: kept for saving, without meaning here
    int process_priority_ = 0;
    int locks_ = 0; // > 0 while somebody walks children_
    PauseMode pause_mode_ = PauseMode::Inherit;
    bool processing_ = false;
    bool ready_ = false;
    bool queued_for_deletion_ = false;
};

template <typename T>
T& Node::add_new(std::string_view name) {
    auto child = std::make_unique<T>();
    T& added = *child;
    added.set_name(name);
    const Status status = add_child(std::move(child));
    CL_ASSERT(status.ok(), "add_new() while the node is notifying its children, or nested too deep");
    return added;
}

} // namespace cl::scene
