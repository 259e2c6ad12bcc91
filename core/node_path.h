#pragma once

#include "core/string_name.h"

#include <string>
#include <string_view>
#include <vector>

namespace cl {

/// A path to a node and, after a colon, to a property of it: "A/B:prop:sub", "../C", "/root/Main", ".".
class NodePath {
public:
    NodePath() = default;
    explicit NodePath(std::string_view text);

    [[nodiscard]] bool is_absolute() const noexcept { return absolute_; }
    [[nodiscard]] bool is_empty() const noexcept { return names_.empty() && subnames_.empty() && !absolute_; }
    /// The node names between slashes; "." and ".." are kept as names.
    [[nodiscard]] const std::vector<StringName>& names() const noexcept { return names_; }
    [[nodiscard]] const std::vector<StringName>& subnames() const noexcept { return subnames_; }
    /// As Godot prints it (what the text was, normalised: no empty names).
    [[nodiscard]] std::string to_string() const;
    friend bool operator==(const NodePath&, const NodePath&) = default;

private:
    std::vector<StringName> names_;
    std::vector<StringName> subnames_;
    bool absolute_ = false;
};

} // namespace cl
