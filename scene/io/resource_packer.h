#pragma once

#include "scene/io/scene_file.h"

#include "core/expected.h"
#include "core/object/resource.h"
#include "core/variant/variant.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace cl::scene {

/// Turns resources into the [ext_resource] and [sub_resource] entries of a file that is put together, and
/// values that hold them into values with links (spec tscn section 7). Ids that resources had in that file
/// are kept.
class ResourcePacker {
public:
    /// @param file      receives the entries
    /// @param path      "res://..." of that file: its own sub resources are known by it; may be empty
    /// @param original  the file as it was read, for the ids of its ext resources; may be null
    ResourcePacker(SceneFile& file, std::string path, const SceneFile* original = nullptr);

    /// The value with every resource in it replaced by a link. A resource that contains itself becomes null
    /// there.
    [[nodiscard]] Variant pack(const Variant& value);
    /// The assignments that saving an object writes.
    [[nodiscard]] Assignments pack_properties(const std::vector<Object::PropertyValue>& properties);
    /// Link to a file of a class.
    [[nodiscard]] Variant link_to_file(const std::string& path, const std::string& type);

private:
    [[nodiscard]] Variant pack_resource(const Resource& resource);
    [[nodiscard]] int64_t new_sub_id(const Resource& resource);

    SceneFile& file_;
    std::string path_;
    const SceneFile* original_;
    std::unordered_map<std::string, int64_t> ext_ids_; ///< by path
    std::unordered_set<int64_t> used_ext_ids_;
    std::unordered_map<const Resource*, int64_t> sub_ids_;
    std::unordered_set<int64_t> used_sub_ids_;
    std::unordered_set<const Resource*> packing_; ///< those whose properties are being packed
};

/// A resource as a file of its own.
/// @param path  "res://..." it is saved under; may be empty
[[nodiscard]] SceneFile pack_resource_file(const Resource& resource, const std::string& path = {});

/// Writes a resource as .tres, beside the target and renamed over it.
[[nodiscard]] Status save_resource(const Resource& resource, const std::filesystem::path& target);

} // namespace cl::scene
