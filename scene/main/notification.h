#pragma once

#include <cstdint>

namespace cl::scene {

/// What a node is told about its life. Order within one step of the tree:
///   add_child      Parented; then for each node of the subtree, parent before child: EnterTree; then, child
///                  before parent: Ready (once in a node's life)
///   each step      Process, by process_priority, then in tree order
///   remove_child   for each node of the subtree, last child first, child before parent: ExitTree; then
///   Unparented
/// TransformChanged and VisibilityChanged reach a Spatial while it is inside the tree.
enum class Notification : uint8_t {
    Parented,          ///< the node got a parent
    Unparented,        ///< the node lost its parent
    MovedInParent,     ///< move_child() gave it another place
    EnterTree,         ///< tree() is set; the parent has entered, the children have not
    Ready,             ///< the node and all its children are inside the tree
    Process,           ///< a step of SceneTree::step(): the time since the last is tree()->delta_s()
    ExitTree,          ///< the last moment with a tree(); the children have left it
    Paused,            ///< SceneTree::set_paused() stopped this node
    Unpaused,          ///< and let it go on
    TransformChanged,  ///< the global transform may have changed since it was last told; sent once a step
    VisibilityChanged, ///< is_visible_in_tree() may have changed
};

} // namespace cl::scene
