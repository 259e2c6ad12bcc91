#pragma once

#include <cstdio>
#include <string>
#include <unistd.h>

namespace cl::tests {

/// Takes what is written to stderr while it lives, so that a test can read what the log said.
class CapturedStderr {
public:
    CapturedStderr() : file_(std::tmpfile()), saved_(dup(STDERR_FILENO)) {
        std::fflush(stderr);
        dup2(fileno(file_), STDERR_FILENO);
    }
    ~CapturedStderr() {
        std::fflush(stderr);
        dup2(saved_, STDERR_FILENO);
        close(saved_);
        std::fclose(file_);
    }
    CapturedStderr(const CapturedStderr&) = delete;
    CapturedStderr& operator=(const CapturedStderr&) = delete;

    /// All that was written so far.
    [[nodiscard]] std::string text() const {
        std::fflush(stderr);
        std::string all;
        char buffer[4096];
        for (off_t offset = 0;;) {
            const ssize_t n = pread(fileno(file_), buffer, sizeof buffer, offset);
            if (n <= 0) {
                return all;
            }
            all.append(buffer, static_cast<size_t>(n));
            offset += n;
        }
    }

private:
    FILE* file_;
    int saved_;
};

} // namespace cl::tests
