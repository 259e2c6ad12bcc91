#include "core/io/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>

namespace cl {

namespace {

spdlog::level::level_enum spdlog_level(LogLevel level) {
    switch (level) {
    case LogLevel::Debug:
        return spdlog::level::debug;
    case LogLevel::Info:
        return spdlog::level::info;
    case LogLevel::Warning:
        return spdlog::level::warn;
    case LogLevel::Error:
        return spdlog::level::err;
    case LogLevel::Off:
        break;
    }
    return spdlog::level::off;
}

/// Never destroyed: objects that outlive main() may still have something to say.
spdlog::logger& logger() {
    static spdlog::logger* const instance = [] {
        auto* made = new spdlog::logger("conelight", std::make_shared<spdlog::sinks::stderr_sink_mt>());
        made->set_pattern("%v");
        made->flush_on(spdlog::level::debug);
        return made;
    }();
    return *instance;
}

} // namespace

void set_log_level(LogLevel level) noexcept {
    logger().set_level(spdlog_level(level));
}

LogLevel log_level() noexcept {
    for (const LogLevel level : {LogLevel::Debug, LogLevel::Info, LogLevel::Warning, LogLevel::Error}) {
        if (logger().should_log(spdlog_level(level))) {
            return level;
        }
    }
    return LogLevel::Off;
}

void log_line(LogLevel level, std::string_view text) {
    if (level != LogLevel::Off) {
        logger().log(spdlog_level(level), spdlog::string_view_t(text.data(), text.size()));
    }
}

void log_message(LogLevel level, std::string_view text) {
    switch (level) {
    case LogLevel::Warning:
        log_line(level, "warning: " + std::string(text));
        break;
    case LogLevel::Error:
        log_line(level, "error: " + std::string(text));
        break;
    default:
        log_line(level, text);
        break;
    }
}

} // namespace cl
