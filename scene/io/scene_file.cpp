#include "scene/io/scene_file.h"

#include <algorithm>

namespace cl::scene {

std::string NodeEntry::path() const {
    if (!parent) {
        return ".";
    }
    std::string_view from_root = *parent;
    if (from_root.substr(0, 2) == "./") {
        from_root.remove_prefix(2);
    }
    return from_root == "." ? "./" + name : "./" + std::string(from_root) + "/" + name;
}

const ExtEntry* SceneFile::find_ext(int64_t id) const noexcept {
    const auto found = std::find_if(ext_resources.begin(), ext_resources.end(),
                                    [id](const ExtEntry& e) { return e.id == id; });
    return found != ext_resources.end() ? &*found : nullptr;
}

const SubEntry* SceneFile::find_sub(int64_t id) const noexcept {
    const auto found = std::find_if(sub_resources.begin(), sub_resources.end(),
                                    [id](const SubEntry& s) { return s.id == id; });
    return found != sub_resources.end() ? &*found : nullptr;
}

const TextAssignment* find_assignment(const Assignments& assignments, std::string_view key) noexcept {
    const auto found = std::find_if(assignments.rbegin(), assignments.rend(),
                                    [key](const TextAssignment& a) { return a.key == key; });
    return found != assignments.rend() ? &*found : nullptr;
}

} // namespace cl::scene
