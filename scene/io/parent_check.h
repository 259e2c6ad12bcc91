#pragma once

#include "scene/io/scene_file.h"

#include "core/expected.h"

namespace cl::scene {

/// Whether every node of a scene file can have the parent that it names, without opening the files it refers
/// to: the parent stands above it, or may come with an instanced scene. No circle of parents passes.
/// @return the first ParseError, at the node's tag.
[[nodiscard]] Status check_parents(const SceneFile& file);

} // namespace cl::scene
