#include "drivers/gles3/gl/shader_log.h"

#include <charconv>
#include <optional>
#include <string>

namespace cl::gles3::gl {

namespace {

bool take(std::string_view& text, std::string_view prefix) {
    if (!text.starts_with(prefix)) {
        return false;
    }
    text.remove_prefix(prefix.size());
    return true;
}

std::optional<int> take_number(std::string_view& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || value < 0) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    return value;
}

struct Complaint {
    int file = 0, line = 0;
    std::string_view text;
};

/// One line of a log; nullopt if it has no place, or is a warning.
std::optional<Complaint> parse_line(std::string_view line) {
    take(line, "ERROR: ");
    const std::optional<int> file = take_number(line);
    if (!file || !take(line, ":")) {
        return std::nullopt;
    }
    const std::optional<int> number = take_number(line);
    if (!number) {
        return std::nullopt;
    }
    if (take(line, "(")) { // Mesa's column, which is that of the expanded text's token
        if (!take_number(line) || !take(line, ")")) {
            return std::nullopt;
        }
    }
    if (!take(line, ": ") || line.starts_with("warning")) {
        return std::nullopt;
    }
    take(line, "error: ");
    return Complaint{*file, *number, line};
}

} // namespace

Error error_from_shader_log(std::string_view log, const ShaderSource& source) {
    std::string_view rest = log;
    while (!rest.empty()) {
        const size_t end = rest.find('\n');
        const std::optional<Complaint> c = parse_line(rest.substr(0, end));
        if (c && static_cast<size_t>(c->file) < source.files.size()) {
            return Error{ErrorCode::ParseError, std::string(c->text),
                         SourceLocation{std::string(source.files[static_cast<size_t>(c->file)]), c->line, 0}};
        }
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    }
    const std::string_view first = log.substr(0, log.find('\n'));
    return Error{
        ErrorCode::ParseError,
        first.empty() ? "the driver refused the program and gave no reason" : std::string(first),
        SourceLocation{source.files.empty() ? std::string(source.name) : std::string(source.files[0]), 0, 0}};
}

} // namespace cl::gles3::gl
