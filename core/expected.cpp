#include "core/expected.h"

namespace cl {

std::string SourceLocation::prefix() const {
    std::string text;
    if (!file.empty()) {
        text += file + ':';
    }
    if (line > 0) {
        text += std::to_string(line) + ':';
        if (column > 0) {
            text += std::to_string(column) + ':';
        }
    }
    if (!text.empty()) {
        text += ' ';
    }
    return text;
}

std::string Error::to_string() const {
    return where.prefix() + "error: " + message;
}

} // namespace cl
