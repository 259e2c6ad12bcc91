#pragma once

#include "core/expected.h"

#include <utility>

namespace cl {

/// Keeps the first error of a job that goes on regardless, as drawing does.
class FirstError {
public:
    void note(Status status) {
        if (status_.ok() && !status.ok()) {
            status_ = std::move(status);
        }
    }
    [[nodiscard]] const Status& status() const noexcept { return status_; }

private:
    Status status_;
};

} // namespace cl
