#pragma once

#include "demo/cli/options.h"

#include <string>

namespace cl::demo {

/// One line on a terminal's stderr that shows the share done; nothing when stderr is no terminal or quiet is
/// asked.
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
};

} // namespace cl::demo
