#include "core/object/method_call.h"

#include <fmt/core.h>

namespace cl {

namespace detail {

Error wrong_argument_count(size_t expected, size_t found) {
    return {ErrorCode::InvalidArgument,
            fmt::format("expected {} argument{}, found {}", expected, expected == 1 ? "" : "s", found)};
}

Error wrong_argument_type(size_t index, Variant::Type expected, Variant::Type found) {
    return {ErrorCode::InvalidArgument, fmt::format("argument {}: expected {}, found {}", index + 1,
                                                    type_name(expected), type_name(found))};
}

} // namespace detail

} // namespace cl
