#pragma once

#include <chrono>

namespace cl {

/// Tells the time since it was made.
class Stopwatch {
public:
    [[nodiscard]] double elapsed_ms() const {
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin_;
        return took.count();
    }

private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

} // namespace cl
