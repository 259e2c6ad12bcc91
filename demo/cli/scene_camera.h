#pragma once

#include "demo/cli/options.h"

#include "scene/main/scene_tree.h"

#include "core/expected.h"

namespace cl::demo {

/// Makes the camera of `options` current: that of `--camera`, else the scene's current one, else one that
/// frames the scene. @param root  the scene, which is in the tree
/// @return NotFound if `--camera` names no camera.
[[nodiscard]] Status choose_camera(scene::SceneTree& tree, scene::Node& root, const Options& options);

} // namespace cl::demo
