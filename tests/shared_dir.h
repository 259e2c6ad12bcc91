#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace cl::tests {

/// Root of the checkout: the nearest folder upward from the working directory that holds SConstruct.
inline std::filesystem::path repository_dir() {
    for (std::filesystem::path d = std::filesystem::current_path(); d != d.root_path(); d = d.parent_path()) {
        if (std::filesystem::exists(d / "SConstruct")) {
            return d;
        }
    }
    return std::filesystem::current_path();
}

/// The folder with the reference material (specifications, oracle, assets): $CONELIGHT_SHARED, else ../shared
/// beside the checkout. std::nullopt where a user has the repository alone; such tests say that they skip.
inline std::optional<std::filesystem::path> shared_dir() {
    const char* set = std::getenv("CONELIGHT_SHARED");
    const std::filesystem::path dir =
        set ? std::filesystem::path(set) : repository_dir().parent_path() / "shared";
    if (std::filesystem::is_directory(dir)) {
        return dir;
    }
    return std::nullopt;
}

} // namespace cl::tests
