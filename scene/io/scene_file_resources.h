#pragma once

#include "scene/io/resource_link.h"
#include "scene/io/resource_loader.h"

#include <filesystem>

namespace cl::scene {

/// Makes the resources of one parsed file: first those of other files, then its own in file order.
class SceneFileResources {
public:
    /// @param path  of the file, absolute: relative paths in it start from its folder
    SceneFileResources(ResourceLoader& loader, const SceneFile& file, const std::filesystem::path& path);

    /// @return the first error with its place; files that only have no effect here are a warning and stand
    /// in.
    [[nodiscard]] Expected<PackedScene::Resources> make();
    /// Makes the resource of a `[resource]` section; make() first.
    [[nodiscard]] Expected<Ref<Resource>> make_main();

private:
    [[nodiscard]] Status load_images();
    [[nodiscard]] Status load_paths_in_nodes();
    [[nodiscard]] Expected<Ref<Resource>> load_ext(const ExtEntry& entry);
    [[nodiscard]] Expected<Ref<Resource>> load_known_kind(const ExtEntry& entry,
                                                          const std::filesystem::path& file);
    [[nodiscard]] Expected<Ref<Resource>> create(const std::string& type, const SourceLocation& where);
    [[nodiscard]] Status fill(Resource& resource, const Assignments& assignments);
    [[nodiscard]] Expected<Variant> resolve(const ResourceLink& link);
    /// A resource that keeps what it stands for; said once for each `reason`.
    [[nodiscard]] Ref<Resource> stand_in(const std::string& type, const SourceLocation& where,
                                         const std::string& reason);

    ResourceLoader& loader_;
    Diagnostics& diagnostics_;
    const SceneFile& file_;
    const std::filesystem::path& path_;
    PackedScene::Resources made_;
};

} // namespace cl::scene
