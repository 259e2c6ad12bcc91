#pragma once

#include "scene/main/notification.h"

#include "core/object/object.h"

namespace cl {
template <typename T>
class ClassBuilder;
}

namespace cl::scene {

class Node;

/// Behaviour attached to one node: a C++ class in the place of a script. Register it with ScriptInstance as
/// its base to give it properties, which the node then gets and sets by name as if they were its own:
///     registry.add<Swing, ScriptInstance>();
///     lamp.set_script_instance(std::make_unique<Swing>());
///     lamp.set("amplitude_deg", 30.0);
/// The functions may change the tree, but must not destroy their own node: call node.queue_free() for that.
class ScriptInstance : public Object {
public:
    static constexpr std::string_view kClassName = "ScriptInstance";
    static void bind(ClassBuilder<ScriptInstance>& c);

    /// Once, when the node and all its children are inside the tree.
    virtual void ready(Node& /*node*/) {}
    /// Each step while the node may process. @param delta_s  time since the last step [s]
    virtual void process(Node& /*node*/, double /*delta_s*/) {}
    /// Everything, Ready and Process included (before the two functions above).
    virtual void notification(Node& /*node*/, Notification /*what*/) {}
};

} // namespace cl::scene
