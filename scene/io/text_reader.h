#pragma once

#include "scene/io/scene_file.h"

#include "core/diagnostics.h"
#include "core/expected.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace cl::scene {

/// Whether values are written back as the file spelled them (old node paths, numbers with all their digits),
/// at the price of keeping its text; else as Godot 3.2.3 spells them.
enum class Spelling { Forgotten, Kept };

/// Reads a text scene or resource into its syntax tree: the grammar, required fields, and references that are
/// defined before their use (spec tscn sections 1 and 8). Nothing is looked up in the file system.
/// @param name  of the file in messages
/// @return the first error with its place: ParseError for what the format does not allow, Unsupported for a
/// newer
///         format.
[[nodiscard]] Expected<SceneFile> parse_scene_text(std::string_view text, const std::string& name,
                                                   Diagnostics& diagnostics,
                                                   Spelling spelling = Spelling::Forgotten);

/// The same for a file. Unsupported for Godot's binary formats; NotFound and IoError as read_text_file()
/// says.
[[nodiscard]] Expected<SceneFile> read_scene_file(const std::filesystem::path& file, Diagnostics& diagnostics,
                                                  Spelling spelling = Spelling::Forgotten);

} // namespace cl::scene
