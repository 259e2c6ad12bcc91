#pragma once

#include "scene/io/inspect.h"
#include "scene/main/node.h"

#include <string>

namespace cl::demo {

/// What `inspect` prints of a file: for a person, and as JSON for machines. Both end with a newline.
[[nodiscard]] std::string inspection_text(const scene::Inspection& inspection);
[[nodiscard]] std::string inspection_json(const scene::Inspection& inspection);

/// What `inspect --tree` prints of a loaded scene: one line a node, indented; or the nodes as JSON.
[[nodiscard]] std::string tree_text(const scene::Node& root);
[[nodiscard]] std::string tree_json(const scene::Node& root);

} // namespace cl::demo
