#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace cl::demo {

/// Time left, if the rest goes as fast as what is done: "12 s left", "3 min left". Empty while that is a
/// guess: in the first second, and below a share of 2 percent.
[[nodiscard]] inline std::string time_left(float share, double elapsed_s) {
    if (elapsed_s < 1.0 || !(share >= 0.02f)) {
        return {};
    }
    const double left_s = elapsed_s * std::max(0.0, 1.0 / double(share) - 1.0);
    return left_s < 100.0 ? fmt::format("{:.0f} s left", std::ceil(left_s))
                          : fmt::format("{:.0f} min left", std::ceil(left_s / 60.0));
}

} // namespace cl::demo
