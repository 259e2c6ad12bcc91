#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cl::tests {

/// What a finished program left behind. exit_status is -1 if it could not be started, 128 + n if signal n
/// ended it.
struct ProcessResult {
    int exit_status = -1;
    std::string output; ///< standard output
    std::string errors; ///< standard error
};

/// Runs a program to its end; `arguments[0]` is its path or name.
[[nodiscard]] ProcessResult run_process(const std::vector<std::string>& arguments);

/// `conelight`, built beside this test program.
[[nodiscard]] std::filesystem::path conelight_path();

/// An empty folder of its own, removed with all it holds at the end.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// Writes a file there and gives its path.
    std::filesystem::path write(const std::string& name, const std::string& text) const;

private:
    std::filesystem::path path_;
};

} // namespace cl::tests
