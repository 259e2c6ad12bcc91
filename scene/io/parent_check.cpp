#include "scene/io/parent_check.h"

#include "core/node_path.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace cl::scene {

namespace {

enum class Contents {
    Listed,   ///< all nodes below are in this file
    Instance, ///< more may come with an instanced scene
};

/// The nodes above a line, by their paths from the root: "", "A", "A/B".
class NodesAbove {
public:
    void add(const NodeEntry& entry) {
        const std::string& name = entry.name.empty() ? entry.type : entry.name;
        const std::string parent = entry.parent ? joined(*entry.parent) : std::string();
        const std::string path = !entry.parent ? std::string() : parent.empty() ? name : parent + '/' + name;
        nodes_.emplace(path, entry.type.empty() ? Contents::Instance : Contents::Listed);
    }

    [[nodiscard]] bool may_hold(const std::string& parent) const {
        if (parent.empty() || parent.front() == '/') {
            return false;
        }
        std::string path = joined(parent);
        if (path.find("..") != std::string::npos || nodes_.count(path) > 0) {
            return true; // where ".." leads to, only the tree can tell
        }
        while (!path.empty()) {
            const size_t slash = path.rfind('/');
            path.resize(slash == std::string::npos ? 0 : slash);
            const auto above = nodes_.find(path);
            if (above != nodes_.end() && above->second == Contents::Instance) {
                return true;
            }
        }
        return false;
    }

private:
    /// "." and "./A//B" as "" and "A/B".
    static std::string joined(const std::string& path) {
        const NodePath names(path);
        std::string text;
        for (const StringName& name : names.names()) {
            if (name.view() != ".") {
                text += text.empty() ? "" : "/";
                text += name.view();
            }
        }
        return text;
    }

    std::unordered_map<std::string, Contents> nodes_;
};

} // namespace

Status check_parents(const SceneFile& file) {
    NodesAbove above;
    for (const NodeEntry& entry : file.nodes) {
        if (entry.parent && !above.may_hold(*entry.parent)) {
            return Error{
                ErrorCode::ParseError,
                fmt::format("expected the path of a node above as \"parent\", found \"{}\"", *entry.parent),
                entry.where};
        }
        above.add(entry);
    }
    return {};
}

} // namespace cl::scene
