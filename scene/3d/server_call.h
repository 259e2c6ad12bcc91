#pragma once

#include "core/expected.h"

namespace cl::scene {

/// Drops what the server answered to a setter: it logs what it refuses, and a node could do no more.
inline void tell(const Status& /*answer*/) noexcept {}

} // namespace cl::scene
