#pragma once

#include "scene/io/scene_file.h"

#include "core/expected.h"
#include "core/variant/variant.h"

#include <filesystem>
#include <string>

namespace cl::scene {

/// A value as a scene file spells it, ResourceLinks included.
[[nodiscard]] std::string value_text(const Variant& value);

/// The file as Godot 3.2.3 lays it out (spec tscn section 7). Tags that were read and not changed, and
/// values that kept their spelling (Spelling::Kept), are written as they were, so that a file that is read
/// and written differs by white space alone.
[[nodiscard]] std::string scene_file_text(const SceneFile& file);

/// Writes scene_file_text() beside the target and renames it over.
[[nodiscard]] Status save_scene_file(const SceneFile& file, const std::filesystem::path& target);

} // namespace cl::scene
