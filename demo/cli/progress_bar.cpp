#include "demo/cli/progress_bar.h"

#include "demo/cli/time_left.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace cl::demo {

namespace {
constexpr int kWidth = 30; // [characters]
}

ProgressBar::ProgressBar(std::string title, Verbosity verbosity)
    : title_(std::move(title)), visible_(verbosity != Verbosity::Quiet && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    clear();
}

void ProgressBar::clear() {
    if (visible_ && last_percent_ >= 0) {
        std::fputs("\r\x1b[K", stderr); // to the line's start, and erase it
        last_percent_ = -1;
    }
}

void ProgressBar::show(float share) {
    const int percent = static_cast<int>(std::clamp(share, 0.0f, 1.0f) * 100.0f);
    if (!visible_ || percent == last_percent_) {
        return;
    }
    last_percent_ = percent;
    const std::string bar(static_cast<size_t>(percent * kWidth / 100), '#');
    // What stood there may have been longer: erased to the line's end.
    const std::string left = time_left(share, since_.elapsed_ms() * 1e-3);
    std::fprintf(stderr, "\r%s [%-*s] %3d %%  %s\x1b[K", title_.c_str(), kWidth, bar.c_str(), percent,
                 left.c_str());
}

} // namespace cl::demo
