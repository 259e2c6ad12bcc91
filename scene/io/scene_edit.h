#pragma once

#include "scene/io/scene_file.h"

#include "core/expected.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace cl::scene {

/// Sets a property of a node in a file to a resource file, and leaves everything else as it is: an
/// [ext_resource] is added or reused, one that is no longer used goes.
/// @param node_path  from the root: ".", "Room/Probe" or "./Room/Probe". A node that the file does not list,
/// because
///                   it comes with an instanced scene, gets an entry that overrides it.
void set_node_resource(SceneFile& file, std::string_view node_path, std::string_view property,
                       const std::string& resource_path, const std::string& resource_type);

/// Makes the scene file refer to a GI probe's data: `data = ExtResource( n )`. Writes nothing if it does
/// already.
/// @param data  the .tres file; named "res://..." if it lies in the scene's project
/// @return true if the scene was changed; the error of reading or writing it.
[[nodiscard]] Expected<bool> embed_probe_data(const std::filesystem::path& scene, std::string_view node_path,
                                              const std::filesystem::path& data);

} // namespace cl::scene
