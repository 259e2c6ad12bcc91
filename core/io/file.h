#pragma once

#include "core/expected.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cl {

/// Whole file as bytes. Error says why in one line: missing, a directory, not readable, larger than
/// `max_bytes`.
[[nodiscard]] Expected<std::string> read_text_file(const std::filesystem::path& path,
                                                   uint64_t max_bytes = uint64_t{1} << 31);
[[nodiscard]] Expected<std::vector<uint8_t>> read_binary_file(const std::filesystem::path& path,
                                                              uint64_t max_bytes = uint64_t{1} << 31);

/// Writes beside the target (same folder), syncs and renames over it: a reader sees the old or the new file,
/// never a part. Keeps the target's permissions. Follows a symbolic link at `path`.
[[nodiscard]] Status write_file_atomic(const std::filesystem::path& path, std::string_view bytes);

} // namespace cl
