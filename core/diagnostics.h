#pragma once

#include "core/expected.h"

#include <string>
#include <unordered_set>
#include <vector>

namespace cl {

/// A located remark that does not stop the work. Printed as `file:line:column: warning: message`.
struct Warning {
    SourceLocation where;
    std::string message;
    [[nodiscard]] std::string to_string() const;
};

/// Collects the warnings of one load, bake or run, each said once.
class Diagnostics {
public:
    /// Keeps the warning; if `once_key` is not empty, only the first with that key is kept
    /// (an unknown property of a class is said once, however many nodes have it).
    void warn(SourceLocation where, std::string message, const std::string& once_key = {});
    [[nodiscard]] const std::vector<Warning>& warnings() const noexcept { return warnings_; }

private:
    std::vector<Warning> warnings_;
    std::unordered_set<std::string> said_;
};

} // namespace cl
