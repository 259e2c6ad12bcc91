#include "servers/visual/stale_rids.h"

#include "core/io/log.h"

#include <fmt/format.h>

namespace cl {

Status StaleRIDs::refuse(std::string_view call, std::string_view expected, RID found) {
    const std::string what =
        found ? fmt::format("RID {}:{}, which is freed or of another kind", found.slot, found.generation)
              : std::string("the null RID");
    return refuse(fmt::format("{}: expected {}, found {}", call, expected, what));
}

Status StaleRIDs::refuse(std::string message) {
    if (said_.size() < kMaxRemembered && said_.insert(message).second) {
        log_error(message);
    }
    return Error{.code = ErrorCode::InvalidArgument, .message = std::move(message)};
}

} // namespace cl
