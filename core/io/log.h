#pragma once

#include <string_view>

namespace cl {

enum class LogLevel { Debug, Info, Warning, Error, Off };

/// Least level that is printed (to stderr). Default Info. Thread safe.
void set_log_level(LogLevel level) noexcept;
[[nodiscard]] LogLevel log_level() noexcept;

/// Prints one line as it is, for text that names its place and kind itself: `a.tscn:3:1: warning: ...`.
/// Lines of several threads do not mix.
void log_line(LogLevel level, std::string_view text);
/// The same with `warning: ` or `error: ` before the text of those levels.
void log_message(LogLevel level, std::string_view text);
/// Debug: what `-v` shows. Info: progress for a person. Warning and Error: as `warning: ...`, `error: ...`.
inline void log_debug(std::string_view text) {
    log_message(LogLevel::Debug, text);
}
inline void log_info(std::string_view text) {
    log_message(LogLevel::Info, text);
}
inline void log_warning(std::string_view text) {
    log_message(LogLevel::Warning, text);
}
inline void log_error(std::string_view text) {
    log_message(LogLevel::Error, text);
}

} // namespace cl
