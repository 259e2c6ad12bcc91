#pragma once

#include "scene/io/project_paths.h"
#include "scene/io/scene_file.h"
#include "scene/resources/packed_scene.h"

#include "core/diagnostics.h"
#include "core/expected.h"
#include "core/object/resource.h"
#include "core/ref.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cl::scene {

/// Loads the resources and scenes of one project, each file once: users of a file share its resource as long
/// as the loader lives. Needs register_scene_types().
class ResourceLoader {
public:
    /// @param diagnostics  receives a located warning for all that is read but has no effect; outlives the
    /// loader
    ResourceLoader(ProjectPaths paths, Diagnostics& diagnostics);

    /// Reads files that are not in the text format, such as glTF scenes; a null Ref is an error.
    using Importer =
        std::function<Expected<Ref<Resource>>(const std::filesystem::path& file, Diagnostics& diagnostics)>;
    /// @param suffix  of file names in lower case, without the dot
    void add_importer(std::string suffix, Importer importer);

    /// A text scene or resource, an image, or what an importer reads.
    /// @return the first error in it or in a file that it needs, with its place.
    [[nodiscard]] Expected<Ref<Resource>> load(const std::filesystem::path& file);
    /// The same for a scene. ParseError if the file is no scene.
    [[nodiscard]] Expected<Ref<PackedScene>> load_scene(const std::filesystem::path& file);
    /// The file behind "res://..." and so on (see ProjectPaths::file_of).
    [[nodiscard]] Expected<Ref<Resource>> load_path(std::string_view path);

    [[nodiscard]] const ProjectPaths& paths() const noexcept { return paths_; }

private:
    friend class SceneFileResources;

    [[nodiscard]] bool has_importer(const std::filesystem::path& file) const;
    [[nodiscard]] Expected<Ref<Resource>> load_any(const std::filesystem::path& file);
    [[nodiscard]] Expected<Ref<Resource>> load_text(const std::filesystem::path& file);
    [[nodiscard]] Ref<Resource> cached(const std::filesystem::path& file) const;
    void remember(const std::filesystem::path& file, const Ref<Resource>& resource);

    ProjectPaths paths_;
    Diagnostics& diagnostics_;
    std::map<std::string, Importer, std::less<>> importers_;
    std::map<std::filesystem::path, Ref<Resource>> cache_;
    std::vector<std::filesystem::path> loading_; ///< files that wait for those they refer to
};

} // namespace cl::scene
