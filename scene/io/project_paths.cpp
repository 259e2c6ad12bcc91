#include "scene/io/project_paths.h"

#include <fmt/format.h>

#include <system_error>

namespace cl::scene {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kResource = "res://";

bool is_inside(const fs::path& relative) {
    return !relative.empty() && *relative.begin() != "..";
}

} // namespace

fs::path normalized(const fs::path& path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    return (error ? path : absolute).lexically_normal();
}

ProjectPaths ProjectPaths::containing(const fs::path& file) {
    std::error_code error;
    const fs::path absolute = normalized(file);
    const fs::path folder = fs::is_directory(absolute, error) ? absolute : absolute.parent_path();
    ProjectPaths paths;
    paths.root_ = folder;
    for (fs::path up = folder;; up = up.parent_path()) {
        if (fs::is_regular_file(up / "project.godot", error)) {
            paths.root_ = up;
            paths.has_project_file_ = true;
            return paths;
        }
        if (up == up.parent_path()) {
            return paths;
        }
    }
}

Expected<fs::path> ProjectPaths::file_of(std::string_view path, const fs::path& referrer) const {
    if (path.substr(0, kResource.size()) == kResource) {
        // A leading '/' after the scheme must not make the path absolute: res:///etc is a file of the
        // project.
        std::string_view inside = path.substr(kResource.size());
        while (!inside.empty() && inside.front() == '/') {
            inside.remove_prefix(1);
        }
        const fs::path relative = fs::path(std::string(inside)).lexically_normal();
        if (!is_inside(relative)) {
            return Error{ErrorCode::NotFound,
                         fmt::format("expected a path inside the project, found \"{}\"", path)};
        }
        return root_ / relative;
    }
    if (path.find("://") != std::string_view::npos) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("expected a path that starts with res://, found \"{}\"", path)};
    }
    const fs::path plain{std::string(path)};
    return plain.is_absolute() ? plain.lexically_normal()
                               : (referrer.parent_path() / plain).lexically_normal();
}

std::string ProjectPaths::resource_path_of(const fs::path& file) const {
    const fs::path absolute = normalized(file);
    const fs::path relative = absolute.lexically_relative(root_);
    return is_inside(relative) ? std::string(kResource) + relative.generic_string()
                               : absolute.generic_string();
}

} // namespace cl::scene
