#include "core/diagnostics.h"

#include <utility>

namespace cl {

std::string Warning::to_string() const {
    return where.prefix() + "warning: " + message;
}

void Diagnostics::warn(SourceLocation where, std::string message, const std::string& once_key) {
    if (!once_key.empty() && !said_.insert(once_key).second) {
        return;
    }
    warnings_.push_back({std::move(where), std::move(message)});
}

} // namespace cl
