#pragma once

#include <cstdint>

namespace cl {

/// Numbers every change in the server. Because all versions come from one clock, the latest of several
/// things' versions is new whenever any of them changed.
class VersionClock {
public:
    [[nodiscard]] uint64_t tick() noexcept { return ++now_; }

private:
    uint64_t now_ = 0;
};

} // namespace cl
