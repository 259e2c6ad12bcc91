#include "scene/main/node.h"

#include "core/object/class_registry.h"

#include <typeinfo>
#include <unordered_map>

namespace cl::scene {

namespace {

template <typename T>
std::unique_ptr<T> create_like(const T& original) {
    const ClassInfo& info = original.class_info();
    std::unique_ptr<Object> copy = info.create ? info.create() : nullptr;
    T* typed = dynamic_cast<T*>(copy.get());
    if (!typed || typeid(*typed) != typeid(original)) {
        return nullptr; // not registered: what was found is a base class
    }
    static_cast<void>(copy.release());
    return std::unique_ptr<T>(typed);
}

void copy_properties(const Object& from, Object& to) {
    for (const Object::PropertyValue& p : from.stored_properties()) {
        to.set(p.name, p.value);
    }
}

} // namespace

std::unique_ptr<Node> Node::duplicate_alone() const {
    std::unique_ptr<Node> copy = create_like(*this);
    if (!copy) {
        return nullptr;
    }
    if (class_name() != class_info().name) {
        copy->set_declared_class(class_name());
    }
    copy->name_ = name_;
    copy->scene_file_ = scene_file_;
    copy_properties(*this, *copy);
    copy->copy_state_from(*this);
    copy->groups_ = groups_;
    copy->processing_ = processing_;
    if (script_) {
        if (std::unique_ptr<ScriptInstance> script = create_like(*script_)) {
            copy_properties(*script_, *script);
            copy->script_ = std::move(script);
        }
    }
    return copy;
}

void Node::copy_state_from(const Node& /*original*/) {}

std::unique_ptr<Node> Node::duplicate() const {
    std::unique_ptr<Node> top = duplicate_alone();
    if (!top) {
        return nullptr;
    }
    std::unordered_map<const Node*, Node*> copy_of{{this, top.get()}};
    std::vector<const Node*> to_do{this}; // parents before children, so that a copy's parent is there
    for (size_t i = 0; i < to_do.size(); ++i) {
        const Node& original = *to_do[i];
        Node& copy = *copy_of[&original];
        for (const std::unique_ptr<Node>& child : original.children_) {
            std::unique_ptr<Node> child_copy = child->duplicate_alone();
            if (!child_copy) {
                return nullptr;
            }
            Node* added = child_copy.get();
            if (!copy.add_child(std::move(child_copy), Naming::Keep)) {
                return nullptr;
            }
            copy_of[child.get()] = added;
            to_do.push_back(child.get());
        }
    }
    for (const Node* original : to_do) {
        const auto owner = copy_of.find(original->owner_);
        copy_of[original]->owner_ = owner == copy_of.end() ? nullptr : owner->second;
    }
    return top;
}

} // namespace cl::scene
