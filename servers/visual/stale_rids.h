#pragma once

#include "core/expected.h"
#include "core/rid.h"

#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace cl {

/// Answers for RIDs that are not what a call expected: an Error each time, a line in the log the first time.
class StaleRIDs {
public:
    /// @param call      "light_set"
    /// @param expected  "a light"
    /// @return InvalidArgument "light_set: expected a light, found RID 67108867:2, which is freed or of
    /// another kind"
    Status refuse(std::string_view call, std::string_view expected, RID found);
    /// For other misuse at the door, said once for each text.
    Status refuse(std::string message);

private:
    static constexpr size_t kMaxRemembered = 4096; ///< beyond it nothing new is logged: memory stays bounded
    std::set<std::string, std::less<>> said_;
};

} // namespace cl
