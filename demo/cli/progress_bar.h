#pragma once

#include "demo/cli/options.h"

#include "core/stopwatch.h"

#include <string>

namespace cl::demo {

/// One line on a terminal's stderr that shows the share done and the time left; nothing when stderr is no
/// terminal or quiet is asked.
class ProgressBar {
public:
    ProgressBar(std::string title, Verbosity verbosity);
    ~ProgressBar(); ///< as clear()
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    /// @param share  done so far, 0 to 1
    void show(float share);
    void clear(); ///< removes the line, so that others can be written

private:
    std::string title_;
    bool visible_ = false;
    int last_percent_ = -1;
    Stopwatch since_;
};

} // namespace cl::demo
