// What a node does: notifications, its script, groups, processing, calls by name.
#include "scene/main/node.h"
#include "scene/main/scene_tree.h"

#include "core/io/log.h"
#include "core/object/class_registry.h"

#include <algorithm>

namespace cl::scene {

void Node::notification(Notification /*what*/) {}

void Node::notify(Notification what) {
    // On the way out the script goes first: it still finds the node as it was.
    const bool leaving = what == Notification::ExitTree || what == Notification::Unparented;
    if (!leaving) {
        notification(what);
    }
    if (ScriptInstance* script = script_.get()) {
        script->notification(*this, what);
        if (what == Notification::Ready) {
            script->ready(*this);
        } else if (what == Notification::Process && tree_) {
            script->process(*this, tree_->delta_s());
        }
    }
    if (leaving) {
        notification(what);
    }
}

void Node::set_script_instance(std::unique_ptr<ScriptInstance> script) {
    if (script_ && tree_) {
        // It may be the old script that asks: it lives until the step is over.
        tree_->defer([old = std::shared_ptr<ScriptInstance>(std::move(script_))] {});
    }
    script_ = std::move(script);
    if (!script_) {
        return;
    }
    for (const PropertyValue& p : extra_properties()) {
        if (script_->has_property(p.name)) {
            script_->set(p.name, p.value);
        }
    }
    set_process(true);
    if (ready_ && tree_) {
        script_->notification(*this, Notification::Ready);
        script_->ready(*this);
    }
}

SetResult Node::set_dynamic(const StringName& property, const Variant& value) {
    if (script_ && script_->has_property(property)) {
        return script_->set(property, value);
    }
    return Object::set_dynamic(property, value);
}

bool Node::get_dynamic(const StringName& property, Variant& value) const {
    if (script_ && script_->has_property(property)) {
        value = script_->get(property);
        return true;
    }
    return Object::get_dynamic(property, value);
}

void Node::add_to_group(const StringName& group, GroupSaving saving) {
    if (is_in_group(group)) {
        return;
    }
    groups_.push_back({group, saving});
    if (tree_) {
        tree_->group_entered(group, *this);
    }
}

void Node::remove_from_group(const StringName& group) {
    const auto found =
        std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.name == group; });
    if (found == groups_.end()) {
        return;
    }
    groups_.erase(found);
    if (tree_) {
        tree_->group_exited(group, *this);
    }
}

bool Node::is_in_group(const StringName& group) const noexcept {
    return std::any_of(groups_.begin(), groups_.end(), [&](const Group& g) { return g.name == group; });
}

void Node::set_process(bool on) {
    if (processing_ == on) {
        return;
    }
    processing_ = on;
    if (tree_) {
        tree_->processing_changed(*this);
    }
}

SetResult Node::set_pause_mode(PauseMode mode) {
    if (mode > PauseMode::Process) {
        return SetResult::Refused;
    }
    pause_mode_ = mode;
    return SetResult::Done;
}

void Node::set_process_priority(int priority) {
    process_priority_ = priority;
    if (tree_) {
        tree_->order_changed();
    }
}

bool Node::can_process() const noexcept {
    if (!tree_) {
        return false;
    }
    if (!tree_->is_paused()) {
        return true;
    }
    for (const Node* n = this; n; n = n->parent_) {
        if (n->pause_mode_ != PauseMode::Inherit) {
            return n->pause_mode_ == PauseMode::Process;
        }
    }
    return false;
}

Expected<Variant> Node::call_method(const StringName& method, std::span<const Variant> arguments) {
    if (script_ && script_->class_info().find_method(method)) {
        return script_->call(method, arguments);
    }
    return call(method, arguments);
}

namespace {

/// Calls a method and says so when it fails: nobody waits for the answer. A node whose file names a script in
/// another language may well lack that script's methods.
void call_and_report(Node& node, const StringName& method, std::span<const Variant> arguments) {
    static const StringName kScript("script");
    const Expected<Variant> result = node.call_method(method, arguments);
    if (!result) {
        const LogLevel level = node.get(kScript).is_nil() ? LogLevel::Warning : LogLevel::Debug;
        log_message(level, "node '" + node.name().str() + "': " + result.error().message);
    }
}

/// nullptr once the node is gone.
Node* alive(const std::weak_ptr<Object*>& handle) {
    const std::shared_ptr<Object*> object = handle.lock();
    return object && *object ? static_cast<Node*>(*object) : nullptr;
}

} // namespace

void Node::call_deferred(const StringName& method, std::vector<Variant> arguments) {
    if (!tree_) {
        call_and_report(*this, method, arguments);
        return;
    }
    tree_->defer([self = handle(), method, arguments = std::move(arguments)] {
        if (Node* node = alive(self)) {
            call_and_report(*node, method, arguments);
        }
    });
}

Status Node::connect_method(const StringName& signal, Node& target, const StringName& method,
                            ConnectFlags flags, std::vector<Variant> binds) {
    const auto bits = static_cast<uint32_t>(flags);
    const bool deferred = (bits & static_cast<uint32_t>(ConnectFlags::Deferred)) != 0;
    const auto without_deferred =
        static_cast<ConnectFlags>(bits & ~static_cast<uint32_t>(ConnectFlags::Deferred));
    Slot slot = [weak = target.handle(), method, binds = std::move(binds),
                 deferred](std::span<const Variant> arguments) {
        Node* node = alive(weak);
        if (!node) {
            return;
        }
        std::vector<Variant> all(arguments.begin(), arguments.end());
        all.insert(all.end(), binds.begin(), binds.end());
        if (deferred) {
            node->call_deferred(method, std::move(all));
        } else {
            call_and_report(*node, method, all);
        }
    };
    const Expected<uint64_t> id = connect(signal, std::move(slot), without_deferred);
    return id ? Status() : Status(id.error());
}

} // namespace cl::scene
