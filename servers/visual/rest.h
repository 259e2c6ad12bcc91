#pragma once

#include <cstdint>

namespace cl {

/// When what moved counts as resting.
enum class Rest : uint8_t { AfterSteps, AtOnce };

/// Steps without a change after which it does.
inline constexpr uint64_t kRestSteps = 30;

} // namespace cl
