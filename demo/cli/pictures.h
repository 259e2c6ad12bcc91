#pragma once

#include "scene/main/scene_tree.h"

#include "core/expected.h"

#include <filesystem>
#include <vector>

namespace cl::demo {

/// Nothing is drawn for a picture that could not be written anyway. @return Unsupported unless all names end
/// in .png or .exr.
[[nodiscard]] Status check_outputs(const std::vector<std::filesystem::path>& outputs);

/// Writes what the tree last drew: as shown (.png), as linear radiance (.exr).
[[nodiscard]] Status save_pictures(scene::SceneTree& tree, const std::vector<std::filesystem::path>& outputs);

} // namespace cl::demo
