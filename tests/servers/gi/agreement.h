#pragma once

#include "servers/gi/probe_data.h"

#include <cstddef>

namespace cl::tests {

/// How far two bakes of the same scene agree, whatever the order of their cells.
struct Agreement {
    size_t common = 0, ours_only = 0, theirs_only = 0;
    size_t bytes = 0, equal = 0, within_one = 0; ///< of the words of common leaves
    size_t leaves_within_one = 0;                ///< common leaves, all of whose bytes are
    size_t inner = 0, inner_equal = 0;
};
[[nodiscard]] Agreement agreement(const gi::Octree& ours, const gi::Octree& theirs);

} // namespace cl::tests
