#pragma once

#include "core/object/class_registry.h"

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace cl::tests {

/// The properties that a class adds to its parent's and that files hold, in save order.
[[nodiscard]] std::vector<const PropertyInfo*> own_stored_properties(const ClassInfo& info);

struct Choice {
    const char* class_name;
    const char* property; ///< an enumeration
};

/// Checks that a property refuses each of the wrong numbers, keeps its old value, and takes `right`.
void check_choice(const Choice& choice, std::initializer_list<int64_t> wrong, int64_t right);

} // namespace cl::tests
