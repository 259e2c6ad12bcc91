#pragma once

#include "scene/io/resource_loader.h"
#include "scene/io/scene_file.h"

#include "core/diagnostics.h"
#include "core/expected.h"

#include <string>

namespace cl::scene {

class Node;

struct PackOptions {
    std::string path; ///< "res://..." the scene is saved under; may be empty
    const SceneFile* original =
        nullptr; ///< the file that the tree was made from: ids, connections, base scene
};

/// The tree below `root` as a scene file: the root and the nodes that it owns, and what was changed in scenes
/// that are instanced in it (spec tscn sections 6 and 7).
/// @param loader  loads those scenes again, to find what was changed
/// @return the error of such a scene. Connections come from the original alone: a node does not list its own.
[[nodiscard]] Expected<SceneFile> pack_scene(const Node& root, ResourceLoader& loader,
                                             Diagnostics& diagnostics, const PackOptions& options = {});

} // namespace cl::scene
