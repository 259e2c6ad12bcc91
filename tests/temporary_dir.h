#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace cl::tests {

/// A fresh empty folder that goes, with all in it, at the end of the test.
class TemporaryDir {
public:
    TemporaryDir() {
        std::string name = (std::filesystem::temp_directory_path() / "conelight-test-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    TemporaryDir(const TemporaryDir&) = delete;
    TemporaryDir& operator=(const TemporaryDir&) = delete;
    ~TemporaryDir() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

} // namespace cl::tests
