#pragma once

#include "core/expected.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace cl::scene {

/// Where `res://` is: the nearest folder upward of a scene that holds a project.godot, else the scene's own
/// folder.
class ProjectPaths {
public:
    /// @param file  a scene or resource, or a folder; need not exist.
    [[nodiscard]] static ProjectPaths containing(const std::filesystem::path& file);

    /// Absolute path of the project's folder.
    [[nodiscard]] const std::filesystem::path& root() const noexcept { return root_; }
    /// False if there is no project.godot: root() is then the scene's folder.
    [[nodiscard]] bool has_project_file() const noexcept { return has_project_file_; }

    /// The file behind a path as scenes spell it: "res://a/b.png", an absolute one, or one relative to the
    /// folder of the file that refers to it.
    /// @param referrer  that file, as an absolute path.
    /// @return NotFound if "res://" leads out of the project, Unsupported for "user://" and other schemes.
    [[nodiscard]] Expected<std::filesystem::path> file_of(std::string_view path,
                                                          const std::filesystem::path& referrer = {}) const;
    /// "res://a/b.png" for files below root(), else the absolute path.
    [[nodiscard]] std::string resource_path_of(const std::filesystem::path& file) const;

private:
    std::filesystem::path root_;
    bool has_project_file_ = false;
};

/// Absolute, without "." and ".." (symbolic links are left alone).
[[nodiscard]] std::filesystem::path normalized(const std::filesystem::path& path);

} // namespace cl::scene
