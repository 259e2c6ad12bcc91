#pragma once

#include "core/diagnostics.h"
#include "core/expected.h"
#include "core/variant/variant.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace cl::scene {

/// A file of `[section]` headings and `key=value` lines: project.godot, *.import (spec tscn section 8).
class ConfigFile {
public:
    /// @return the first error of the text, with its place.
    [[nodiscard]] static Expected<ConfigFile> parse(std::string_view text, const std::string& name,
                                                    Diagnostics& diagnostics);
    [[nodiscard]] static Expected<ConfigFile> load(const std::filesystem::path& file,
                                                   Diagnostics& diagnostics);

    /// "section/key", or "key" before the first section; of a key given twice the last. nullptr if there is
    /// none.
    [[nodiscard]] const Variant* find(std::string_view key) const noexcept;
    /// The value if it is a number (or a bool), else `otherwise`.
    [[nodiscard]] int64_t int_or(std::string_view key, int64_t otherwise) const noexcept;
    [[nodiscard]] bool bool_or(std::string_view key, bool otherwise) const noexcept;
    [[nodiscard]] std::string text_or(std::string_view key, std::string_view otherwise) const;

private:
    std::map<std::string, Variant, std::less<>> values_;
};

} // namespace cl::scene
