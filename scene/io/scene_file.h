#pragma once

#include "core/expected.h"
#include "core/variant/variant_parser.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cl::scene {

// A text scene or resource as its file says it (spec tscn): nothing looked up, nothing made. References to
// resources are ResourceLinks in the values. `where` and `tag_text` are empty in parts that did not come from
// a file; a `tag_text` is written back as it is, so it is emptied when a field of its tag changes; so is the
// `raw` of a value.

using Assignments = std::vector<TextAssignment>;

struct ExtEntry {
    int64_t id = 0;
    std::string type;
    std::string path;
    std::string tag_text;
    SourceLocation where;
};

struct SubEntry {
    int64_t id = 0;
    std::string type;
    Assignments properties;
    std::string tag_text;
    SourceLocation where;
};

struct NodeEntry {
    std::string name;
    std::string type;                  ///< empty: an override, or an instance
    std::optional<std::string> parent; ///< none: the root
    std::string owner;
    std::optional<int64_t> index;
    std::vector<std::string> groups;
    Variant instance; ///< a ResourceLink, or Nil
    std::string instance_placeholder;
    Assignments properties;
    std::string tag_text;
    SourceLocation where;

    /// Path from the root: ".", "./A", "./A/B".
    [[nodiscard]] std::string path() const;
};

struct ConnectionEntry {
    std::string signal, from, to, method;
    int64_t flags = 2;
    Array binds;
    std::string tag_text;
    SourceLocation where;
};

struct EditableEntry {
    std::string path;
    std::string tag_text;
    SourceLocation where;
};

struct SceneFile {
    enum class Kind { Scene, Resource };

    std::string name; ///< of the file, as messages give it
    /// What the `raw` of the assignments points into; null where no value keeps its spelling.
    std::shared_ptr<const std::string> text;
    Kind kind = Kind::Scene;
    std::string resource_type; ///< of a resource file
    std::string heading_text;  ///< as tag_text, for the first tag
    SourceLocation where;

    std::vector<ExtEntry> ext_resources;
    std::vector<SubEntry> sub_resources;
    Assignments resource; ///< of a resource file
    std::vector<NodeEntry> nodes;
    std::vector<ConnectionEntry> connections;
    std::vector<EditableEntry> editables;

    [[nodiscard]] const ExtEntry* find_ext(int64_t id) const noexcept;
    [[nodiscard]] const SubEntry* find_sub(int64_t id) const noexcept;
};

/// The assignment to `key` that counts (the last), or nullptr.
[[nodiscard]] const TextAssignment* find_assignment(const Assignments& assignments,
                                                    std::string_view key) noexcept;

} // namespace cl::scene
