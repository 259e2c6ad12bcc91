#pragma once

#include "scene/main/node.h"
#include "scene/register_types.h"

#include "core/object/class_registry.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cl::tests {

/// Registers the scene's classes: the first line of every test that makes a node.
inline void register_types() {
    scene::register_scene_types(ClassRegistry::instance());
}

/// What happened, in order, as words for CHECK().
using Journal = std::vector<std::string>;

inline const char* name_of(scene::Notification what) {
    constexpr const char* kNames[] = {"parented", "unparented", "moved",     "enter",
                                      "ready",    "process",    "exit",      "paused",
                                      "resumed",  "transform",  "visibility"};
    return kNames[static_cast<size_t>(what)];
}

/// Writes "<event> <node>" into a journal for the notifications that it is asked for.
class JournalScript final : public scene::ScriptInstance {
public:
    JournalScript(Journal& journal, std::vector<scene::Notification> wanted)
        : journal_(journal), wanted_(std::move(wanted)) {}
    void notification(scene::Node& node, scene::Notification what) override {
        for (scene::Notification w : wanted_) {
            if (w == what) {
                journal_.push_back(std::string(name_of(what)) + " " + node.name().str());
            }
        }
    }

private:
    Journal& journal_;
    std::vector<scene::Notification> wanted_;
};

} // namespace cl::tests
